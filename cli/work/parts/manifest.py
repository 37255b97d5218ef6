"""What a folder of parts belongs to: its study and versions, and how another study differs from it."""

import hashlib
import json
import tomllib
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from gradhesion.cli.errors import DatasetError, OutputError
from gradhesion.cli.study.points import Points, points_of
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.rules.axes import Values
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal.amounts import counted
from gradhesion.cli.work.parts.folder import Folder
from gradhesion.cli.work.parts.parts import settings_of, versions
from gradhesion.cli.work.parts.records import Manifest, write_record


def manifest_of(study: Study) -> Manifest:
    """Write down what a study is, what its values depend on first."""
    return Manifest(
        versions=_plain(versions()),
        settings=_plain(settings_of(study)),
        parameters={name: (_words(values), _digest(values)) for name, values in study.parameters.items()},
        blocks=len(study.tiling),
        scenes=study.scenes,
        title=study.title,
        name=study.name,
        text=study.text,
        chunk=study.chunk,
        folder=str(study.folder),
    )


def _plain(content: dict[str, Any]) -> dict[str, Any]:
    """Give a dictionary as it is read from a file again."""
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
    new, old = manifest_of(study), folder.manifest()
    if old == new and folder.study.exists():
        return
    parts = len(folder.parts())
    if parts and old:
        differences = differences_of(old, new)
        if differences:
            raise OutputError(
                f"{output}: {counted(parts, 'finished part')} of another study or version in {output}.parts: "
                f"{'; '.join(differences)}; add --fresh to discard them, or name another output with -o"
            )
    write_record(folder.study, new)


def study_in(folder: Folder, output: Path) -> Study:
    """
    Read the study whose parts are kept.

    Raises
    ------
    DatasetError
        There is none, or none of this version.
    """
    manifest = folder.manifest()
    points = Points()
    with suppress(ValueError, RecursionError):  # of which a StudyError is one
        if manifest:
            data = tomllib.loads(manifest.text)
            points = points_of(data, Path(manifest.folder))
            study = study_from(data, manifest.name, folder=manifest.folder)
            return replace(study, text=manifest.text, title=manifest.title, chunk=manifest.chunk)
    if points.mistakes:
        raise DatasetError(f"{output}: the points of its study, {points.written}: {points.mistakes[0].sentence}")
    raise DatasetError(
        f"{output}: there are no parts of a study in {output}.parts; compute them first, with `gradhesion run --shard`"
    )


def differences_of(old: Manifest, new: Manifest) -> list[str]:
    """Say how another study differs in what values depend on."""
    found = []
    for table in ("versions", "settings", "parameters"):
        one, other = (dict[str, Any](getattr(content, table)) for content in (old, new))
        for name in [*other, *(name for name in one if name not in other)]:
            if one.get(name) == other.get(name):
                continue
            if name == "core":
                found.append("the sources of the solver have changed since")
                continue
            there, here = (_written(table, content.get(name)) for content in (one, other))
            key = f"parameters.{name}" if table == "parameters" else f"{name} version" if table == "versions" else name
            found.append(f"{key} is {there} there and {here} here" + (", with other values" if there == here else ""))
    return found


def _written(table: str, value: Any) -> str:
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
    """Report the values of a parameter from any others."""
    return hashlib.sha256(np.ascontiguousarray(values, "<f8").tobytes()).hexdigest()
