"""What a page needs to write the study of any one of its scenes."""

import tomllib
from contextlib import suppress
from typing import Any

import xarray

from gradhesion.cli.dataset.read.reader import has_curves
from gradhesion.cli.explorer.data import Entry
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.picture.labels import given
from gradhesion.cli.study.text.written import toml_of
from gradhesion.core.problem.inputs import INPUTS


def scene_study(dataset: xarray.Dataset) -> Entry:
    """Describe the study of one scene but for the values of its parameters, as the study that the dataset holds has it.

    Returns
    -------
    given
        The keys that give the scene, each with its table.
    head, tables
        The keys above the tables, and what other tables hold, as TOML.
    """
    stored: dict[str, Any] = {}
    with suppress(tomllib.TOMLDecodeError, RecursionError):
        stored = tomllib.loads(str(dataset.attrs.get("study", "")))
    keys = {name: INPUTS[name].table for name in given(dataset.coords)}
    own = [str(name) for name in dataset.data_vars if name != "status" and not str(name).endswith(SI)]
    head = {"title": f"A scene of: {dataset.attrs.get('title', 'a dataset')}", "outputs": stored.get("outputs", own)}
    tables: dict[str, str] = {}
    for name, table in stored.items():
        if isinstance(table, dict) and name not in ("parameters", "physical"):
            others = {key: value for key, value in table.items() if key not in keys}
            tables |= {name: toml_of({name: others}).partition("]\n")[2].strip()} if others else {}
    return {"given": keys, "head": toml_of(head | ({"kind": "curve"} if has_curves(dataset) else {})), "tables": tables}
