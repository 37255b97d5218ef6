"""A study written as TOML, and with the fingerprint of a file that it names."""

import json
import re
import tomllib
from collections.abc import Mapping
from typing import Any, Final

from gradhesion.cli.study.text.places import Path, lines_of

_VALUE: Final = re.compile(r"""(?<==)(\s*)("[^"\\]*"|'[^']*')""")
"""A string behind its key."""


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


def with_fingerprint(data: Mapping[str, Any], text: str, path: Path, sha256: str) -> tuple[dict[str, Any], str]:
    r"""
    Give the keys and the text of a study with the SHA-256 of a file, where it names the file.

    The path is that of a key with the name of the file, which becomes a table, or of a table with a key `file`. There
    is no text where none gives just these keys; it is then to be made.

    >>> with_fingerprint({"data": {"file": "a.csv"}}, "[data]\nfile = 'a.csv'", ("data",), "0a")[1]
    '[data]\nfile = \'a.csv\'\nsha256 = "0a"'
    >>> with_fingerprint({"a": {"b": "c.csv"}}, "[a]\nb = 'c.csv' # x", ("a", "b"), "0a")[1]
    '[a]\nb = { file = "c.csv", sha256 = "0a" } # x'
    """
    *above, last = map(str, path)
    table = data[above[0]] if above else data
    named = table[last] if isinstance(table[last], Mapping) else {"file": table[last]}
    if named.get("sha256"):
        return dict(data), text
    named = {**named, "sha256": sha256}
    data = {**data, above[0]: {**table, last: named}} if above else {**data, last: named}
    lines, places = text.split("\n"), lines_of(text)
    if (*path, "file") in places:
        number = places[*path, "file"]
        dot = f"{last}." if lines[number - 1].lstrip().startswith(f"{last}.") else ""
        lines.insert(number, f"{dot}sha256 = {value_of(sha256)}")
    elif path in places:
        at = places[path] - 1
        lines[at] = _VALUE.sub(lambda old: old[1] + value_of(named), lines[at], count=1)
    text = "\n".join(lines)
    try:
        return data, text if tomllib.loads(text) == data else ""
    except ValueError:
        return data, ""
