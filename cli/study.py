"""A study: what is asked for, as it is read from TOML or made in Python."""

import hashlib
import json
import math
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.cli import places, rules, schema
from gradhesion.cli.errors import StudyError
from gradhesion.cli.names import PARAMETERS, SCENE
from gradhesion.core import OUTPUTS, SOLVERS

MOST_BYTES: Final = 2**28
"""The longest study that is read: far above any that is meant as one."""

MOST_MISTAKES: Final = 30
"""Mistakes to print: whoever has more is served by the first."""


@dataclass(frozen=True, kw_only=True)
class Method:
    """How the scenes are solved."""

    solver: str = "exact"


@dataclass(frozen=True, kw_only=True, eq=False)
class Study:
    """
    A valid study, its parameters expanded: a float is fixed, an array is an axis (or, in points, a list).

    >>> study = study_from({
    ...     "outputs": ["pull_off_force"],
    ...     "parameters": {"k": [0.0, 0.5], "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1,
    ...                    "A": {"start": 0.0, "stop": 0.1, "num": 3}, "a_max_over_R": float("inf")},
    ... })
    >>> study.sizes
    {'k': 2, 'A': 3}
    """

    name: str
    title: str
    kind: str
    layout: str
    outputs: tuple[str, ...]
    parameters: Mapping[str, rules.Values]
    method: Method
    text: str
    """The study as TOML: reading it again gives the same study."""

    @property
    def sizes(self) -> dict[str, int]:
        """The dimensions of its dataset, with their lengths."""
        axes = {name: values.size for name, values in self.parameters.items() if isinstance(values, np.ndarray)}
        if self.layout == "points":
            return {SCENE: next(iter(axes.values()), 1)}
        return axes

    @property
    def shape(self) -> tuple[int, ...]:
        """The lengths of its dimensions."""
        return tuple(self.sizes.values())

    @property
    def scenes(self) -> int:
        """The number of its scenes."""
        return math.prod(self.shape)

    @property
    def sha256(self) -> str:
        """The fingerprint of its text."""
        return hashlib.sha256(self.text.encode()).hexdigest()

    def parameters_of(self, block: tuple[slice, ...]) -> dict[str, NDArray[np.float64]]:
        """Cut a block out of the parameters, as arrays that broadcast to the block's shape."""
        names = list(self.sizes)
        cut = {}
        for name, values in self.parameters.items():
            if isinstance(values, float):
                cut[name] = np.full((1,) * len(names), values)
            elif self.layout == "points":
                cut[name] = values[block[0]]
            else:
                axis = names.index(name)
                shape = [1] * len(names)
                shape[axis] = -1
                cut[name] = values[block[axis]].reshape(shape)
        return cut


def load_study(path: str | Path, overrides: Iterable[str] = ()) -> Study:
    """
    Read a study from a file, with `overrides` as `--set` takes them (`"parameters.A=0.02"`).

    Raises
    ------
    StudyError
        The file cannot be read, or the study is wrong; the error has all mistakes.
    """
    path = Path(path)
    text = _text(path)
    try:
        data = tomllib.loads(text)
    except RecursionError:
        raise StudyError([f"{path}: not valid TOML, brackets are nested too deeply; remove some"]) from None
    except ValueError as error:
        raise StudyError([_syntax_sentence(path, text, str(error))]) from None
    sources, mistakes = _override(data, overrides)
    lines = cache(lambda: places.lines_of(text))

    def place(key: places.Path) -> str:
        for depth in range(len(key), 0, -1):
            if key[:depth] in sources:
                return f"--set {sources[key[:depth]]}"
            if key[:depth] in lines():
                return f"{path}:{lines()[key[:depth]]}"
        made = next((source for steps, source in sources.items() if steps[: len(key)] == key), None)
        return f"--set {made}" if made else str(path)

    return _study(data, path.stem, "" if sources else text, place, mistakes)


def study_from(data: Mapping[str, Any], name: str = "study") -> Study:
    """
    Make a study from a mapping with the keys of a study file.

    Raises
    ------
    StudyError
        The study is wrong; the error has all mistakes.
    """
    return _study(_plain(data), name, "", lambda _: name, [])


