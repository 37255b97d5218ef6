"""What a call in Python gives, checked as a study is: numbers, quantities with units, axes and named dimensions."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, is_dataclass
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
        try:
            study = study_from(self._data({name: ends for name, ends in short.items() if ends}), self.caller)
        except StudyError as error:
            unread = tuple(f"{self.caller}: {name}: this " for name in self.unread)
            found = [one for one in map(self._without_table, error.mistakes) if not one.startswith(unread)]
            raise StudyError([*self.mistakes, *found]) from None
        if self.mistakes:
            raise StudyError(self.mistakes)
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
        values = [array.values for array in self.arrays.values()]
        ordered = self.is_points or (self.is_grid and all(map(is_monotone, values)))
        if not ordered or sum(axis.size for axis in values) > MOST_LISTED:
            return ""
        return text_of(self.whole(), study)

    def whole(self) -> dict[str, Any]:
        """Give all of it as the keys of a study; every array is an axis, or all are lists of points."""
        layout = {"layout": "points"} if self.is_points else {}
        return self._data({name: array.values.tolist() for name, array in self.arrays.items()}) | layout

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

    def _without_table(self, sentence: str) -> str:
        """Name an argument in the place of a key of a study, which stands in a table."""
        table, dot, rest = sentence.removeprefix(f"{self.caller}: ").partition(".")
        known = {*HOMES.values(), *(one.table for one in INPUTS.values())}
        return f"{self.caller}: {rest}" if dot and table in known else sentence


def given_in(
    caller: str,
    parameters: Mapping[str, Any] | None,
    more: Mapping[str, Any],
    settings: Mapping[str, Any],
    threads: object = None,
) -> Given:
    """Take the arguments of a call apart, which is named in messages: parameters in a mapping, and as keywords.

    These stand in the place of those in the mapping; `settings` are the arguments that stand for other keys of a study.
    """
    given = Given(caller=caller, settings=_settings(settings))
    table: Any = {} if parameters is None else parameters
    if hasattr(table, "columns") and hasattr(table, "to_xarray"):  # pandas
        for name in sorted({*map(str, table.columns[table.columns.duplicated()])}):
            given.unread.add(name)
            given.refuse(name, "the table has more than one column of this name; keep one of them")
        table = {name: table[name] for name in table.columns if str(name) not in given.unread}
    if not isinstance(table, Mapping):
        given.refuse("parameters", f"a mapping from names to values is expected, not a {type(table).__name__}")
        table = {}
    arguments = [*settings, "threads"]
    for key, value in {**table, **more}.items():
        name = str(key)
        near = name if name in INPUTS else nearest(name, [*INPUTS, *arguments])
        if near not in INPUTS:
            given.refuse(name, f"unknown argument; {did_you_mean(name, list(INPUTS) if near is None else arguments)}")
        elif name not in INPUTS or isinstance(value, str | Mapping) or value is None:
            given.fixed[name] = as_written(value, bare=name not in PHYSICAL)
        elif isinstance(value, float):
            given.fixed[name] = float(value) + 0.0  # no negative zero; what most calls give needs no array
        else:
            _take_values(given, name, value)
    _align(given)
    count = math.prod({dim: size for array in given.arrays.values() for dim, size in array.sizes.items()}.values())
    most = MOST_SCENES[settings.get("kind", "map")]
    if count > most:
        given.refuse("parameters", f"they make {count:,} scenes, more than {most:,}; use fewer values")
    if threads is not None and not (isinstance(threads, int) and threads >= 1):
        given.refuse(f"threads = {threads!r}", "the number of threads is 1 or more, or None for all processors")
    return given


def _take_values(given: Given, name: str, value: Any) -> None:
    """Take a parameter that is known and no string: a number, an axis, or an array over named dimensions."""
    try:
        array = array_of(name, value)
        numbers = numbers_of(name, array)
    except ValueError as error:
        given.refuse(name, str(error))
        given.unread.add(name)
        return
    if numbers is None or array.size == 0:
        given.fixed[name] = as_written(array.values)
    elif array.ndim == 0:
        given.fixed[name] = float(numbers)
    else:
        taken = array.copy(data=numbers)
        given.arrays[name] = taken.assign_coords({name: numbers}) if array.dims == (name,) else taken
        for _, sentence in repeated(name, numbers) if array.dims == (name,) else ():
            given.refuse(name, sentence)


def _align(given: Given) -> None:
    """Check that the dimensions of all arrays go together."""
    taken = {*OUTPUTS, *INPUTS, SOLVER, PARAMETER, PHYSICAL_PARAMETER, "status"}
    taken -= {name for name, array in given.arrays.items() if array.dims == (name,)}
    for name, array in given.arrays.items():
        for dim in sorted(taken & {*map(str, array.dims)}):
            sentence = f'its dimension "{dim}" has the name of a variable, or of a parameter that is not an axis'
            given.refuse(name, f"{sentence}; rename it, or give {dim} as a list")
    try:
        xarray.align(*(array.reset_coords(drop=True) for array in given.arrays.values()), join="exact", copy=False)
    except ValueError:
        sizes = "; ".join(f"{name} over {dict(array.sizes)}" for name, array in given.arrays.items())
        sentence = f"dimensions of the same name differ in length or coordinates ({sizes}); rename one of them"
        given.refuse("parameters", sentence)


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
