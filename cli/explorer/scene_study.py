"""What a page needs to write the study, and the call in Python, of any one of its scenes."""

import json
import tomllib
from contextlib import suppress
from typing import Any, Final

import xarray

from gradhesion.cli.dataset.read.reader import has_curves
from gradhesion.cli.explorer.data import Entry
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.picture.labels import given
from gradhesion.cli.study.text.written import toml_of
from gradhesion.core.problem.inputs import INPUTS

OF_AXES: Final = ("parameters", "physical")
"""The tables whose keys are those of the scene."""


def _stored(dataset: xarray.Dataset) -> dict[str, Any]:
    """Read the study that a dataset holds; nothing where it is missing or changed."""
    with suppress(tomllib.TOMLDecodeError, RecursionError):
        return tomllib.loads(str(dataset.attrs.get("study", "")))
    return {}


def scene_study(dataset: xarray.Dataset) -> Entry:
    """
    Describe the study of one scene, but for the values of its parameters.

    Returns
    -------
    given
        The keys that give the scene, each with its table.
    head, tables
        The keys above the tables, and the other tables, as TOML.
    outputs, keywords
        The outputs, and what else a call in Python takes, as Python.
    """
    stored = _stored(dataset)
    own = [str(name) for name in dataset.data_vars if name != "status" and not str(name).endswith(SI)]
    outputs = stored.get("outputs", own)
    keys = {name: INPUTS[name].table for name in given(dataset.coords)}
    title = f"A scene of: {dataset.attrs.get('title', 'a dataset')}"
    head = {"title": title} | ({"kind": "curve"} if has_curves(dataset) else {}) | {"outputs": outputs}
    tables = {
        name: {key: value for key, value in table.items() if key not in keys}
        for name, table in stored.items()
        if isinstance(table, dict) and name not in OF_AXES
    }
    tables = {name: table for name, table in tables.items() if table}
    keywords = [f"profile={tables['profile']!r}"] if "profile" in tables else []
    if control := tables.get("loading", {}).get("control"):
        keywords.append(f"control={control!r}")
    if states := tables.get("states"):
        keywords += [f"{key}={value!r}" for key, value in states.items()]
    if not has_curves(dataset):
        keywords += [f"{key}={value!r}" for key, value in tables.get("method", {}).items()]
    return {
        "given": keys,
        "head": toml_of(head),
        "tables": {name: toml_of({name: table}).partition("]\n")[2].strip() for name, table in tables.items()},
        "outputs": json.dumps(outputs),
        "keywords": keywords,
    }
