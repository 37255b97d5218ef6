"""A study as its rules look at it: what is right of it, expanded, and which keys are there."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Final

import numpy as np
from pydantic import ValidationError

from gradhesion.cli.study.rules.axes import Values
from gradhesion.cli.study.rules.form import KINDS, Form
from gradhesion.cli.study.rules.mistakes import Mistake, mistakes_of
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
    """The study with something valid in the place of files and of what is searched."""
    mistakes: tuple[Mistake, ...] = ()
    """What is wrong with each key for itself."""
    wrong: frozenset[Path] = frozenset()
    """The keys that are wrong or missing: the key itself, where an item of its value is."""
    values: Mapping[str, Values] = field(default_factory=dict)
    """Of the inputs that are right, those that are searched among them."""
    over: tuple[str, ...] = ()
    """The inputs that are searched for an optimum."""

    @cached_property
    def kind(self) -> str:
        """The kind that is meant."""
        return kind_of(self.data)

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
        return isinstance(self.at(("method", "solver")), list)

    @property
    def axes(self) -> dict[str, Values]:
        """The values of the inputs that are not searched."""
        return {name: values for name, values in self.values.items() if name not in self.over}

    def at(self, path: Path) -> Any:
        """Give what is written at a key; None if it is not there."""
        value: Any = self.data
        for step in path:
            inside = isinstance(value, list) and isinstance(step, int) and step < len(value)
            value = value[step] if inside else value.get(step) if isinstance(value, Mapping) else None
        return value

    def has(self, key: str) -> bool:
        """Report whether a key is there, right or wrong."""
        return self.at(steps_of(key)) is not None

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

    def value(self, parameter: str, default: float) -> Values:
        """Give the values of whatever gives a parameter; a default where nothing right does."""
        return next((one for name, one in self.values.items() if INPUTS[name].gives == parameter), default)

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
        return bool(self.turns) or bool(np.all(np.isfinite(self.value("a_max_over_R", math.inf))))

    @property
    def turn(self) -> str:
        """The key that would turn it at a depth."""
        return "indentation_max" if self.units else "indentation_max_over_R"


def checked(data: Mapping[str, Any]) -> Asked:
    """Check the form of a study, each key for itself."""
    try:
        return Asked(form=Form.model_validate(data), data=data)
    except ValidationError as error:
        found = mistakes_of(error, data, absent=foreign_to(kind_of(data)))
    paths, meant = [mistake.path for mistake in found], {mistake.meant for mistake in found}
    mistakes = [one for one in found if one.value is not None or one.path not in meant]
    wrong = {path[:2] if len(path) > 1 and isinstance(path[1], str) else path[:1] for path in paths}
    try:
        form = Form.model_validate(_without(data, wrong))
    except ValidationError as error:  # tables that lack what is wrong
        wrong |= {(str(one["loc"][0]),) for one in error.errors()}
        form = Form.model_validate(_without(data, wrong))
    return Asked(form=form, data=data, mistakes=tuple(mistakes), wrong=frozenset(wrong))


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


def foreign_to(kind: str) -> dict[str, str]:
    """Give the keys at the top that a kind of study does not have, and what to do about them."""
    words = 'a study of kind "{}" does not have this; remove it, or write kind = "{}"'
    return {key: words.format(kind, kinds[0]) for key, kinds in _KINDS_OF.items() if kind not in kinds}


def home(name: str) -> str:
    """Write an input with its table."""
    return f"{INPUTS[name].table}.{name}"
