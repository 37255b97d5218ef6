"""The text of a study: read, parsed, overridden, and where each of its keys comes from."""

import json
import os
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

from gradhesion.cli.errors import StudyError
from gradhesion.cli.files import kind_of
from gradhesion.cli.study.text import places
from gradhesion.cli.study.text.fitted import fitted_value
from gradhesion.cli.terminal import wording

MOST_BYTES: Final = 2**28
"""The longest study that is read: far above any that is meant as one."""


@dataclass(frozen=True, kw_only=True)
class Source:
    """What a study is made from, before anything is known of its validity."""

    name: str
    data: dict[str, Any]
    text: str
    """The text that gives just this data, or nothing if there is none."""
    place: Callable[[places.Path], str]
    """Tells where a key comes from."""
    mistakes: tuple[str, ...] = ()
    """What was wrong with the overrides."""
    folder: Path = Path()
    """The folder of the files that it names."""


def read_source(path: Path, overrides: Iterable[str], most: int = MOST_BYTES) -> Source:
    """
    Read a study file and set what is overridden.

    Raises
    ------
    StudyError
        The file cannot be read, or is not TOML.
    """
    data, lines, text = _read(path, most, ())
    sources, mistakes = _override(data, overrides)

    def place(key: places.Path) -> str:
        above = [key[:depth] for depth in range(len(key), 0, -1)]
        for origin in above:
            if origin in sources:
                return f"--set {sources[origin]}"
        for origin in above:
            if origin in lines():
                return lines()[origin]
        made = next((source for steps, source in sources.items() if steps[: len(key)] == key), None)
        return f"--set {made}" if made else str(path)

    unchanged = "" if sources else text
    name = os.fsencode(path.stem).decode("utf-8", "replace")
    return Source(
        name=name,
        data=data,
        text=unchanged,
        place=place,
        mistakes=tuple(mistakes),
        folder=path.absolute().parent,
    )


_Lines = Callable[[], Mapping[places.Path, str]]
"""Finds the file and the line of each key."""


def _read(path: Path, most: int, above: tuple[Path, ...]) -> tuple[dict[str, Any], _Lines, str]:
    """Read the keys of a file and of what it includes, their places, and a text of just these keys if there is one."""
    text = _text(path, most)
    deep = f"{path}: not a study, tables or lists are nested more than {places.DEEPEST} deep; remove some levels"
    try:
        data = {} if places.is_deep_text(text) else tomllib.loads(text)
    except RecursionError:
        raise StudyError(deep) from None
    except ValueError as error:
        _check_kind(path)
        raise StudyError([_syntax_sentence(path, text, str(error))]) from None
    if places.is_deep_text(text) or places.is_deep(data):
        raise StudyError(deep)
    lines = cache(lambda: {key: f"{path}:{line}" for key, line in places.lines_of(text).items()})
    if "include" not in data:
        return data, lines, text
    where = f"{lines().get(('include',), path)}: include = {wording.shown(data['include'])}"
    merged, below = included(data, path.parent, where, (*above, path), most)
    return merged, cache(lambda: {**below(), **lines()}), ""


def included(
    data: Mapping[str, Any], folder: Path, where: str, above: tuple[Path, ...] = (), most: int = MOST_BYTES
) -> tuple[dict[str, Any], _Lines]:
    """
    Give the keys of a study with those of the one that it includes, and the places of these.

    The keys of the study win; tables at the top are merged key by key, and all other values replaced.

    Parameters
    ----------
    data, folder
        The keys, with `include`, and where that file is looked for.
    where
        What a message begins with: the place of `include`, and its value.
    above
        The files that include this one.
    most
        Bytes of the longest study.

    Raises
    ------
    StudyError
        There is no such study, or it includes this one.
    """
    name = data["include"]
    if not isinstance(name, str) or not name:
        raise StudyError(
            f'{where}: this must be the path of a study in quotes; write for example include = "base.toml"'
        )
    base = folder / name
    if base.resolve() in {path.resolve() for path in above}:
        raise StudyError(f"{where}: {base} includes {above[-1]} in turn; remove one of the two")
    if not base.is_file():
        raise StudyError(f"{where}: there is no file {base}; name a study that is there, from the folder of this one")
    found, lines, _ = _read(base, most, above)
    own = {key: value for key, value in data.items() if key != "include"}
    tables = {key for key in own if isinstance(own[key], Mapping) and isinstance(found.get(key), Mapping)}
    return found | own | {key: {**found[key], **own[key]} for key in tables}, lines


