"""A profile from a measurement: heights in a file, as the shape of a punch with its radius and its waves."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli.study.rules.mistakes import Mistake, line_of
from gradhesion.cli.study.text.places import Path as Key
from gradhesion.cli.study.text.quantities import factor_of_column, si_value
from gradhesion.cli.study.text.written import with_fingerprint
from gradhesion.cli.tables.columns import ColumnsError, changed
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.profile import Profile

if TYPE_CHECKING:
    from gradhesion.core.answers.profile_fit import FittedProfile

KEY: Final[Key] = ("profile", "file")
COLUMNS: Final = ("r", "height")
"""The columns of a measured profile."""
TERMS: Final = 16
"""Harmonics that are fitted where a study does not say how many."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Measured:
    """The profile of a study from a file; without a file there is none."""

    file: str = ""
    sha256: str = ""
    fit: "FittedProfile | None" = None
    dropped: int = 0
    """Rows without a number that were left out."""
    mistakes: tuple[Mistake, ...] = ()

    @property
    def unread(self) -> bool:
        """Whether there is a file and no fit of it, so that what it would give is not missing."""
        return bool(self.mistakes)

    def beside(self, data: Mapping[str, Any]) -> dict[str, Any]:
        """Give the keys of a study with what comes from the fit, or with valid values in its place."""
        if not self.file:
            return dict(data)
        fit = self.fit
        radius, wavelength, amplitude = (fit.radius, fit.wavelength, fit.amplitude) if fit else (1.0, 1.0, 1.0)
        own: dict[str, Any] = {"lambda_over_R": wavelength / radius, "A": amplitude / wavelength}
        if isinstance(data.get("physical"), Mapping):
            own = {"R": f"{radius!r} m", "wavelength": f"{wavelength!r} m", "amplitude": f"{amplitude!r} m"}
        name = "physical" if "R" in own else "parameters"
        return {**data, name: {**own, **data[name]}} if isinstance(data.get(name), Mapping) else dict(data)

    def profile(self) -> Profile | None:
        """Give the shape of the punch."""
        return self.fit.profile if self.fit else None

    def stored(self, data: Mapping[str, Any], text: str) -> tuple[dict[str, Any], str]:
        """Give the keys and the text of a study with the fingerprint of the file; no text where it is to be made."""
        return with_fingerprint(data, text, ("profile",), self.sha256) if self.file else (dict(data), text)


def measured_in(data: Mapping[str, Any], folder: Path) -> Measured:
    """Fit the profile of a study, if it comes from a file, which is looked for in a folder."""
    table = data.get("profile")
    file = table.get("file") if isinstance(table, Mapping) else None
    if not isinstance(table, Mapping) or not isinstance(file, str) or not file:
        return Measured()
    mistakes, up_to = list(_mistakes_of_keys(data, table)), _up_to(data, table)
    terms, exponent, expected = table.get("terms", TERMS), table.get("exponent", 2.0), table.get("sha256", "")
    numbers = isinstance(terms, int) and (exponent == "fit" or isinstance(exponent, int | float))
    if up_to is None or not numbers or not isinstance(expected, str):  # whose form is refused, or in what is missing
        return Measured(file=file, mistakes=tuple(mistakes))
    try:
        places, heights, sha256, dropped = read_profile(folder / file)
        if not expected or expected == sha256:
            fit = fitted(places, heights, up_to=up_to, terms=terms, exponent=exponent)
        else:
            mistakes.append(Mistake(KEY, file, changed(sha256, expected, "remove sha256")))
    except ValueError as error:
        mistakes.append(Mistake(KEY, file, str(error)))
    if mistakes:
        return Measured(file=file, mistakes=tuple(mistakes))
    return Measured(file=file, sha256=sha256, fit=fit, dropped=dropped)


def fitted(
    r: NDArray[np.float64], heights: NDArray[np.float64], *, up_to: float | None, terms: int, exponent: float | str
) -> "FittedProfile":
    """
    Fit a profile in metres.

    Raises
    ------
    ValueError
        It cannot be fitted; the message says what to do.
    """
    from gradhesion.core.answers.profile_fit import fit_profile  # noqa: PLC0415 (500 ms for SciPy)

    power = None if isinstance(exponent, str) else float(exponent)
    return fit_profile(r, heights, up_to=up_to, terms=terms, exponent=power)


def exponent_of(text: str) -> float | str:
    """
    Read the power of a punch: a number above 1, or "fit".

    Raises
    ------
    ValueError
        It is neither.

    >>> exponent_of("2.5"), exponent_of("fit")
    (2.5, 'fit')
    """
    if text == "fit":
        return text
    try:
        power = float(text)
    except ValueError:
        power = math.nan
    if not 1.0 < power < math.inf:
        raise ValueError('a power is a finite number above 1, or "fit"')
    return power


def read_profile(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64], str, int]:
    """
    Read a measured profile.

    Returns
    -------
    Places and heights in m, the fingerprint of the file, and the number of rows that have no numbers and are left out.

    Raises
    ------
    ColumnsError
        It cannot be read, or is no profile.
    """
    found = read_columns(path, only=COLUMNS)
    for name in COLUMNS:
        if name not in found.values:
            near = did_you_mean(name, (*found.values, *found.others)).replace("did you mean", "rename")
            raise ColumnsError(f"there is no column {shown(name)}, and a profile has {' and '.join(COLUMNS)}; {near}")
    r, height = (found.values[name] * float(factor_of_column(found, name, "up_to")) for name in COLUMNS)
    sound = np.isfinite(r) & np.isfinite(height)
    if not sound.any():
        raise ColumnsError("no row has two numbers; name a file with r and height in each row")
    return r[sound], height[sound], found.sha256, int(np.count_nonzero(~sound))


def _up_to(data: Mapping[str, Any], table: Mapping[str, Any]) -> float | None:
    """Find the distance up to which a profile is fitted: that of the study, or the radius of its punch."""
    physical = data.get("physical")
    rim = physical.get("a_max") if isinstance(physical, Mapping) else None
    try:
        value = si_value(table.get("up_to", rim), "up_to" if "up_to" in table else "a_max")
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _mistakes_of_keys(data: Mapping[str, Any], table: Mapping[str, Any]) -> Iterator[Mistake]:
    """Check what stands beside the file: nothing that comes from the fit, and up to where it is fitted."""
    if "harmonics" in table:
        sentence = "the harmonics come from the file; remove them, or remove file"
        yield Mistake(("profile", "harmonics"), table["harmonics"], sentence)
    for key in INPUTS.values():
        own = data.get(key.table)
        if isinstance(own, Mapping) and key.name in own and (key.gives in ("lambda_over_R", "A") or key.name == "R"):
            sentence = "this comes from the fit of the profile; remove it, or remove file under [profile]"
            yield Mistake((key.table, key.name), own[key.name], sentence)
    if "up_to" not in table and _up_to(data, table) is None:
        sentence = "unless a_max is one finite length, a profile needs the distance up to which it is fitted; write "
        yield Mistake(("profile", "up_to"), None, f"{sentence}for example {line_of(('profile', 'up_to'))}")
