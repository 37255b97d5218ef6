"""What a call in Python gives, checked as a study is: numbers, quantities with units, axes and named dimensions."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
import xarray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.names.scenes import SCENE
from gradhesion.cli.study.reading import study_from, text_of
from gradhesion.cli.study.rules.axes import Values
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal.wording import nearest
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL
from gradhesion.wording import without_tables

MOST_LISTED: Final = 10_000
"""Values of all axes together up to which a dataset keeps them in the text of its study as well."""


@dataclass(kw_only=True, eq=False)
class Given:
    """What a call gives: arrays over named dimensions, and everything else as a study has it."""

    caller: str
    arrays: dict[str, xarray.DataArray] = field(default_factory=dict)
    """Parameters over named dimensions, as numbers (in SI units); an axis has the name of its parameter."""
    fixed: dict[str, Any] = field(default_factory=dict)
    """Parameters that are no arrays: numbers, quantities with units, ranges, and what is none of these."""
    settings: dict[str, Any] = field(default_factory=dict)
    """The other keys of a study, in their tables."""
    mistakes: list[str] = field(default_factory=list)
    unread: set[str] = field(default_factory=set)
    """Parameters that could not be read, so that they are not missing."""

    @property
    def is_grid(self) -> bool:
        """Whether every array is an axis, as in a study."""
        return all(array.dims == (name,) for name, array in self.arrays.items())

    @property
    def is_points(self) -> bool:
        """Whether all arrays are lists of points, as in a study."""
        ranges = any(isinstance(value, Mapping) for value in self.fixed.values())
        return bool(self.arrays) and not ranges and all(array.dims == (SCENE,) for array in self.arrays.values())

    def refuse(self, what: str, sentence: str) -> None:
        """Note a mistake."""
        self.mistakes.append(f"{self.caller}: {what}: {sentence}")

    def study(self) -> Study:
        """
        Check everything as a study is checked; of long arrays the ends of their values stand in it.

        Raises
        ------
        StudyError
            Something is wrong; the error lists all of them.
        """
        ends = {name: _ends(array) for name, array in self.arrays.items()}
        short = {name: [array.values.flat[i] for i in ends[name]] for name, array in self.arrays.items()}
        if not self.is_grid and "k" in short:  # whether k = 1 meets nu = 1/2 is asked of each scene instead
            short["k"] = list(dict.fromkeys(0.5 if value == 1.0 else value for value in short["k"]))
            self._check_stiffness()
        try:
            study = study_from(self._data(short), self.caller)
        except StudyError as error:
            found = [_with_own_index(without_tables(sentence), self.arrays, ends) for sentence in error.mistakes]
            unread = tuple(f"{self.caller}: {name}: this " for name in self.unread)
            raise StudyError([*self.mistakes, *(one for one in found if not one.startswith(unread))]) from None
        if self.mistakes:
            raise StudyError(self.mistakes)
        return study

    def parameters(self, study: Study) -> dict[str, float | xarray.DataArray]:
        """
        Give every parameter of the checked study: a number, or an array over its dimensions.

        Of points all of them are arrays over all points.
        """
        found = {
            name: self.arrays[name] if name in self.arrays else _named(name, values)
            for name, values in study.parameters.items()
        }
        if not self.is_points:
            return found
        points = next(iter(self.arrays.values()))
        return {name: xarray.DataArray(value).broadcast_like(points) for name, value in found.items()}

    def text(self, study: Study) -> str:
        """Write the checked study in TOML that gives just these scenes; nothing if there is none that is short."""
        if not self.arrays:
            return study.text
        values = [array.values for array in self.arrays.values()]
        ordered = self.is_points or (
            self.is_grid and all(np.all(np.diff(axis) > 0) or np.all(np.diff(axis) < 0) for axis in values)
        )
        if not ordered or sum(axis.size for axis in values) > MOST_LISTED:
            return ""
        return text_of(self.whole(), study)

    def whole(self) -> dict[str, Any]:
        """Give all of it as the keys of a study; every array is an axis, or all are lists of points."""
        layout = "points" if self.is_points else "grid"
        return self._data({name: array.values.tolist() for name, array in self.arrays.items()}, layout)

    def check_threads(self, threads: object) -> None:
        """Check the number of threads."""
        if threads is not None and not (isinstance(threads, int) and threads >= 1):
            self.refuse(f"threads = {threads!r}", "the number of threads is 1 or more, or None for all processors")

    def _data(self, arrays: Mapping[str, Sequence[float]], layout: str = "grid") -> dict[str, Any]:
        """Give the keys of a study, with these values for the arrays."""
        data = {key: {**value} if isinstance(value, Mapping) else value for key, value in self.settings.items()}
        data.setdefault("parameters", {})
        if layout != "grid":
            data["layout"] = layout
        given = {name: arrays.get(name, self.fixed.get(name)) for name in (*self.fixed, *arrays)}
        for name, value in sorted(given.items(), key=lambda item: [*INPUTS, item[0]].index(item[0])):
            key = name if name in INPUTS else nearest(name, list(INPUTS)) or "k"
            data.setdefault(INPUTS[key].table, {})[name] = _with_unit(name, value)
        return data

    def _check_stiffness(self) -> None:
        """Check that the surface has a stiffness in every scene."""
        k, nu = (self.arrays.get(name, self.fixed.get(name)) for name in ("k", "nu"))
        if self.mistakes or not isinstance(nu, float | xarray.DataArray):
            return
        wrong = (k == 1.0) & (nu != 0.5)
        if bool(np.any(wrong)):
            self.refuse("k = 1.0", "with k = 1 and nu other than 0.5 the surface has no stiffness; use nu = 0.5 there")


def _named(name: str, values: Values) -> float | xarray.DataArray:
    """Give the axis of a study its dimension."""
    return values if isinstance(values, float) else xarray.DataArray(values, dims=(name,), coords={name: values})


def _ends(array: xarray.DataArray) -> list[int]:
    """Find the least and the greatest value, or the first that is not a number."""
    return [*dict.fromkeys((int(np.argmin(array.values)), int(np.argmax(array.values))))]


def _with_unit(name: str, value: Any) -> Any:
    """Write numbers in SI units as a study has them: with the unit."""
    if isinstance(value, list):
        return [_with_unit(name, one) for one in value]
    if isinstance(value, Mapping):
        return {key: _with_unit(name, one) if key in ("start", "stop") else one for key, one in value.items()}
    if name in PHYSICAL and isinstance(value, int | float | np.number) and not isinstance(value, bool):
        return f"{float(value)!r} {PHYSICAL[name].unit}"
    return value


def _with_own_index(sentence: str, arrays: Mapping[str, xarray.DataArray], ends: Mapping[str, Sequence[int]]) -> str:
    """Name the item of an array, not that of its ends."""
    found = re.match(r"(gr\.\w+: (\w+))\[(\d)\]", sentence)
    if not found or found[2] not in arrays:
        return sentence
    index = np.unravel_index(ends[found[2]][int(found[3])], arrays[found[2]].shape)
    return f"{found[1]}[{', '.join(map(str, index))}]{sentence[found.end() :]}"
