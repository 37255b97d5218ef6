"""`gradhesion profile`: measured heights of a punch as the profile of a study, with a picture of the fit."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gradhesion.cli.commands import shared
from gradhesion.cli.terminal.amounts import counted

if TYPE_CHECKING:
    from gradhesion.core.answers.profile_fit import FittedProfile


@click.command(epilog=shared.example("profile tip.csv", 'profile tip.csv --up-to "2 um" --exponent fit > punch.toml'))
@click.argument("file", type=shared.A_PATH)
@click.option("-o", "--output", type=shared.A_PATH, help="Picture: .png, .svg or .pdf [FILE.png].")
@click.option("--terms", type=int, default=16, show_default=True, help="Harmonics to fit.")
@click.option("--exponent", default="2.0", show_default=True, help='Power of the punch, or "fit" to fit it.')
@click.option("--up-to", metavar="LENGTH", help='Distance from the centre up to which to fit, as "2 um" [all].')
@shared.overwriting
@shared.quietly
def profile(file: Path, output: Path | None, terms: int, exponent: str, up_to: str | None, overwrite: bool) -> None:
    """Fit the profile of a punch to measured heights.

    FILE is a table (CSV or NetCDF) with the columns r and height, their units in the header, as r [um]. Fits a power
    and a Fourier series, prints them as tables of a study, and draws the fit.
    """
    path = output or file.with_suffix(".png")
    form = shared.ending_of(path, "picture", shared.OF_PICTURES)

    from gradhesion.cli.disk import replacement, writing
    from gradhesion.cli.errors import StudyError
    from gradhesion.cli.picture.fits import drawn_profile
    from gradhesion.cli.picture.pictured import save
    from gradhesion.cli.study.files import read_profile
    from gradhesion.cli.study.text.quantities import si_value
    from gradhesion.cli.terminal.messages import show_block
    from gradhesion.core.answers.profile_fit import fit_profile

    option = f"--up-to {up_to}"
    try:
        reach = None if up_to is None else si_value(up_to, "up_to")
        option = f"--exponent {exponent}"
        power = None if exponent == "fit" else float(exponent)
    except ValueError as error:
        raise click.UsageError(f"{option}: {error}") from None
    with replacement(path, overwrite=overwrite) as temporary:
        try:
            r, heights, _, dropped = read_profile(file)
            fit = fit_profile(r, heights, up_to=reach, terms=terms, exponent=power)
        except ValueError as error:
            raise StudyError(f"{file}: {error}") from None
        with writing(path):
            save(drawn_profile(fit, file.name), temporary, form)
    show_block("\n".join(_tables_of(fit, file, terms, power or "fit")))
    note = f"{file}: {counted(dropped, 'row')} without two numbers left out"
    shared.say_written(path, [note] if dropped else [])


def _tables_of(fit: "FittedProfile", file: Path, terms: int, exponent: float | str) -> Iterator[str]:
    """Write the tables that give the fitted punch, and how well it fits, line by line."""
    from gradhesion.cli.study.shape_words import profile_table

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
