"""A fitted profile as the tables of a study."""

from collections.abc import Iterator
from pathlib import Path

from gradhesion.cli.study.shape_words import profile_table
from gradhesion.core.answers.profile_fit import FittedProfile


def tables_of(fit: FittedProfile, file: Path, terms: int, exponent: float | str) -> Iterator[str]:
    """Write the tables that give the fitted punch, and how well it fits, line by line."""
    yield f"# {file.name} up to {1e6 * fit.up_to:.6g} um of its centre: {fit.distance.size:,} points"
    yield f"# residual {1e9 * fit.residual_rms:.3g} nm rms, {1e9 * fit.residual_max:.3g} nm at most"
    if fit.errors["centre"]:
        yield f"# both flanks; centre {_with_error(fit.centre, fit.errors['centre'], 1e6)} um"
    if fit.errors["exponent"]:
        yield f"# exponent {_with_error(fit.exponent, fit.errors['exponent'])}"
    yield f"# R {_with_error(fit.radius, fit.errors['radius'], 1e6)} um"
    yield f"# wavelength {_with_error(fit.wavelength, fit.errors['wavelength'], 1e6)} um"
    power = '"fit"' if isinstance(exponent, str) else f"{exponent!r}"
    own = f'file = "{file.name}", terms = {terms}, exponent = {power}, up_to = "{1e6 * fit.up_to:.9g} um"'
    yield f"# the same, fitted anew by each run: profile = {{ {own} }}"
    yield ""
    yield "[profile]"
    yield profile_table(fit.profile)
    yield ""
    yield "[physical]"
    yield f'R          = "{fit.radius!r} m"'
    yield f'wavelength = "{fit.wavelength!r} m"'
    yield f'amplitude  = "{fit.amplitude!r} m"'


def _with_error(value: float, error: float, scale: float = 1.0) -> str:
    """Write a value with its standard deviation.

    >>> _with_error(1.23456e-6, 2e-9, 1e6)
    '1.23456 +- 0.002'
    """
    return f"{scale * value:.6g} +- {scale * error:.2g}"
