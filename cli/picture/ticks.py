"""Numbers at the ticks of an axis, in a unit and with digits that keep them apart."""

from collections.abc import Sequence
from typing import Any

from matplotlib.axis import Axis
from matplotlib.ticker import Formatter, MaxNLocator, NullLocator

from gradhesion.cli.picture.labels import Unit


class Numbers(Formatter):
    """Plain numbers in a unit; all ticks of an axis together, so that those which differ read differently."""

    def __init__(self, unit: Unit) -> None:
        self.unit = unit

    def __call__(self, value: float, pos: Any = None) -> str:  # noqa: ARG002 (matplotlib gives it)
        """Write one number."""
        return self.unit.number(value)

    def format_ticks(self, values: Sequence[float]) -> list[str]:
        """Write the numbers of an axis."""
        return self.unit.numbers(values)


def few_ticks(axis: Axis, unit: Unit, count: int = 3) -> None:
    """Put about so many ticks at round numbers between the limits of an axis, whatever its scale."""
    low, high = sorted(axis.get_view_interval())
    slack = 1e-9 * (high - low)  # an end that is a round number is one of them
    found = MaxNLocator(count, steps=[1, 2, 5, 10]).tick_values(low, high)
    places = [float(place) for place in found if low - slack <= place <= high + slack]
    axis.set_minor_locator(NullLocator())
    axis.set_ticks(places, unit.numbers(places))
    axis.set_view_interval(low, high, ignore=True)
