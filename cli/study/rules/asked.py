"""A study as its rules look at it: what is right of it, expanded, and which keys are there."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np

from gradhesion.cli.names import curves as names
from gradhesion.cli.study.rules.axes import Values
from gradhesion.cli.study.rules.form import KINDS
from gradhesion.cli.study.rules.mistakes import Checked
from gradhesion.cli.terminal.wording import nearest
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.outputs import CURVES


@dataclass(frozen=True, kw_only=True)
class Asked:
    """A study whose keys are right, or left out; its inputs expanded."""

    checked: Checked
    values: Mapping[str, Values]
    """Of the inputs that are right, those that are searched among them."""
    over: tuple[str, ...] = ()
    """The inputs that are searched."""
    written: Mapping[str, Any]
    """The study as it is written, before anything stood in the place of files and of what is searched."""

    @property
    def form(self) -> Any:
        """The form of what is right."""
        return self.checked.form

    @cached_property
    def kind(self) -> str:
        """The kind that is meant."""
        kind = self.checked.data.get("kind", "map")
        return (isinstance(kind, str) and nearest(kind, KINDS)) or "map"

    @property
    def points(self) -> bool:
        """Whether lists are combined item by item."""
        return nearest(str(self.checked.data.get("layout", "grid")), ("grid", "points")) == "points"

    @property
    def units(self) -> bool:
        """Whether there is a table [physical], right or wrong."""
        return isinstance(self.checked.data.get("physical"), Mapping)

    @property
    def axes(self) -> dict[str, Values]:
        """The values of the inputs that are not searched."""
        return {name: values for name, values in self.values.items() if name not in self.over}

    @cached_property
    def _given(self) -> frozenset[str]:
        """The inputs that are there, right or wrong."""
        tables = {own.table: self.checked.data.get(own.table) for own in INPUTS.values()}
        keys = ((name, key) for name, own in tables.items() if isinstance(own, Mapping) for key in own)
        return frozenset(key for name, key in keys if key in INPUTS and INPUTS[key].table == name)

    def given(self, name: str) -> bool:
        """Report whether an input is there, right or wrong."""
        return name in self._given

    def meant(self, name: str) -> bool:
        """Report whether an input is there, perhaps misspelt or in the wrong table."""
        return self.given(name) or (INPUTS[name].table, name) in self.checked.meant

    def sound(self, table: str) -> bool:
        """Report whether a table is there, and right as a whole."""
        return table in self.checked.data and not any(path[0] == table for path in self.checked.wrong)

    @property
    def turns(self) -> list[str]:
        """What gives where cycles turn before the rim."""
        return [name for name in INPUTS if name in self._given and INPUTS[name].group == "turn"]

    @property
    def rims(self) -> Values:
        """The radii of the punch, in whatever they are given; inf where they are not."""
        return next((values for name, values in self.values.items() if INPUTS[name].gives == "a_max_over_R"), math.inf)

    @property
    def ends(self) -> bool:
        """Whether every cycle turns somewhere."""
        return bool(self.turns) or bool(np.all(np.isfinite(self.rims)))

    @property
    def turn(self) -> str:
        """The key that would turn it at a depth."""
        return "indentation_max" if self.units else "indentation_max_over_R"


def curve_of(name: str) -> str:
    """Name the curve that an output is, or is a variable of; empty for another."""
    return name if name in CURVES else names.curve_of(name) or ""


_STEPS: Final = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


def steps_of(path: str) -> tuple[str | int, ...]:
    """
    Take a dotted key apart.

    >>> steps_of("parameters.k[3]")
    ('parameters', 'k', 3)
    """
    return tuple(int(item) if item else name for name, item in _STEPS.findall(path))
