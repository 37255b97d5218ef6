"""A study as its rules look at it: what is right of it, expanded, and which keys are there."""

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from pydantic import ValidationError

from gradhesion.cli.study.rules.axes import Values, expanded, range_mistakes
from gradhesion.cli.study.rules.form import KINDS, Entry, Form
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.rules.mistakes import Mistake, mistakes_of, required
from gradhesion.cli.study.text.written import Path, dotted, steps_of
from gradhesion.cli.terminal.wording import nearest
from gradhesion.core.problem.inputs import INPUTS

Found = Iterator[tuple[str, str]]
"""Dotted keys, and what is wrong with each."""
REQUIRED: Final = {"k": 0.5, "nu": 0.3}
"""The parameters that a form needs, with valid values: they stand for wrong ones, so that all else can be read."""
_SCENES: Final = ("map", "curve", "optimum")
_KINDS_OF: Final = {
    "outputs": ("map", "curve"),
    "layout": _SCENES,
    "states": _SCENES,
    "method": _SCENES,
    "optimum": ("optimum",),
    "uncertainty": ("map",),
    "data": ("fit",),
    "fit": ("fit",),
}
"""The kinds of study that have a key, where not all have it."""


@dataclass(frozen=True, kw_only=True)
class Asked:
    """A study whose keys are right, or left out; its inputs expanded."""

    form: Form
    """The study, but for what is wrong."""
    data: Mapping[str, Any]
    """The study with something valid in the place of what files give, and without keys of other kinds."""
    mistakes: list[Mistake]
    """What is wrong with each key for itself."""
    wrong: Collection[Path]
    """The keys that are wrong or missing: the key itself, where an item of its value is."""
    values: dict[str, Values]
    """Of the inputs that are right; the two ends of those that are searched."""

    @cached_property
    def kind(self) -> str:
        """The kind that is meant."""
        return kind_of(self.data)

    @cached_property
    def over(self) -> tuple[str, ...]:
        """The inputs that are searched for an optimum: those with two ends alone."""
        return tuple(str(name) for _, name, _ in _without_num(self.data)) if self.kind == "optimum" else ()

    @property
    def points(self) -> bool:
        """Whether lists are combined item by item."""
        return nearest(str(self.data.get("layout", "grid")), ("grid", "points")) == "points"

    @property
    def units(self) -> bool:
        """Whether there is a table [physical], right or wrong."""
        return isinstance(self.data.get("physical"), Mapping)

    @property
    def lists_solvers(self) -> bool:
        """Whether there is a list of solvers, which stand side by side."""
        return isinstance(self.at("method.solver"), list)

    @property
    def axes(self) -> dict[str, Values]:
        """The values of the inputs that are not searched."""
        return {name: values for name, values in self.values.items() if name not in self.over}

    def at(self, key: str) -> Any:
        """Give what is written at a key; None if it is not there."""
        return value_at(self.data, steps_of(key))

    def has(self, key: str) -> bool:
        """Report whether a key is there, right or wrong."""
        return self.at(key) is not None

    def given(self, *names: str) -> list[str]:
        """List those of some inputs that are there, right or wrong."""
        return [name for name in names if self.has(home(name))]

    def meant(self, *names: str) -> bool:
        """Report whether one of some inputs is there, perhaps misspelt or in the wrong table."""
        there = {mistake.meant for mistake in self.mistakes}
        return bool(self.given(*names)) or any(steps_of(home(name)) in there for name in names)

    def of(self, group: str) -> list[str]:
        """List the inputs of a group that are there."""
        return self.given(*(name for name, own in INPUTS.items() if own.group == group))

    def right(self, *keys: str) -> bool:
        """Report whether nothing is wrong with some keys or tables, within them or above."""
        paths = [f"{dotted(path)}." for path in self.wrong]
        return not any(path.startswith(f"{key}.") or f"{key}.".startswith(path) for path in paths for key in keys)

    @property
    def waved(self) -> list[str]:
        """What gives the waves an amplitude that is not zero everywhere."""
        return [name for name in ("A", "chi", "amplitude") if np.any(np.asarray(self.values.get(name, 0.0)) != 0.0)]

    @property
    def turns(self) -> list[str]:
        """What gives where cycles turn before the rim; a fit turns where its data do."""
        return self.of("turn") or (["indentation_max"] if self.kind == "fit" and self.units else [])

    @property
    def ends(self) -> bool:
        """Whether every cycle turns somewhere."""
        rims = [one for name, one in self.values.items() if INPUTS[name].gives == "a_max_over_R"]
        return bool(self.turns) or bool(np.all(np.isfinite(rims[0] if rims else math.inf)))

    @property
    def turn(self) -> str:
        """The key that would turn it at a depth."""
        return "indentation_max" if self.units else "indentation_max_over_R"


