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

    def __bool__(self) -> bool:
        """Report whether one of the ends is given."""
        return self.low is not None or self.high is not None

    def __str__(self) -> str:
        """Write it as an option."""
        return f"--{self.option} {':'.join(end or '' for end in (self.low, self.high))}"

    def limits(
        self, name: str, least: float = -math.inf, greatest: float = math.inf, *, log: bool = False
    ) -> tuple[float, float]:
        """
        Give the ends in SI, -inf and inf where there is none, on the axis of a variable with values between two others.

        Raises
        ------
        DatasetError
            An end is no value of what is along the axis, the lower is not below, or nothing is between them.

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
        if low >= greatest or high <= least:
            unit = unit_of(name).replace("1", "")
            written = f"{least:.4g} to {greatest:.4g} {unit}".strip()
            raise DatasetError(f"{self}: outside what is drawn, which is {written}; choose limits that meet it")
        return low, high

    def _value(self, end: str, name: str) -> float:
        """Read one end."""
        try:
            value: float = float(end)
        except ValueError:
            parts = _QUANTITY.fullmatch(end)
            factor = factor_between(parts[2], unit_of(name)) if parts else None
            value = float(Decimal(parts[1]) * factor) if parts and factor else math.nan
        if math.isnan(value):
            unit = unit_of(name)
            wanted = "has no unit; write a number" if unit == "1" else f"is in {unit}; write a number or a quantity"
            raise DatasetError(
                f'{self}: "{end}" is not a value of {name}, which {wanted}, as in {_example(self.option)}'
            )
        return value


ALL: Final = Span()
"""All of an axis."""


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
    if isinstance(ends, Sequence) and len(ends) == 2:
        low, high = (str(end).strip() if end is not None and str(end).strip() else None for end in ends)
        if span := Span(option=option, low=low, high=high):
            return span
    words = value if isinstance(value, str) else repr(value)
    raise DatasetError(f"--{option} {words}: not two ends with a colon between them; write {_example(option)}")


def _example(option: str) -> str:
    """Write a span as an example."""
    return f"--{option} 0.1:0.5"
