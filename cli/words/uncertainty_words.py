"""The uncertain inputs of a dataset in words."""

import tomllib
from collections.abc import Iterator, Mapping
from contextlib import suppress

import xarray


def uncertainty_lines(dataset: xarray.Dataset) -> Iterator[str]:
    """Say which inputs are uncertain, by how much, and how many samples were drawn; nothing of another dataset."""
    table: object = None
    with suppress(ValueError, RecursionError):
        table = tomllib.loads(str(dataset.attrs.get("study", ""))).get("uncertainty")
    if not isinstance(table, Mapping):
        return
    yield ""
    samples = table.get("samples", 0)
    yield "uncertain inputs" + (f", {samples:,} samples" if isinstance(samples, int) and samples else "")
    for name, value in table.items():
        if name in ("samples", "seed"):
            continue
        if isinstance(value, Mapping):
            yield f"  {name:<17} uniform from {value.get('low')} to {value.get('high')}"
        else:
            yield f"  {name:<17} standard deviation {value}" + (" of the value" if str(value).endswith("%") else "")
