"""The arguments of a call in Python taken apart: which are parameters, which arrays, and which keys of a study."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, is_dataclass
from typing import Any, Final

import xarray

from gradhesion.cli.names.outputs import OUTPUTS, PARAMETER, PHYSICAL_PARAMETER
from gradhesion.cli.names.scenes import SOLVER
from gradhesion.cli.study.rules.axes import repeated
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.rules.mistakes import tables_of
from gradhesion.cli.study.rules.scenes import MOST_SCENES
from gradhesion.cli.study.text.foreign import as_written
from gradhesion.cli.terminal.wording import did_you_mean, nearest
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL
from gradhesion.given import Given
from gradhesion.values import array_of, numbers_of

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

_TABLES: Final = ("parameters", "physical", "loading", "states", "method")


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
    most = MOST_SCENES[settings.get("kind", "map")]
    if count > most:
        given.refuse("parameters", f"they make {count:,} scenes, more than {most:,}; use fewer values")
    return given


def _take(given: Given, name: str, value: Any) -> None:
    """Take one parameter."""
    keys = {*ARGUMENTS, *_TABLES, *(key for table in tables_of(Form).values() for key in table.model_fields)}
    if name not in INPUTS and name in keys:
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
        for _, sentence in repeated(name, numbers) if array.dims == (name,) else ():
            given.refuse(name, sentence)


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
    outputs = found.get("outputs")
    if isinstance(outputs, str):
        found["outputs"] = [outputs]
    elif isinstance(outputs, Iterable):
        found["outputs"] = list(outputs)
    if isinstance(found.get("outputs"), list):
        found.setdefault("title", ", ".join(map(str, found["outputs"])))
    for key in ("profile", "toughness", "rate"):
        if is_dataclass(own := found.get(key)) and not isinstance(own, type):
            found[key] = as_written(asdict(own))
    if "contact_radius_over_R" in found:
        radii = as_written(found["contact_radius_over_R"])
        found["contact_radius_over_R"] = radii if isinstance(radii, list) else [radii]
    homes = {"control": "loading", "solver": "method", "check_contact": "method", "contact_radius_over_R": "states"}
    for key, table in homes.items():
        if key in found:
            found.setdefault(table, {})[key] = found.pop(key)
    return found
