"""What a call in Python gives, checked as a study is: numbers, quantities with units, axes and named dimensions."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, is_dataclass
from typing import Any, Final

import numpy as np
import xarray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.names.outputs import OUTPUTS, PARAMETER, PHYSICAL_PARAMETER
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.study.reading import study_from, text_of
from gradhesion.cli.study.rules.asked import repeated
from gradhesion.cli.study.rules.scenes import MOST_SCENES
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.text.quantities import as_written
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL
from gradhesion.values import array_of, numbers_of

MOST_LISTED: Final = 10_000
"""Values of all axes together up to which a dataset keeps them in the text of its study as well."""

HOMES: Final = {"control": "loading", "solver": "method", "check_contact": "method", "contact_radius_over_R": "states"}
"""The tables of a study that arguments of a call stand in; a sentence about one names the argument alone."""


class Given:
    """What a call gives, which messages name: arrays over named dimensions, and everything else as a study has it.

    Keywords (`more`) stand in the place of parameters in the mapping; `settings` are the arguments that stand for other
    keys of a study. What is wrong is noted, and raised by `study`.
    """

    def __init__(
        self, caller: str, parameters: Any, more: Mapping[str, Any], settings: Mapping[str, Any], threads: object
    ) -> None:
        self.caller = caller
        self.settings = _settings(settings)
        """Keys of a study beside its parameters, in their tables."""
        self.arrays = dict[str, xarray.DataArray]()
        """Parameters over named dimensions, as numbers (in SI units); an axis has the name of its parameter."""
        self.fixed = dict[str, Any]()
        """Parameters that are no arrays: numbers, quantities with units, ranges, and what is none of these."""
        self.mistakes = list[str]()
        self.unread = set[str]()
        """Parameters that could not be read, so that they are not missing."""
        arguments = [*settings, "threads"]
        for key, value in {**self._table(parameters), **more}.items():
            name = str(key)
            near = name if name in INPUTS else nearest(name, [*INPUTS, *arguments])
            if near not in INPUTS:
                hint = did_you_mean(name, list(INPUTS) if near is None else arguments)
                self.refuse(name, f"unknown argument; {hint}")
            elif name not in INPUTS or isinstance(value, str | Mapping) or value is None:
                self.fixed[name] = as_written(value, bare=name not in PHYSICAL)
            elif isinstance(value, float):
                self.fixed[name] = float(value) + 0.0  # no negative zero; what most calls give needs no array
            else:
                self._take(name, value)
        self._check_dimensions()
        sizes = {dim: size for array in self.arrays.values() for dim, size in array.sizes.items()}
        count, most = math.prod(sizes.values()), MOST_SCENES[settings.get("kind", "map")]
        if count > most:
            self.refuse("parameters", f"they make {count:,} scenes, more than {most:,}; use fewer values")
        if threads is not None and not (isinstance(threads, int) and threads >= 1):
            self.refuse(f"threads = {threads!r}", "the number of threads is 1 or more, or None for all processors")

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
        """Check everything as a study is checked; of arrays the ends of their values stand in it.

        StudyError lists all that is wrong.
        """
        short = {name: self._ends(name, array) for name, array in self.arrays.items()}
        if not self.is_grid and "k" in short:  # whether k = 1 meets nu = 1/2 is asked of each scene instead
            short["k"] = list(dict.fromkeys(0.5 if value == 1.0 else value for value in short["k"]))
            k, nu = (self.arrays.get(name, self.fixed.get(name)) for name in ("k", "nu"))
            known = not self.mistakes and isinstance(nu, float | xarray.DataArray)
            if known and bool(np.any((k == 1.0) & (nu != 0.5))):
                sentence = "with k = 1 and nu other than 0.5 the surface has no stiffness; use nu = 0.5 there"
                self.refuse("k = 1.0", sentence)
        found: list[str] = []
        try:
            study = study_from(self._data({name: ends for name, ends in short.items() if ends}), self.caller)
        except StudyError as error:
            tables = "|".join({*HOMES.values(), *(one.table for one in INPUTS.values())})  # an argument has none
            found = [re.sub(rf"^({self.caller}: )(?:{tables})\.", r"\1", sentence) for sentence in error.mistakes]
        unread = tuple(f"{self.caller}: {name}: this " for name in self.unread)
        if mistakes := self.mistakes + [one for one in found if not one.startswith(unread)]:
            raise StudyError(mistakes)
        return study

    def parameters(self, study: Study) -> dict[str, float | xarray.DataArray]:
        """Give every parameter of the checked study: a number, or an array over its dimensions.

        Of points all of them are arrays over all points.
        """
        found: dict[str, float | xarray.DataArray] = {}
        for name, values in study.parameters.items():
            if name in self.arrays:
                found[name] = self.arrays[name]
            elif isinstance(values, float):
                found[name] = values
            else:
                found[name] = xarray.DataArray(values, dims=(name,), coords={name: values})
        if not self.is_points:
            return found
        points = next(iter(self.arrays.values()))
        return {name: xarray.DataArray(value).broadcast_like(points) for name, value in found.items()}

    def text(self, study: Study) -> str:
        """Write the checked study in TOML that gives just these scenes; nothing if there is none that is short."""
        if not self.arrays:
            return study.text
        ordered = self.is_points or (self.is_grid and all(is_monotone(array.values) for array in self.arrays.values()))
        is_short = sum(array.size for array in self.arrays.values()) <= MOST_LISTED
        return text_of(self.whole(), study) if ordered and is_short else ""

    def whole(self) -> dict[str, Any]:
        """Give all of it as the keys of a study; every array is an axis, or all are lists of points."""
        layout = {"layout": "points"} if self.is_points else {}
        return self._data({name: array.values.tolist() for name, array in self.arrays.items()}) | layout

    def _table(self, parameters: Any) -> Mapping[Any, Any]:
        """Take the parameters in a mapping, or in the columns of a table of pandas."""
        if hasattr(parameters, "columns") and hasattr(parameters, "to_xarray"):
            for name in sorted({*map(str, parameters.columns[parameters.columns.duplicated()])}):
                self.unread.add(name)
                self.refuse(name, "the table has more than one column of this name; keep one of them")
            return {name: parameters[name] for name in parameters.columns if str(name) not in self.unread}
        if parameters is not None and not isinstance(parameters, Mapping):
            kind = type(parameters).__name__
            self.refuse("parameters", f"a mapping from names to values is expected, not a {kind}")
        return parameters if isinstance(parameters, Mapping) else {}

    def _take(self, name: str, value: Any) -> None:
        """Take a parameter that is known and no string: a number, an axis, or an array over named dimensions."""
        try:
            array = array_of(name, value)
            numbers = numbers_of(name, array)
        except ValueError as error:
            self.refuse(name, str(error))
            self.unread.add(name)
            return
        if numbers is None or array.size == 0:
            self.fixed[name] = as_written(array.values)
        elif array.ndim == 0:
            self.fixed[name] = float(numbers)
        else:
            taken, is_axis = array.copy(data=numbers), array.dims == (name,)
            self.arrays[name] = taken.assign_coords({name: numbers}) if is_axis else taken
            for _, sentence in repeated(name, numbers) if is_axis else ():
                self.refuse(name, sentence)

    def _check_dimensions(self) -> None:
        """Check that the dimensions of all arrays go together."""
        taken = {*OUTPUTS, *INPUTS, SOLVER, PARAMETER, PHYSICAL_PARAMETER, "status"}
        taken -= {name for name, array in self.arrays.items() if array.dims == (name,)}
        for name, array in self.arrays.items():
            for dim in sorted(taken & {*map(str, array.dims)}):
                sentence = f'its dimension "{dim}" has the name of a variable, or of a parameter that is not an axis'
                self.refuse(name, f"{sentence}; rename it, or give {dim} as a list")
        try:
            xarray.align(*(array.reset_coords(drop=True) for array in self.arrays.values()), join="exact", copy=False)
        except ValueError:
            sizes = "; ".join(f"{name} over {dict(array.sizes)}" for name, array in self.arrays.items())
            sentence = f"dimensions of the same name differ in length or coordinates ({sizes}); rename one of them"
            self.refuse("parameters", sentence)

    def _ends(self, name: str, array: xarray.DataArray) -> list[float]:
        """Find the least and the greatest value of an array, those out of range aside, which are refused."""
        inside = np.asarray(INPUTS[name].admits(array.values))
        if not inside.all():
            index = np.unravel_index(int(np.argmin(inside)), array.shape)
            what = f"{name}[{', '.join(map(str, index))}] = {float(array.values[index])!r}"
            self.refuse(what, f"out of range; choose a value with {INPUTS[name].allowed}")
            self.unread.add(name)
        values = array.values[inside]
        return [*dict.fromkeys((float(values.min()), float(values.max())))] if values.size else []

    def _data(self, arrays: Mapping[str, Sequence[float]]) -> dict[str, Any]:
        """Give the keys of a study, with these values for the arrays."""
        data = {key: {**value} if isinstance(value, Mapping) else value for key, value in self.settings.items()}
        data.setdefault("parameters", {})
        given = {**self.fixed, **arrays}
        for name in sorted(given, key=[*INPUTS, *given].index):
            key = name if name in INPUTS else nearest(name, list(INPUTS)) or "k"
            data.setdefault(INPUTS[key].table, {})[name] = _with_unit(name, given[name])
        return data


def _settings(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Put the arguments of a call into the tables of a study, leaving out those that are None."""
    found = {key: value for key, value in settings.items() if value is not None}
    outputs = found.get("outputs")
    if isinstance(outputs, Iterable):
        found["outputs"] = [outputs] if isinstance(outputs, str) else list(outputs)
        found.setdefault("title", ", ".join(map(str, found["outputs"])))
    for key in ("profile", "toughness", "rate"):
        if is_dataclass(own := found.get(key)) and not isinstance(own, type):
            found[key] = as_written(asdict(own))
    if "contact_radius_over_R" in found:
        radii = as_written(found["contact_radius_over_R"])
        found["contact_radius_over_R"] = radii if isinstance(radii, list) else [radii]
    for key in found.keys() & HOMES.keys():
        found.setdefault(HOMES[key], {})[key] = found.pop(key)
    return found


def is_monotone(values: Any) -> bool:
    """Report whether values rise or fall throughout."""
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def _with_unit(name: str, value: Any) -> Any:
    """Write numbers in SI units as a study has them: with the unit."""
    if isinstance(value, list):
        return [_with_unit(name, one) for one in value]
    if isinstance(value, Mapping):
        return {key: _with_unit(name, one) if key in ("start", "stop") else one for key, one in value.items()}
    if name in PHYSICAL and isinstance(value, int | float | np.number) and not isinstance(value, bool):
        return f"{float(value)!r} {PHYSICAL[name].unit}"
    return value
