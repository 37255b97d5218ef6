"""What a study takes from files: points, whose columns are parameters, and the measured heights of a punch."""

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from gradhesion.cli.study.rules.asked import value_at
from gradhesion.cli.study.rules.form import ProfileTable
from gradhesion.cli.study.rules.keys import MOST_VALUES, File
from gradhesion.cli.study.rules.mistakes import Mistake, line_of
from gradhesion.cli.study.text.quantities import factor_of_column, scaled, si_value
from gradhesion.cli.study.text.toml import Key, value_of
from gradhesion.cli.tables.columns import Columns, ColumnsError, changed
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.inputs import INPUTS

if TYPE_CHECKING:
    from gradhesion.core.answers.profile_fit import FittedProfile

COMMENT: Final = "a column of "
"""How the comment of a coordinate begins that is a column of a file."""
HEIGHTS: Final = ("r", "height")
"""The columns of a measured profile."""
FILE_KEYS: Final = {"file", "sha256", "terms", "exponent", "up_to"}
"""The keys of a profile that say how it is fitted to a file."""
TERMS: Final = 16
"""Harmonics that are fitted where a study does not say how many."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FromFile:
    """What a study takes from one file; nothing where it names none."""

    key: Key = ()
    """The key, or the table with `file`, that names it."""
    file: str = ""
    sha256: str = ""
    inputs: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    """The inputs that it gives, in SI units; valid values in the place of those that are wrong."""
    mistakes: tuple[Mistake, ...] = ()
    fit: "FittedProfile | None" = None

    def beside(self, data: Mapping[str, Any]) -> dict[str, Any]:
        """Put what the file gives into a study, where that does not have it, so that all can be checked as one."""
        whole = dict(data)
        if self.key == ("parameters", "points"):
            whole["layout"] = "points" if data.get("layout") == "grid" else data.get("layout", "points")
        for name, values in self.inputs.items():
            if isinstance(table := whole.get(INPUTS[name].table, {}), Mapping):
                whole[INPUTS[name].table] = {name: values, **table}
        return whole


def points_of(
    data: Mapping[str, Any], folder: Path, columns: Mapping[str, NDArray[np.float64]] | None = None
) -> FromFile:
    """Read the points of a study from a file in a folder, unless the columns of that are given."""
    key = ("parameters", "points")
    written = value_at(data, key)
    try:
        named = File.model_validate({"file": written} if isinstance(written, str) else written)
    except ValidationError:
        return FromFile()  # its form is refused
    if columns is not None:
        return FromFile(key=key, file=named.file, sha256=named.sha256, inputs=columns)
    try:
        found = read_columns(folder / named.file)
        if named.sha256 not in ("", found.sha256):
            raise ColumnsError(changed(found.sha256, named.sha256, f"write points = {value_of(named.file)}"))
    except ValueError as error:
        return FromFile(key=key, mistakes=((key, str(error)),))
    own: dict[str, NDArray[np.float64]] = {}
    mistakes = tuple((key, sentence) for sentence in _mistakes(data, found, own))
    return FromFile(key=key, file=named.file, sha256=found.sha256, inputs=own, mistakes=mistakes)


def _mistakes(data: Mapping[str, Any], found: Columns, own: dict[str, NDArray[np.float64]]) -> Iterator[str]:
    """Check columns that are points of a study; fill `own`, with valid values where theirs are none."""
    rows = next(iter(found.values.values())).size
    for name, given in found.values.items():
        if name not in INPUTS:
            yield f"column {shown(name)} is no parameter; leave it out or rename it: {did_you_mean(name, [*INPUTS])}"
            continue
        key = INPUTS[name]
        own[name] = np.full(rows, 0.5 if key.admits(0.5) else 1.0)
        if value_at(data, (key.table, name)) is not None:
            yield f"{name} is given under [{key.table}] and as a column of the file; keep one of the two"
        try:
            values = scaled(given, factor_of_column(found, name, name))
        except ColumnsError as error:
            yield str(error)
            continue
        if not (wrong := np.flatnonzero(~key.admits(values))).size:
            own[name] = values
            continue
        place, value = found.place(int(wrong[0])), float(given[wrong[0]])
        more = f", and {wrong.size - 1:,} more rows are as well" if wrong.size > 1 else ""
        if np.isnan(value):
            yield f"{place}: {name} is missing (NaN){more}; give it, or remove the row"
        else:
            yield f"{place}: {name} = {value!r} is out of range{more}; choose a value with {key.allowed}"
    if data.get("layout", "points") == "grid":
        yield 'the rows of a file are points, but layout = "grid"; write layout = "points" or leave it out'
    if rows > MOST_VALUES:
        yield f"the file has {rows:,} rows, but at most {MOST_VALUES:,} are read; split it"


def measured_in(data: Mapping[str, Any], folder: Path) -> FromFile:
    """Fit the profile of a study, if it comes from a file, which is looked for in a folder."""
    table, file = data.get("profile"), value_at(data, ("profile", "file"))
    if not isinstance(table, Mapping) or not isinstance(file, str) or not file:
        return FromFile()
    form, reach = ProfileTable(), math.inf
    with suppress(ValueError):  # it has no one length
        reach = si_value(value_at(data, ("physical", "a_max")), "a_max")
    with suppress(ValidationError):  # it is refused
        form = ProfileTable.model_validate({key: table[key] for key in FILE_KEYS & table.keys()})
    twice = [
        key
        for key in INPUTS.values()
        if (key.gives in ("lambda_over_R", "A") or key.name == "R")
        and value_at(data, (key.table, key.name)) is not None
    ]
    words = "this comes from the fit of the profile; remove it, or remove file under [profile]"
    mistakes: list[Mistake] = [((key.table, key.name), words) for key in twice]
    if "up_to" not in table and reach == math.inf:
        words = "unless a_max is one finite length, a profile needs the distance up to which it is fitted"
        mistakes.append((("profile", "up_to"), f"{words}; write for example {line_of('profile', 'up_to')}"))
    found = {"R": 1.0, "wavelength": 1.0, "amplitude": 1.0, "lambda_over_R": 1.0, "A": 1.0}
    fit, sha256 = None, ""
    try:
        if form.file and (reach := form.up_to or reach) < math.inf:
            from gradhesion.core.answers.profile_fit import fit_profile  # noqa: PLC0415 (500 ms for SciPy)

            r, heights, sha256, _ = read_profile(folder / file)
            if form.sha256 not in ("", sha256):
                raise ColumnsError(changed(sha256, form.sha256, "remove sha256"))
            power = None if form.exponent == "fit" else form.exponent
            fit = fit_profile(r, heights, up_to=reach, terms=form.terms or TERMS, exponent=power)
            found = {"R": fit.radius, "wavelength": fit.wavelength, "amplitude": fit.amplitude}
            found |= {"lambda_over_R": fit.wavelength / fit.radius, "A": fit.amplitude / fit.wavelength}
    except ValueError as error:
        mistakes.append((("profile", "file"), str(error)))
    names = ("R", "wavelength", "amplitude") if isinstance(data.get("physical"), Mapping) else ("lambda_over_R", "A")
    told = {key.name if key.name == "R" else key.gives for key in twice}
    inputs = {one: np.array(found[one]) for one in names if not {one, INPUTS[one].gives} & told}
    return FromFile(key=("profile",), file=file, sha256=sha256, inputs=inputs, mistakes=tuple(mistakes), fit=fit)


def read_profile(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64], str, int]:
    """Read places and heights in m, the fingerprint of the file, and how many rows without numbers were left out."""
    found = read_columns(path, only=HEIGHTS)
    for name in (name for name in HEIGHTS if name not in found.values):
        near = did_you_mean(name, (*found.values, *found.others)).replace("did you mean", "rename")
        raise ColumnsError(f"there is no column {shown(name)}, and a profile has {' and '.join(HEIGHTS)}; {near}")
    r, height = (found.values[name] * float(factor_of_column(found, name, "up_to")) for name in HEIGHTS)
    sound = np.isfinite(r) & np.isfinite(height)
    if not sound.any():
        raise ColumnsError("no row has two numbers; name a file with r and height in each row")
    return r[sound], height[sound], found.sha256, int(np.count_nonzero(~sound))
