"""Sensitivities of a dataset, one variable for each thing that they are to, and which of them is the strongest."""

from typing import Final

import numpy as np
import xarray
from numpy.typing import NDArray

from gradhesion.cli.names.outputs import BEST, OF_PHYSICAL, labels_of
from gradhesion.core.problem.names import SENSITIVITIES

PLAIN: Final = ("k", "nu")
"""What has no logarithm: the strongest is looked for among the others."""


def parts_of(dataset: xarray.Dataset, name: str) -> dict[str, str]:
    """Name the variables that a sensitivity is spread into, with what each is to; none for another variable."""
    dimension = labels_of(name)
    if not dimension or name not in dataset.data_vars or dimension not in dataset[name].dims:
        return {}
    return {f"{name}_{label}": str(label) for label in dataset[dimension].values}


def part_of(name: str) -> tuple[str, str] | None:
    """Name the sensitivity that a variable is a part of, and what this part is to; None for another variable.

    >>> part_of("best_pull_off_force_sensitivity_A"), part_of("dissipated_energy_sensitivity_physical_R")
    (('best_pull_off_force_sensitivity', 'A'), ('dissipated_energy_sensitivity_physical', 'R'))
    """
    for output in SENSITIVITIES:
        head, found, label = name.partition(f"{output}_")
        if found and head in ("", BEST):
            physical = OF_PHYSICAL if f"_{label}".startswith(f"{OF_PHYSICAL}_") else ""
            return f"{head}{output}{physical}", f"_{label}"[len(physical) + 1 :]
    return None


def spread(dataset: xarray.Dataset) -> tuple[xarray.Dataset, dict[str, list[str]]]:
    """Give each sensitivity as variables over the scenes alone: the strongest, by its place, and one a parameter.

    The first has the name of the sensitivity and numbers the parameters from 0 on in the order of its `parameters`;
    the others have the name of the parameter added, and are listed by that of the sensitivity as well.
    """
    made: dict[str, xarray.DataArray] = {}
    parts: dict[str, list[str]] = {}
    for name, variable in ((str(name), one) for name, one in dataset.data_vars.items()):
        own = parts_of(dataset, name)
        if not own:
            made[name] = variable
            continue
        parts[name], labels = [*own], [*own.values()]
        each = [variable.isel({labels_of(name): i}, drop=True) for i in range(len(own))]
        place = strongest(variable.values, labels)
        made[name] = each[0].copy(data=np.where(place < 0, np.nan, place)).assign_attrs(parameters=" ".join(labels))
        made |= zip(own, each, strict=True)
    whole = dataset.drop_vars([*parts, *map(labels_of, parts)]).assign(made)[list(made)] if parts else dataset
    return whole, parts


def parameters_of(variable: xarray.DataArray) -> list[str]:
    """List what the values of a variable number, if they say which parameter is the strongest; else nothing."""
    return str(variable.attrs.get("parameters", "")).split()


def strongest(values: NDArray[np.float64], labels: list[str]) -> NDArray[np.int64]:
    """Find which item along the last axis is the largest in size; -1 where there is none, or all are 0.

    k and nu stand apart, since theirs are no sensitivities to a relative change.

    >>> strongest(np.array([[9.0, -2.0, 1.0], [9.0, 0.0, 0.0]]), ["k", "A", "modulus"])
    array([ 1, -1])
    """
    sizes = np.abs(values)
    sizes[..., [label in PLAIN for label in labels]] = 0.0
    sizes = np.where(np.isfinite(sizes), sizes, 0.0)
    return np.where(sizes.max(axis=-1) > 0.0, sizes.argmax(axis=-1), -1)
