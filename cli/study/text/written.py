"""A study written as TOML."""

import json
from collections.abc import Mapping
from typing import Any


def toml_of(data: Mapping[str, Any]) -> str:
    """Write a valid study as TOML."""

    def written(value: Any) -> str:
        if isinstance(value, str):
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        if isinstance(value, list):
            return "[" + ", ".join(map(written, value)) + "]"
        if isinstance(value, Mapping):
            return "{ " + ", ".join(f"{key} = {written(item)}" for key, item in value.items()) + " }"
        return str(value).lower() if isinstance(value, bool) else str(value)

    tables = {key: value for key, value in data.items() if isinstance(value, Mapping)}
    lines = [f"{key} = {written(value)}" for key, value in data.items() if key not in tables]
    for key, table in tables.items():
        lines += ["", f"[{key}]", *(f"{name} = {written(value)}" for name, value in table.items())]
    return "\n".join(lines) + "\n"
