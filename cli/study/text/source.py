"""The text of a study: read, parsed, overridden, and where each of its keys comes from."""

import os
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

from gradhesion.cli.disk import kind_of
from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.text.written import Key, lines_of
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
    sources: dict[Key, str] = {}
    mistakes = []
    for override in overrides:
        try:
            sources[_set(data, override)] = override
        except ValueError as error:
            mistakes.append(f"--set {override}: {error}")

    @cache
    def lines() -> dict[Key, str]:
        return {key: f"{file}:{line}" for file, text in texts.items() for key, line in lines_of(text).items()}

    def place(key: Key) -> str:
        above = [key[:depth] for depth in range(len(key), 0, -1)]
        found = next((lines()[steps] for steps in above if steps in lines()), "")
        made = next((steps for steps in above if steps in sources), None)
        if made is None and not found:  # a table that only overrides have made
            made = next((steps for steps in sources if steps[: len(key)] == key), None)
        return f"--set {sources[made]}" if made else found or str(path)

    return Source(
        name=os.fsencode(path.stem).decode("utf-8", "replace"),
        data=data,
        text="" if sources or len(texts) > 1 else texts[path],
        place=place,
        mistakes=tuple(mistakes),
        folder=path.absolute().parent,
    )


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
        remedy = ", which `gradhesion info` and `gradhesion.open` read" if kind.startswith("a dataset") else ""
        return f"{path}: is {kind}{remedy}, not a study; name a study in TOML"
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
        words = "the value is not TOML; put strings in quotes and several values in brackets"
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
    try:
        with netCDF4.Dataset(path) as file:
            if not {"value", "parameter_units", "chi_square"} <= file.variables.keys():
                raise ValueError("the dataset is not that of a fit; name one that a study of kind fit gave")
            if "loop" in file.dimensions:
                one = f"`gradhesion select {path} --at loop=0 -o one.nc`"
                raise ValueError(f"fits of several loops; take one with {one}")
            names, units = (list(map(str, file[name][:])) for name in ("parameter", "parameter_units"))
            values, sound = file[variable][:].tolist(), bool(file["converged"][...])
            sound = sound and not int(file["status"][...]) & (FAILED | POOR_FIT | ANOTHER_MINIMUM)
            sound = sound and not file["on_bound"][:].any()
    except OSError as error:
        what = kind_of(path) or error.strerror or "it cannot be read"
        raise ValueError(f"not the dataset of a fit ({what}); name one, or give a value") from None
    if key not in names:
        raise ValueError(f"the fit has no {key}; {did_you_mean(key, names)}")
    if not sound:
        raise ValueError("the fit is flagged, as `gradhesion info` reports; give the value as a number if it will do")
    value, unit = values[names.index(key)], units[names.index(key)]
    return value if unit == "1" else f"{value!r} {unit}"


def is_deep(data: Any, levels: int = _DEEPEST) -> bool:
    """Check whether tables and lists are nested more deeply than in any study."""
    items = data.values() if isinstance(data, Mapping) else data if isinstance(data, list) else ()
    nested = (item for item in items if isinstance(item, Mapping | list))
    return levels == 0 or any(is_deep(item, levels - 1) for item in nested)
