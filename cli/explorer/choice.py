"""What of a dataset goes into a page: variables by name, single values of axes, and no more than a browser takes."""

from collections.abc import Sequence
from typing import Final

import xarray

from gradhesion.cli.dataset.read.reader import has_curves
from gradhesion.cli.dataset.read.selection import selection_of
from gradhesion.cli.dataset.read.sensitivities import parts_of, spread
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import RAGGED, STATE_CURVES, curve_of
from gradhesion.cli.names.outputs import PARETO_POINT, SI
from gradhesion.cli.picture.curves import wants_si
from gradhesion.cli.terminal.wording import did_you_mean

MOST: Final = 20_000_000
"""Values in a page: it is 110 MB then, and takes a browser some seconds to open."""


def chosen(dataset: xarray.Dataset, variables: Sequence[str], places: Sequence[str]) -> xarray.Dataset:
    """Cut a dataset down to some variables and to some values of axes; `status` stays.

    See Also
    --------
    gradhesion.cli.dataset.read.selection : how a value is found on an axis.
    """
    if PARETO_POINT in dataset.dims:
        raise DatasetError("Pareto fronts have no page; draw them with `gradhesion plot`")
    parts = [str(name) for name in dataset.data_vars if parts_of(dataset, str(name))]
    dataset = spread(dataset).drop_vars(parts)
    scenes = dataset["status"].dims
    hidden = ("status", *(name for name in dataset.data_vars if curve_of(str(name)) in (*RAGGED, *STATE_CURVES)))
    known = [
        str(name) for name in dataset.data_vars if name not in hidden and dataset[name].dims[: len(scenes)] == scenes
    ]
    for name in variables:
        if name not in known:
            raise DatasetError(f"--variable {name}: a page cannot show it; {did_you_mean(name, known)}")
    if not known:
        raise DatasetError(
            "jumps are not drawn: `gradhesion info --jumps` lists them; "
            'for a page of the cycle add "path" to the outputs of the study'
        )
    if has_curves(dataset):
        shown = variables or [name for name in known if name + SI not in known]  # curves are drawn in units alone
        wants_si(shown, variables)
    else:  # those in units first, and last what is there in units too
        shown = variables or sorted(known, key=lambda name: (name + SI in known, not name.endswith(SI)))
    cut = dataset[[*shown, "status"]]
    cut = selection_of(cut, places).narrowed(cut)
    size = sum(variable.size for variable in cut.data_vars.values())
    if size > MOST:
        raise DatasetError(
            f"{size:,} values are too many for a page, which takes {MOST:,}: choose one value of an axis with --at, as "
            f"in --at AXIS=VALUE, or fewer variables with --variable, or make a coarser study"
        )
    return cut