def _text(path: Path, most: int) -> str:
    """Read the text of a study file."""
    try:
        content = bytearray()
        with path.open("rb") as file:  # bit by bit: memory for the most that it may be is not always there
            while len(content) <= most and (piece := file.read(2**20)):
                content += piece
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise StudyError([f"{path}: cannot be read ({reason}); name a study in TOML"]) from None
    if len(content) > most:
        raise StudyError([f"{path}: larger than {most >> 20} MiB, too large for a study; name a study in TOML"])
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        _check_kind(path)
        line = content[: error.start].count(b"\n") + 1
        raise StudyError([f"{path}:{line}: not text in UTF-8; name a study in TOML, saved as UTF-8"]) from None


def _check_kind(path: Path) -> None:
    """Say what a file is that is no study, if that can be seen."""
    kind = kind_of(path)
    if kind and path.suffix.lower() != ".toml":
        remedy = ", which `gradhesion info` and `gradhesion.open` read" if kind.startswith("a dataset") else ""
        raise StudyError([f"{path}: is {kind}{remedy}, not a study; name a study in TOML"]) from None


_REMEDIES: Final = {
    "Cannot overwrite a value": "the key is given twice, remove one",
    "Cannot declare": "the table is given twice, join the two",
}
"""What to do about problems of TOML that no single line has, by what the parser calls them."""

_COMMA: Final = re.compile(r"=\s*([+-]?\d+),(\d+)")


def _syntax_sentence(path: Path, text: str, problem: str) -> str:
    """Say where a text is not TOML, and show the line of what is meant as a study: any other file may hold secrets."""
    at = re.search(r" ?\(at (?:line (\d+), column (\d+)|end of document)\)", problem)
    if not at:  # Python's own limit on integers
        return f"{path}: not valid TOML, a number of more than 4,300 digits; write it with an exponent, as 1e6"
    lines = text.rstrip().split("\n")
    line = min(int(at[1]) if at[1] else len(lines), len(lines))
    shown = f" in {wording.shown(lines[line - 1].strip())}" if path.suffix == ".toml" else ""
    column = f" (column {at[2]})" if at[2] else ""
    what = problem[: at.start()]
    comma = _COMMA.search(lines[line - 1]) if shown else None
    usual = f"write a decimal point, {comma[1]}.{comma[2]}" if comma else "fix this line"
    remedy = next((remedy for start, remedy in _REMEDIES.items() if what.startswith(start)), usual)
    return f"{path}:{line}: not valid TOML, {what[0].lower()}{what[1:]}{column}{shown}; {remedy}"


def _is_list(value: str) -> bool:
    """Report whether a value would be a list, in brackets."""
    try:
        return "," in value and len(tomllib.loads(f"value = [{value}]")) == 1
    except (ValueError, RecursionError):
        return False


def _override(data: dict[str, Any], overrides: Iterable[str]) -> tuple[dict[places.Path, str], list[str]]:
    """Set keys by their dotted paths in place; report which text set each, and what was wrong."""
    sources: dict[places.Path, str] = {}
    mistakes = []
    for override in overrides:
        key, equals, value = override.partition("=")
        steps = tuple(step.strip() for step in key.split("."))
        try:
            parsed = tomllib.loads(f"value = {value.strip()}")
        except (ValueError, RecursionError):
            parsed = {}
        if not equals or not all(steps):
            mistakes.append(f"--set {override}: not of the form KEY=VALUE; write for example --set parameters.A=0.02")
            continue
        if len(steps) > places.DEEPEST or places.is_deep(parsed):
            shown = wording.shown(override)
            mistakes.append(
                f"--set {shown}: nested more than {places.DEEPEST} deep, too deep for a study; remove levels"
            )
            continue
        if parsed.keys() != {"value"} and value.strip().endswith(".nc") and '"' not in value:
            try:
                parsed = {"value": fitted_value(Path(value.strip()), steps[-1])}
            except ValueError as error:
                mistakes.append(f"--set {override}: {error}")
                continue
        if parsed.keys() != {"value"}:
            quoted = f"[{value.strip()}]" if _is_list(value) else json.dumps(value.strip(), ensure_ascii=False)
            if _is_list(value):
                sentence = "write several values in brackets, without spaces or in quotes"
                mistakes.append(f"--set {override}: the value is not TOML; {sentence}, as in --set '{key}={quoted}'")
                continue
            mistakes.append(f"--set {override}: the value is not TOML; quote strings, as in --set '{key}={quoted}'")
            continue
        if steps[0] == "include":
            mistakes.append(f"--set {override}: a study is included by its file alone; write this at its top")
            continue
        table: Any = data
        for depth, step in enumerate(steps[:-1]):
            table = table.setdefault(step, {})
            if not isinstance(table, dict):
                parent = ".".join(steps[: depth + 1])
                mistakes.append(f"--set {override}: {parent} is not a table; set it as a whole, --set '{parent}=...'")
                break
        else:
            table[steps[-1]] = parsed["value"]
            sources[steps] = override
    return sources, mistakes
