"""What is known of one key of a study."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

Path = tuple[str | int, ...]
"""A key as the steps to it: `("parameters", "k", 3)` is item 3 of `parameters.k`."""

POSITIVE: Final = {"gt": 0.0}
NOT_NEGATIVE: Final = {"ge": 0.0}
"""Bounds, by the names of pydantic."""


@dataclass(frozen=True, kw_only=True)
class Key:
    """
    One key of a study.

    >>> Key(name="k", about="gradient exponent", example="k = 0.5", bounds={"ge": 0, "le": 1}).allowed
    '0 <= k <= 1'
    """

    name: str
    about: str
    """What it is; of an input, the `long_name` of its coordinate."""
    example: str
    """A line of TOML that would do, or for a table what to write."""
    table: str = ""
    """The table that it stands in: empty at the top, "range" and "harmonics" for the tables within a value."""
    symbol: str = ""
    """How a picture writes it."""
    unit: str = "1"
    """Its unit in a dataset, as UDUNITS writes it."""
    gives: str = ""
    """The parameter that it is, or that it gives alone or with others; empty for what is no input."""
    role: str = ""
    """Of a parameter that other keys can give: what it stands for, in words."""
    instead_of: str = ""
    """The key of the same table that it replaces."""
    also: tuple[str, ...] = ()
    """Other tables that have a key of this name."""
    bounds: Mapping[str, float] = field(default_factory=dict)
    """Of a number: its bounds by the names of pydantic."""
    infinite: str = ""
    """What infinity means, where it is allowed."""

    @property
    def is_parameter(self) -> bool:
        """Whether it is a parameter itself, rather than another way to give one."""
        return self.gives == self.name

    @property
    def allowed(self) -> str:
        """Its bounds in words."""
        if not self.bounds:
            return f"-inf < {self.name} < inf" if self.gives else ""
        low = self.bounds.get("ge", self.bounds.get("gt"))
        least, greatest = ("<=" if "ge" in self.bounds else "<"), self.bounds.get("le")
        if greatest is not None:
            return f"{low:g} {least} {self.name} <= {greatest:g}"
        above = f"{self.name} {least.replace('<', '>')} {low:g}"
        return f"{above} (inf: {self.infinite})" if self.infinite else f"{above}, and finite"
