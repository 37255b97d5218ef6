"""A study as TOML: read, overridden, where each of its keys stands, and written with fingerprints of its files."""

import json
import os
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np

from gradhesion.cli.disk import kind_of
from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.text.quantities import as_written
from gradhesion.cli.terminal.wording import did_you_mean, shown
from gradhesion.core.problem.status import ANOTHER_MINIMUM, FAILED, POOR_FIT

MOST_BYTES: Final = 2**26
"""The longest study that is read: far above any that is meant as one."""
_DEEPEST: Final = 32
"""Levels of tables and lists: a study has four."""
DEEP: Final = f"nested more than {_DEEPEST} deep; remove some levels"
_DOTS: Final = re.compile(r"(?:[\w\"'-]+\s*\.\s*){100}")
"""A key far too deep: the parser takes a time that grows with the square of its length."""
_AT: Final = re.compile(r" ?\(at (?:line (\d+), column \d+|end of document)\)")
"""Where the parser has found a mistake."""
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


@dataclass(frozen=True, kw_only=True)
class Source:
    """What a study is made from, before anything is known of its validity."""

    name: str
    data: dict[str, Any]
    text: str
    """The text that gives just this data, or nothing if there is none."""
    place: Callable[[Key], str]
    """Tells where a key comes from."""
    mistakes: tuple[str, ...] = ()
    """What was wrong with the overrides."""
    folder: Path = Path()
    """The folder of the files that it names."""


def read_source(path: Path, overrides: Iterable[str]) -> Source:
    """Read a study file, and set what is overridden; StudyError where it is no TOML."""
    data, texts = _read(path, ())
    made: dict[Key, str] = {}
    mistakes = []
    for override in overrides:
        try:
            made[_set(data, override)] = f"--set {override}"
        except ValueError as error:
            mistakes.append(f"--set {override}: {error}")

    @cache
    def lines() -> dict[Key, str]:
        return {key: f"{file}:{line}" for file, text in texts.items() for key, line in lines_of(text).items()}

    def place(key: Key) -> str:
        above = [key[:depth] for depth in range(len(key), 0, -1)]
        by_override, by_line = (next((own[steps] for steps in above if steps in own), "") for own in (made, lines()))
        within = next((one for steps, one in made.items() if steps[: len(key)] == key), "")  # of a table made by these
        return by_override or by_line or within or str(path)

    return Source(
        name=os.fsencode(path.stem).decode("utf-8", "replace"),
        data=data,
        text="" if made or len(texts) > 1 else texts[path],
        place=place,
        mistakes=tuple(mistakes),
        folder=path.absolute().parent,
    )


def source_of(data: Mapping[str, Any], name: str, folder: str | Path) -> Source:
    """Make the source of a study that is a mapping."""
    if is_deep(data):
        raise StudyError(f"{name}: not a study, tables or lists are {DEEP}")
    home, own = Path(folder).absolute(), as_written(data)
    if "include" in own:
        own, _ = included(own, home, f"{name}: include = {shown(own['include'])}")
    return Source(name=name, data=own, text="", place=lambda _: name, folder=home)


def _read(path: Path, above: tuple[Path, ...]) -> tuple[dict[str, Any], dict[Path, str]]:
    """Read the keys of a file and of what it includes, and the texts of both, its own last."""
    try:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise StudyError(f"{path}: cannot be read ({reason}); name a study in TOML") from None
    if len(content) > MOST_BYTES:
        raise StudyError(f"{path}: larger than {MOST_BYTES >> 20} MiB, too large for a study; name a study in TOML")
    try:
        text = content.decode("utf-8-sig")
        data = None if _DOTS.search(text) else tomllib.loads(text)
    except RecursionError:
        data = None
    except ValueError as error:
        raise StudyError(_no_toml(path, content, error)) from None
    if data is None or is_deep(data):
        raise StudyError(f"{path}: not a study, tables or lists are {DEEP}")
    if "include" not in data:
        return data, {path: text}
    where = f"{path}:{lines_of(text).get(('include',), 1)}: include = {shown(data['include'])}"
    merged, texts = included(data, path.parent, where, (*above, path))
    return merged, {**texts, path: text}


def included(
    data: Mapping[str, Any], folder: Path, where: str, above: tuple[Path, ...] = ()
) -> tuple[dict[str, Any], dict[Path, str]]:
    """Give the keys of a study with those of the one that it includes, and the texts of these.

    The keys of the study win; tables at the top are merged key by key, and all other values replaced. A message begins
    with `where`, the place of `include`; `above` are the files that include this one.
    """
    name = data["include"]
    if not isinstance(name, str) or not name:
        what = 'this must be the path of a study in quotes; write for example include = "base.toml"'
        raise StudyError(f"{where}: {what}")
    base = folder / name
    if base.resolve() in {path.resolve() for path in above}:
        raise StudyError(f"{where}: {base} includes {above[-1]} in turn; remove one of the two")
    if not base.is_file():
        raise StudyError(f"{where}: there is no file {base}; name a study that is there, from the folder of this one")
    found, texts = _read(base, above)
    own = {key: value for key, value in data.items() if key != "include"}
    tables = {key for key in own if isinstance(own[key], Mapping) and isinstance(found.get(key), Mapping)}
    return found | own | {key: {**found[key], **own[key]} for key in tables}, texts