def checked(data: Mapping[str, Any], columns: Mapping[str, Values] | None = None) -> Asked:
    """Check the form of a study, each key for itself; columns of a file stand for what the study has in their place."""
    kind = kind_of(data)
    foreign = {key: kinds[0] for key, kinds in _KINDS_OF.items() if kind not in kinds}
    words = f'a study of kind "{kind}" does not have this; remove it, or write kind = '
    mistakes = [Mistake((key,), data[key], f'{words}"{other}"') for key, other in foreign.items() if key in data]
    own, form = {key: value for key, value in data.items() if key not in foreign}, None
    lacking = _without_num(own) if kind in ("map", "curve") else ()
    found = [Mistake(path, None, required(*path)) for path in lacking]
    try:
        form = Form.model_validate(own)
    except ValidationError as error:
        found += mistakes_of(error, own, foreign)
    meant = {one.meant for one in found}
    mistakes += [one for one in found if one.value is not None or one.path not in meant]
    wrong = {one.path[:2] if len(one.path) > 1 and isinstance(one.path[1], str) else one.path[:1] for one in found}
    try:
        form = form or Form.model_validate(_without(own, wrong))
    except ValidationError as error:  # tables that lack what is wrong
        wrong |= {(str(one["loc"][0]),) for one in error.errors()}
        form = Form.model_validate(_without(own, wrong))
    asked = Asked(form=form, data=own, mistakes=mistakes, wrong=wrong, values={})
    for name, entry in form.entries.items():
        if entry != "data" and not {(INPUTS[name].table,), (INPUTS[name].table, name)} & wrong:
            _expand(asked, name, entry, columns or {})
    return asked


def _expand(asked: Asked, name: str, entry: Entry, columns: Mapping[str, Values]) -> None:
    """Expand an input whose form is right, or say what is wrong with it as a whole."""
    if asked.kind == "fit" and isinstance(entry, Range):  # searched, whatever else it has is refused
        asked.values[name] = np.array(entry.ends)
    elif amiss := [*range_mistakes(name, entry)]:
        asked.mistakes.extend(Mistake(steps_of(key), asked.at(key), sentence) for key, sentence in amiss)
    else:
        asked.values[name] = columns.get(name, expanded(entry))


def _without_num(data: Mapping[str, Any]) -> Iterator[Path]:
    """Give the keys of the numbers of values that ranges lack."""
    for name, own in INPUTS.items():
        entry = value_at(data, (own.table, name))
        if isinstance(entry, Mapping) and "num" not in entry:
            yield (own.table, name, "num")


def value_at(data: Mapping[str, Any], path: Path) -> Any:
    """Give what is written at a path; None if it is not there."""
    value: Any = data
    for step in path:
        inside = isinstance(value, list) and isinstance(step, int) and step < len(value)
        value = value[step] if inside else value.get(step) if isinstance(value, Mapping) else None
    return value


def _without(data: Mapping[str, Any], wrong: Iterable[Path]) -> dict[str, Any]:
    """Leave out the keys that are wrong, but for those that a form needs."""
    sound = {key: {**value} if isinstance(value, Mapping) else value for key, value in data.items()}
    for path in wrong:
        table: Any = sound if len(path) == 1 else sound.get(str(path[0]), {})
        table.pop(path[-1], None)
    if isinstance(sound.get("data"), dict):
        sound["data"].setdefault("file", "loop.csv")
    return sound | {"parameters": REQUIRED | sound.get("parameters", {})}


def kind_of(data: Mapping[str, Any]) -> str:
    """Name the kind of study that is meant."""
    kind = data.get("kind", "map")
    return (isinstance(kind, str) and nearest(kind, KINDS)) or "map"


def home(name: str) -> str:
    """Write an input with its table."""
    return f"{INPUTS[name].table}.{name}"
