"""What a folder of parts belongs to: its study and versions, and how another study differs from it."""

import hashlib
import json
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from gradhesion.cli.errors import DatasetError, OutputError, StudyError
from gradhesion.cli.study.axes import Values
from gradhesion.cli.study.study import Study, study_from
from gradhesion.cli.work.folder import Folder, read_json, write_json
from gradhesion.cli.work.parts import settings_of, versions


def manifest_of(study: Study) -> dict[str, Any]:
    """Write down what a study is, what its values depend on first."""
    parameters = {name: [_words(values), _digest(values)] for name, values in study.parameters.items()}
    content = {
        "versions": versions(),
        "settings": settings_of(study),
        "parameters": parameters,
        "blocks": len(study.tiling),
        "chunk": study.chunk,
        "scenes": study.scenes,
        "title": study.title,
        "name": study.name,
        "text": study.text,
    }
    plain: dict[str, Any] = json.loads(json.dumps(content, default=str))
    return plain


def adopt(study: Study, folder: Folder, output: Path) -> None:
    """
    Make a folder that of a study.

    Raises
    ------
    OutputError
        It has parts of another study.
    """
    new, old = manifest_of(study), read_json(folder.study)
    if old == new:
        return
    parts = len(folder.parts())
    if parts and isinstance(old, dict):
        differences = differences_of(old, new)
        if differences:
            raise OutputError(
                f"{output}: {parts:,} finished parts of another study are kept in {output}.parts: "
                f"{'; '.join(differences)}; add --fresh to drop them, or name another output with -o"
            )
    write_json(folder.study, new)


def study_in(folder: Folder, output: Path) -> Study:
    """
    Read the study whose parts are kept.

    Raises
    ------
    DatasetError
        There is none, or none of this version.
    """
    content = read_json(folder.study)
    try:
        study = study_from(tomllib.loads(content["text"]), content["name"])
    except (TypeError, KeyError, ValueError, RecursionError, StudyError):
        raise DatasetError(
            f"{output}: no study with parts is in {output}.parts; compute them first, with `gradhesion run --shard`"
        ) from None
    return replace(study, text=content["text"], title=content["title"], chunk=int(content.get("chunk", study.chunk)))


def differences_of(old: dict[str, Any], new: dict[str, Any]) -> list[str]:
    """Say how another study differs in what values depend on."""
    found = []
    for table in ("versions", "settings", "parameters"):
        one, other = ({**content.get(table, {})} for content in (old, new))
        for name in [*other, *(name for name in one if name not in other)]:
            if one.get(name) == other.get(name):
                continue
            if name == "core":
                found.append("the sources of the solver have changed since")
                continue
            there, here = (_told(table, content.get(name)) for content in (one, other))
            key = f"parameters.{name}" if table == "parameters" else f"{name} version" if table == "versions" else name
            found.append(f"{key} is {there} there and {here} here" + (", with other values" if there == here else ""))
    return found


def _told(table: str, value: Any) -> str:
    """Write a setting, or a parameter, in a few words."""
    if value is None:
        return "absent"
    text = str(value[0]) if table == "parameters" else json.dumps(value)
    return text if len(text) <= 80 else text[:76] + " ..."


def _words(values: Values) -> str:
    """Describe a parameter."""
    if isinstance(values, float):
        return f"{values!r}"
    many = "value" if values.size == 1 else "values"
    return f"{values.size:,} {many} from {float(np.min(values))!r} to {float(np.max(values))!r}"


def _digest(values: Values) -> str:
    """Tell the values of a parameter from any others."""
    return hashlib.sha256(np.ascontiguousarray(values, "<f8").tobytes()).hexdigest()
