"""A part of an axis, as a user writes it: `LOW:HIGH`, numbers in SI or with units, either of them left out."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import Any, Final

from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.units import unit_of
from gradhesion.cli.study.text.quantities import factor_between

_QUANTITY: Final = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\D.*)")


@dataclass(frozen=True, kw_only=True)
class Span:
    """Two ends of a part of an axis; None is as far as there are values."""

    option: str = ""
    """The option that gives it."""
    low: str | None = None
    high: str | None = None
    power: int = 0
    """The power of ten of the unit in which values are drawn."""

    def __bool__(self) -> bool:
        """Report whether one of the ends is given."""
        return self.low is not None or self.high is not None

    def __str__(self) -> str:
        """Write it as an option."""
        return f"--{self.option} {':'.join(end or '' for end in (self.low, self.high))}"

    def limits(self, name: str, *, log: bool = False) -> tuple[float, float]:
        """
        Give the ends in the unit in which values are drawn, usually SI; -inf and inf where there is none.

        Parameters
        ----------
        name
            The variable or the parameter along the axis.
        log
            Whether the axis is logarithmic.

        Raises
        ------
        DatasetError
            An end is no number, has a unit of something else, is no place of the axis, or the lower is not below.

        >>> Span(option="xlim", low="50 nm", high="2e-6").limits("R")
        (5e-08, 2e-06)
        """
        low = -math.inf if self.low is None else self._value(self.low, name)
        high = math.inf if self.high is None else self._value(self.high, name)
        if low >= high:
            turned = f"write {self.high}:{self.low}" if low > high else "write two that differ"
            raise DatasetError(f"{self}: the lower limit comes first and is below the upper one; {turned}")
        if log and (high <= 0.0 or -math.inf < low <= 0.0):
            raise DatasetError(f"{self}: the axis is logarithmic; choose limits above 0")
        return low, high

    def within(self, name: str, least: float, greatest: float, *, log: bool = False) -> tuple[float, float]:
        """
        Give the ends, after a check that some of an axis from `least` to `greatest` is between them.

        Raises
        ------
        DatasetError
            As for `limits`, or nothing is between them.
        """
        low, high = self.limits(name, log=log)
        if low >= greatest or high <= least:
            unit = unit_of(name)
            least, greatest = (end * 10.0**self.power for end in (least, greatest))
            written = f"{least:.4g} to {greatest:.4g}" + ("" if unit == "1" else f" {unit}")
            raise DatasetError(f"{self}: outside what is drawn, which is {written}; choose limits that meet it")
        return low, high

    def _value(self, end: str, name: str) -> float:
        """Read one end."""
        try:
            value = float(end)
        except ValueError:
            value = math.nan
        parts = _QUANTITY.fullmatch(end)
        unit = unit_of(name)
        if math.isnan(value) and parts:
            factor = factor_between(parts[2], unit)
            if not factor:
                wanted = "has no unit; write a number" if unit == "1" else f"is in {unit}; write a unit of that kind"
                raise DatasetError(f'{self}: "{parts[2]}" is not a unit of {name}, which {wanted}')
            value = float(Decimal(parts[1]) * factor)
        if math.isnan(value):
            raise DatasetError(f"{self}: {end} is not a number; write for example {example(self.option)}")
        return value / 10.0**self.power


ALL: Final = Span()
"""All of an axis."""


def example(option: str) -> str:
    """Write a span as an example."""
    return f"--{option} 0.1:0.5"


def span_of(option: str, value: Any) -> Span:
    """
    Read what a user writes: "LOW:HIGH", or two ends in a sequence.

    Raises
    ------
    DatasetError
        There are not two ends, or none is given.

    >>> [(span.low, span.high) for span in (span_of("xlim", "0.1:1 um"), span_of("xlim", (0.1, None)))]
    [('0.1', '1 um'), ('0.1', None)]
    """
    if value is None:
        return ALL
    ends = value.split(":") if isinstance(value, str) else value
    words = value if isinstance(value, str) else repr(value)
    if not isinstance(ends, Sequence) or len(ends) != 2:
        raise DatasetError(f"--{option} {words}: not two ends with a colon between them; write {example(option)}")
    low, high = (None if end is None or not str(end).strip() else str(end).strip() for end in ends)
    span = Span(option=option, low=low, high=high)
    if not span:
        raise DatasetError(f"--{option} {words}: neither end is given; write {example(option)}")
    return span
