"""Parameters of a call in Python: numbers, quantities with units, axes, and arrays over named dimensions."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Final

import numpy as np
import xarray

from gradhesion.cli.errors import StudyError
from gradhesion.cli.keys import INPUTS, PHYSICAL, SETTINGS
from gradhesion.cli.names.outputs import OUTPUTS, PARAMETER, PHYSICAL_PARAMETER
from gradhesion.cli.names.scenes import SCENE, SOLVER
from gradhesion.cli.study.form.axes import Values, mistakes_of_grid
from gradhesion.cli.study.form.kinds import KINDS
from gradhesion.cli.study.reading import study_from, text_of
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.text.foreign import as_written
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.rate import Rate
from gradhesion.core.problem.toughness import Toughness
from gradhesion.values import array_of, numbers_of
from gradhesion.wording import without_tables

ARGUMENTS: Final = (
    "outputs",
    "profile",
    "control",
    "toughness",
    "rate",
    "contact_radius_over_R",
    "solver",
    "check_contact",
    "threads",
    "title",
)
"""What `solve` takes beside parameters; they are no parameters themselves."""

MOST_LISTED: Final = 10_000
"""Values of all axes together up to which a dataset keeps them in the text of its study as well."""

_TABLES: Final = ("parameters", "physical", "loading", "states", "method")


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


def given_in(
    caller: str, parameters: Mapping[str, Any] | None, more: Mapping[str, Any], settings: Mapping[str, Any]
) -> Given:
    """
    Take the parameters of a call apart.

    Parameters
    ----------
    caller
        The function that is called, for messages.
    parameters, more
        Parameters by name, in a mapping and as keywords; these stand in the place of those in the mapping.
    settings
        The arguments that stand for keys of a study: outputs, profile, control, solver, check_contact, title, kind.
    """
    given = Given(caller=caller, settings=_settings(settings))
    table: Any = {} if parameters is None else parameters
    if hasattr(table, "columns") and hasattr(table, "to_xarray"):  # pandas
        given.unread |= {*map(str, table.columns[table.columns.duplicated()])}
        for name in sorted(given.unread):
            given.refuse(name, "the table has more than one column of this name; keep one of them")
        table = {name: table[name] for name in table.columns if str(name) not in given.unread}
    if not isinstance(table, Mapping):
        given.refuse("parameters", f"a mapping from names to values is expected, not a {type(table).__name__}")
        table = {}
    for name, value in {**table, **more}.items():
        _take(given, str(name), value)
    _align(given)
    count = math.prod(dict(_sizes(given)).values())
    most = KINDS[settings.get("kind", "map")].most_scenes
    if count > most:
        given.refuse("parameters", f"they make {count:,} scenes, more than {most:,}; use fewer values")
    return given


def _take(given: Given, name: str, value: Any) -> None:
    """Take one parameter."""
    if name not in INPUTS and (name in SETTINGS or name in ARGUMENTS or name in _TABLES):
        given.refuse(name, "a key of a study, not a parameter; give it as a keyword, or call gr.run with the study")
    elif name not in INPUTS and (near := nearest(name, [*INPUTS, *ARGUMENTS])) in ARGUMENTS:
        given.refuse(name, f'unknown argument; did you mean "{near}"?')
    elif name not in INPUTS and near is None:
        given.refuse(name, f"unknown parameter; {did_you_mean(name, list(INPUTS))}")
    elif name not in INPUTS or isinstance(value, str | Mapping) or value is None:
        given.fixed[name] = as_written(value, bare=name not in PHYSICAL)
    elif isinstance(value, float):
        given.fixed[name] = float(value) + 0.0  # no negative zero; what most calls give needs no array
    else:
        _take_values(given, name, value)


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
        for mistake in mistakes_of_grid({name: numbers}) if array.dims == (name,) else ():
            given.refuse(name, mistake.sentence)


def _align(given: Given) -> None:
    """Check that the dimensions of all arrays go together."""
    taken = {*OUTPUTS, SOLVER, PARAMETER, PHYSICAL_PARAMETER, "status"}
    for name, array in given.arrays.items():
        for dim in map(str, array.dims):
            if dim in taken:
                given.refuse(name, f'its dimension "{dim}" has the name of a variable; rename it')
            elif dim in INPUTS and (dim not in given.arrays or given.arrays[dim].dims != (dim,)):
                sentence = (
                    f'its dimension "{dim}" has the name of a parameter that is not an axis; rename it, or give {dim}'
                )
                given.refuse(name, f"{sentence} as a list")
    arrays = {name: array.reset_coords(drop=True) for name, array in given.arrays.items()}
    try:
        xarray.align(*arrays.values(), join="exact", copy=False)
    except ValueError:
        sizes = "; ".join(
            f"{name} over {', '.join(f'{dim} ({size})' for dim, size in array.sizes.items())}"
            for name, array in arrays.items()
        )
        given.refuse(
            "parameters",
            f"dimensions of the same name differ in length or coordinates ({sizes}); rename one of them",
        )


def _sizes(given: Given) -> list[tuple[str, int]]:
    """Give the lengths of all dimensions."""
    return [(str(dim), size) for array in given.arrays.values() for dim, size in array.sizes.items()]


def _settings(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Put the arguments of a call into the tables of a study, leaving out those that are None."""
    found = {key: value for key, value in settings.items() if value is not None}
    if isinstance(outputs := found["outputs"], str):
        found["outputs"] = [outputs]
    elif isinstance(outputs, Iterable):
        found["outputs"] = list(outputs)
    if isinstance(found["outputs"], list):
        found.setdefault("title", ", ".join(map(str, found["outputs"])))
    if isinstance(profile := found.get("profile"), Profile):
        waves = [{"n": wave.n, "cos": wave.cos, "sin": wave.sin} for wave in profile.harmonics]
        found["profile"] = {"exponent": profile.exponent, "harmonics": waves}
    if isinstance(toughness := found.get("toughness"), Toughness):
        waves = [{"n": wave.n, "cos": wave.cos, "sin": wave.sin} for wave in toughness.harmonics]
        found["toughness"] = {"harmonics": waves, "of": toughness.of}
    if isinstance(rate := found.get("rate"), Rate):
        found["rate"] = asdict(rate)
    if "contact_radius_over_R" in found:
        radii = as_written(found["contact_radius_over_R"])
        found["contact_radius_over_R"] = radii if isinstance(radii, list) else [radii]
    homes = {"control": "loading", "solver": "method", "check_contact": "method", "contact_radius_over_R": "states"}
    for key, table in homes.items():
        if key in found:
            found.setdefault(table, {})[key] = found.pop(key)
    return found


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
