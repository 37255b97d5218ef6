"""A study as TOML: where each key of a text stands, a study written, and with the fingerprint of a file it names."""

import json
import re
import tomllib
from collections.abc import Mapping
from typing import Any, Final

Key = tuple[str | int, ...]
"""A key as the steps to it: `("parameters", "k", 3)` is item 3 of `parameters.k`."""

_VALUE: Final = re.compile(r"""(?<==)\s*("[^"\\]*"|'[^']*')""")
"""A string behind its key."""
_VEILED: Final = re.compile(
    r'"""(?:\\.|[^\\])*?"""|\'\'\'.*?\'\'\'|"(?:\\.|[^"\\\n])*"|\'[^\'\n]*\'|#[^\n]*', re.DOTALL
)
"""Strings and comments, in which brackets and equals signs mean nothing."""
_KEY: Final = r"\s*([\w-]+(?:\s*\.\s*[\w-]+)*)\s*"
_HEADER: Final = re.compile(rf"\s*\[\[?{_KEY}\]")
_ENTRY: Final = re.compile(rf"{_KEY}=")
_STEPS: Final = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


def dotted(path: Key) -> str:
    """Write a path as a message shows it."""
    return "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in path).removeprefix(".")


def steps_of(path: str) -> Key:
    """Take a dotted key apart."""
    return tuple(int(item) if item else name for name, item in _STEPS.findall(path))


def lines_of(text: str) -> dict[Key, int]:
    """Find the line (from 1) of each table and key of a valid TOML text; those within a value are at its beginning."""
    found: dict[Key, int] = {}
    table: Key = ()
    depth = 0
    for number, line in enumerate(_VEILED.sub(lambda veiled: "\n" * veiled[0].count("\n"), text).split("\n"), 1):
        header, entry = (_HEADER.match(line), _ENTRY.match(line)) if depth == 0 else (None, None)
        if header:
            path = table = tuple(header[1].replace(" ", "").split("."))
        else:
            path = (*table, *entry[1].replace(" ", "").split(".")) if entry else ()
            depth += sum(map(line.count, "[{")) - sum(map(line.count, "]}"))
        for steps in range(1, len(path) + 1):
            found.setdefault(path[:steps], number)
    return found


def value_of(value: Any) -> str:
    """Write a value as TOML."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(value_of, value)) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {value_of(item)}" for key, item in value.items()) + " }"
    return str(value).lower() if isinstance(value, bool) else str(value)


def toml_of(data: Mapping[str, Any]) -> str:
    """Write a valid study as TOML."""
    tables = {key: value for key, value in data.items() if isinstance(value, Mapping)}
    lines = [f"{key} = {value_of(value)}" for key, value in data.items() if key not in tables]
    for key, table in tables.items():
        lines += ["", f"[{key}]", *(f"{name} = {value_of(value)}" for name, value in table.items())]
    return "\n".join(lines) + "\n"


def with_fingerprints(data: Mapping[str, Any], text: str, files: Mapping[Key, str]) -> str:
    """Write a valid study as TOML with the SHA-256 of each file that it names, in its own text if it has one.

    Each path is that of a key with the name of a file, which becomes a table, or of a table with a key `file`.
    """
    if text and not files:
        return text
    made = {key: {**value} if isinstance(value, Mapping) else value for key, value in data.items()}
    lines = text.split("\n")
    for path, sha256 in files.items():
        *above, last = map(str, path)
        table = made[above[0]] if above else made
        named = table[last] if isinstance(table[last], Mapping) else {"file": table[last]}
        if named.get("sha256"):
            continue
        table[last] = named = {**named, "sha256": sha256}
        places = lines_of("\n".join(lines))
        if (*path, "file") in places:
            number = places[*path, "file"]
            dot = f"{last}." if lines[number - 1].lstrip().startswith(f"{last}.") else ""
            lines.insert(number, f"{dot}sha256 = {value_of(sha256)}")
        elif path in places and (value := _VALUE.search(lines[places[path] - 1])):
            line = value.string
            lines[places[path] - 1] = line[: value.start()] + " " + value_of(named) + line[value.end() :]
    text = "\n".join(lines)
    try:
        return text if text and tomllib.loads(text) == made else toml_of(made)
    except ValueError:
        return toml_of(made)