def _no_toml(path: Path, content: bytes, error: ValueError) -> str:
    """Say where a file is no TOML, and show the line of what is meant as a study: any other file may hold secrets."""
    kind = kind_of(path)
    if kind and path.suffix.lower() != ".toml":
        remedy = "name a study in TOML (`gradhesion info` and gradhesion.open read datasets)"
        return f"{path}: is {kind}, not a study; {remedy}"
    if isinstance(error, UnicodeDecodeError):
        line = content[: error.start].count(b"\n") + 1
        return f"{path}:{line}: not text in UTF-8; name a study in TOML, saved as UTF-8"
    problem = str(error)
    if not (at := _AT.search(problem)):  # Python's own limit on integers
        return f"{path}: not valid TOML, a number of more than 4,300 digits; write it with an exponent, as 1e6"
    lines = content.decode("utf-8-sig").rstrip().split("\n")
    number = min(int(at[1] or len(lines)), len(lines))
    own = f" in {shown(lines[number - 1].strip())}" if path.suffix == ".toml" else ""
    remedy = "fix this line: strings are in quotes, decimals have a point, and each key and table stands once"
    return f"{path}:{number}: not valid TOML, {problem[: at.start()]}{own}; {remedy}"


def _set(data: dict[str, Any], override: str) -> Key:
    """Set a key by its dotted path in place, and give that path; ValueError says why it cannot be set."""
    key, equals, text = override.partition("=")
    steps, value = tuple(step.strip() for step in key.split(".")), text.strip()
    if not equals or not all(steps):
        raise ValueError("not of the form KEY=VALUE; write for example --set parameters.A=0.02")
    if steps[0] == "include":
        raise ValueError("a study is included by its file alone; write this at its top")
    parsed: dict[str, Any] = {}
    if value.endswith(".nc") and '"' not in value:
        parsed["value"] = _fitted(Path(value), steps)
    with suppress(ValueError, RecursionError):
        parsed = parsed or tomllib.loads(f"value = {value}")
    if parsed.keys() != {"value"}:
        words = "the value is not TOML; strings are in quotes, several values in brackets, and decimals have a point"
        raise ValueError(f"""{words}, as in --set 'title="A map"' --set 'parameters.k=[0, 0.5]'""")
    if len(steps) > _DEEPEST or is_deep(parsed["value"]):
        raise ValueError(DEEP)
    table: Any = data
    for depth, step in enumerate(steps[:-1], 1):
        table = table.setdefault(step, {})
        if not isinstance(table, dict):
            parent = ".".join(steps[:depth])
            raise ValueError(f"{parent} is not a table; set it as a whole, --set '{parent}=...'")  # noqa: TRY004
    table[steps[-1]] = parsed["value"]
    return steps


def _fitted(path: Path, steps: tuple[str, ...]) -> float | str:
    """Give the value of a fitted key, or its standard deviation, as a study writes it: in its unit if it has one.

    ValueError where the file is no fit of one loop, or the fit has no such key, or is flagged.
    """
    import netCDF4  # noqa: PLC0415 (180 ms, which other studies do without)

    key, variable = steps[-1], "standard_deviation" if steps[0] == "uncertainty" else "value"
    wanted = ("parameter", "parameter_units", variable, "on_bound", "converged", "status", "chi_square")
    try:
        with netCDF4.Dataset(path) as file:
            names, units, values, on_bound, converged, status, _ = (file[name][...].tolist() for name in wanted)
    except IndexError:
        raise ValueError("the dataset is not that of a fit; name one that a study of kind fit gave") from None
    except OSError as error:
        what = kind_of(path) or error.strerror or "it cannot be read"
        raise ValueError(f"not the dataset of a fit ({what}); name one, or give a value") from None
    if np.ndim(converged):
        raise ValueError(f"fits of several loops; take one with `gradhesion select {path} --at loop=0 -o one.nc`")
    if key not in names:
        raise ValueError(f"the fit has no {key}; {did_you_mean(key, names)}")
    if not converged or status & (FAILED | POOR_FIT | ANOTHER_MINIMUM) or any(on_bound):
        raise ValueError("the fit is flagged, as `gradhesion info` reports; give the value as a number if it will do")
    value, unit = values[names.index(key)], units[names.index(key)]
    return value if unit == "1" else f"{value!r} {unit}"


def is_deep(data: Any, levels: int = _DEEPEST) -> bool:
    """Check whether tables and lists are nested more deeply than in any study."""
    items = data.values() if isinstance(data, Mapping) else data if isinstance(data, list) else ()
    nested = (item for item in items if isinstance(item, Mapping | list))
    return levels == 0 or any(is_deep(item, levels - 1) for item in nested)


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
    made = {key: {**value} if isinstance(value, Mapping) else value for key, value in data.items()}
    for path, sha256 in files.items():
        *above, last = map(str, path)
        table = made[above[0]] if above else made
        named = table[last] if isinstance(table[last], Mapping) else {"file": table[last]}
        if named.get("sha256"):
            continue
        table[last] = {**named, "sha256": sha256}
        lines, places = text.split("\n"), lines_of(text)
        number = places.get((*path, "file"), places.get(path, 0)) - 1
        if (*path, "file") in places:
            dot = f"{last}." if lines[number].lstrip().startswith(f"{last}.") else ""
            lines[number] += f"\n{dot}sha256 = {value_of(sha256)}"
        elif number >= 0 and (value := _VALUE.search(line := lines[number])):
            lines[number] = line[: value.start()] + " " + value_of(table[last]) + line[value.end() :]
        text = "\n".join(lines)
    try:
        return text if text and (not files or tomllib.loads(text) == made) else toml_of(made)
    except ValueError:
        return toml_of(made)
