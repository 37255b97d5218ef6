"""A study written as TOML, and with the fingerprint of a file that it names."""

import json
import tomllib
from collections.abc import Mapping
from typing import Any

from gradhesion.cli.study.text.places import lines_of


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


def with_fingerprint(data: Mapping[str, Any], text: str, table: str, sha256: str) -> tuple[dict[str, Any], str]:
    r"""
    Give the keys and the text of a study with the SHA-256 of the file of a table, in a line below that of the file.

    There is no text where none gives just these keys; it is then to be made.

    >>> with_fingerprint({"data": {"file": "a.csv"}}, "[data]\nfile = 'a.csv'", "data", "0a")[1]
    '[data]\nfile = \'a.csv\'\nsha256 = "0a"'
    """
    data = {**data, table: {**data[table], "sha256": sha256}}
    number = lines_of(text).get((table, "file"), 0) if text else 0
    if not number:
        return data, ""
    lines = text.split("\n")
    dot = f"{table}." if lines[number - 1].lstrip().startswith(f"{table}.") else ""
    lines.insert(number, f"{dot}sha256 = {json.dumps(sha256)}")
    text = "\n".join(lines)
    try:
        return data, text if tomllib.loads(text) == data else ""
    except ValueError:
        return data, ""