def _study(
    data: dict[str, Any], name: str, text: str, place: Callable[[places.Path], str], mistakes: list[str]
) -> Study:
    """Check a study as a whole and expand it."""
    found = schema.mistakes_of_form(data)
    found += rules.mistakes_between_keys(data, [mistake.path for mistake in found], OUTPUTS, SOLVERS)
    sentences = []
    for mistake in found:
        value = "" if mistake.value is None else f" = {schema.shown(mistake.value)}"
        sentences.append(f"{place(mistake.path)}: {places.dotted(mistake.path)}{value}: {mistake.sentence}")
    sentences.sort(key=_line)
    mistakes = mistakes + sentences
    if len(mistakes) > MOST_MISTAKES:
        more = f"... and {len(mistakes) - MOST_MISTAKES} more mistakes; mend these first"
        mistakes = [*mistakes[:MOST_MISTAKES], more]
    if mistakes:
        raise StudyError(mistakes)
    layout = data.get("layout", "grid")
    parameters = {key: rules.expanded(data["parameters"][key]) for key in PARAMETERS}
    for values in parameters.values():
        if isinstance(values, np.ndarray):
            steps = np.diff(values)
            if layout == "grid" and not (np.all(steps > 0) or np.all(steps < 0)):
                values.sort()  # CF wants coordinates that rise or fall
            values.flags.writeable = False
    return Study(
        name=name,
        title=data.get("title", "") or name,
        kind=data.get("kind", "map"),
        layout=layout,
        outputs=tuple(output for output in OUTPUTS if output in data["outputs"]),
        parameters=parameters,
        method=Method(**data.get("method", {})),
        text=text or _toml(data),
    )


def _text(path: Path) -> str:
    """Read the text of a study file."""
    try:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise StudyError([f"{path}: cannot be read ({reason}); name a study in TOML"]) from None
    if len(content) > MOST_BYTES:
        raise StudyError([f"{path}: larger than {MOST_BYTES >> 20} MiB, so hardly a study; name a study in TOML"])
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise StudyError([f"{path}:{line}: not text in UTF-8; name a study in TOML, saved as UTF-8"]) from None


def _syntax_sentence(path: Path, text: str, problem: str) -> str:
    """Say where a text is not TOML, and show the line."""
    at = re.search(r" ?\(at (?:line (\d+), column (\d+)|end of document)\)", problem)
    if not at:
        return f"{path}: not valid TOML, {problem}; see toml.io for the format"
    line = int(at[1]) if at[1] else max(1, len(text.splitlines()))
    lines = text.splitlines() or [""]
    shown = schema.shown(lines[min(line, len(lines)) - 1].strip())
    column = f" (column {at[2]})" if at[2] else ""
    return f"{path}:{line}: not valid TOML, {problem[: at.start()].lower()}{column} in {shown}; mend this line"


def _override(data: dict[str, Any], overrides: Iterable[str]) -> tuple[dict[places.Path, str], list[str]]:
    """Set keys by their dotted paths in place; tell which text set each, and what was wrong."""
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
        if parsed.keys() != {"value"}:
            quoted = json.dumps(value.strip(), ensure_ascii=False)
            mistakes.append(f"--set {override}: the value is not TOML; quote strings, as in --set '{key}={quoted}'")
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


def _line(sentence: str) -> tuple[str, int]:
    """Sort sentences by the line that they name."""
    at = re.match(r"(.*?):(\d+):", sentence)
    return (at[1], int(at[2])) if at else ("", 0)


def _plain(value: Any) -> Any:
    """Turn the arrays, tuples and numpy numbers of a mapping made in Python into what TOML would give."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return [_plain(item) for item in value] if isinstance(value, list | tuple) else value


def _toml(data: Mapping[str, Any]) -> str:
    """Write a valid study as TOML."""

    def written(value: Any) -> str:
        if isinstance(value, str):
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        if isinstance(value, list):
            return "[" + ", ".join(map(written, value)) + "]"
        if isinstance(value, Mapping):
            return "{ " + ", ".join(f"{key} = {written(item)}" for key, item in value.items()) + " }"
        return str(value)

    tables = {key: value for key, value in data.items() if isinstance(value, Mapping)}
    lines = [f"{key} = {written(value)}" for key, value in data.items() if key not in tables]
    for key, table in tables.items():
        lines += ["", f"[{key}]", *(f"{name} = {written(value)}" for name, value in table.items())]
    return "\n".join(lines) + "\n"
