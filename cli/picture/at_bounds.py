"""Which optima of a dataset are at a bound of what was searched."""

import xarray

from gradhesion.cli.names.outputs import BEST, ON_BOUND


def at_bound(dataset: xarray.Dataset, name: str) -> xarray.DataArray | None:
    """
    Report which scenes have an optimum at a bound: of a parameter that was searched at its own, else at any.

    None where the dataset has no optima, or the variable is not of them.
    """
    if ON_BOUND not in dataset or not name.startswith(BEST):
        return None
    flags = dataset[ON_BOUND]
    meanings = str(flags.attrs["flag_meanings"]).split()
    own = [one for one in meanings if one.startswith(f"{name.removeprefix(BEST)}_at_its_")] or meanings
    return (flags.astype(int) & sum(1 << meanings.index(one) for one in own)) != 0
