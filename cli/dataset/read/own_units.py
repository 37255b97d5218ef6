"""Datasets whose variables were given other units, as pint-xarray does, in the units that our files have."""

from typing import TYPE_CHECKING

from gradhesion.cli.names.units import unit_of
from gradhesion.cli.study.text.foreign import apart, filled
from gradhesion.cli.study.text.quantities import factor_between, scaled

if TYPE_CHECKING:
    from xarray import Dataset


def in_own_units(dataset: "Dataset") -> "Dataset":
    """
    Give a dataset with plain numbers in the units of our files, whether it was quantified or its units were changed.

    Values of a file are only read where they change.
    """
    changed = {}
    for name, variable in dataset.variables.items():
        own = unit_of(str(name))
        written = variable.attrs.get("units")
        numbers, unit = (variable, str(written)) if written is not None else apart(dataset[name])
        if not unit or written == own:
            continue
        factor = factor_between(unit, own)
        if factor:
            values = None if factor == 1 and written is not None else filled(numbers)
            values = values if values is None or factor == 1 else scaled(values, factor)
            plain = variable.copy(deep=False, data=values)
            plain.attrs = variable.attrs | {"units": own}
            changed[name] = plain
    return dataset.assign(changed) if changed else dataset
