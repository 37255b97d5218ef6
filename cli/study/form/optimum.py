"""The form of [optimum]: what is sought."""

from typing import Annotated, Final

from pydantic import Discriminator, Field, Tag

from gradhesion.cli.keys import KEYS
from gradhesion.cli.study.form.table import Table

MOST_RESOLUTION: Final = 1_000_000
"""Points of a sweep along one input."""

Limit = Annotated[float, Field(allow_inf_nan=False)]

Goals = Annotated[
    Annotated[str, Tag("name")] | Annotated[list[str], Field(min_length=1), Tag("list")],
    Discriminator(lambda value: "list" if isinstance(value, list) else "name"),
]


class RequireTable(Table):
    """What an optimum has to meet."""

    one_disc: Annotated[bool, Field(description=KEYS["one_disc"].about)] = False
    minimum: Annotated[dict[str, Limit], Field(description=KEYS["minimum"].about, default_factory=dict)]
    maximum: Annotated[dict[str, Limit], Field(description=KEYS["maximum"].about, default_factory=dict)]


class OptimumTable(Table):
    """What is sought."""

    maximise: Annotated[Goals | None, Field(description=KEYS["maximise"].about)] = None
    minimise: Annotated[Goals | None, Field(description=KEYS["minimise"].about)] = None
    over: Annotated[list[str], Field(description=KEYS["over"].about, default_factory=list)]
    resolution: Annotated[int, Field(ge=3, le=MOST_RESOLUTION, description=KEYS["resolution"].about)] = 200
    require: Annotated[RequireTable, Field(description=KEYS["require"].about, default_factory=RequireTable)]

    def goals(self, key: str) -> tuple[str, ...]:
        """Give what is named under one of the two keys."""
        value = getattr(self, key)
        return () if value is None else (value,) if isinstance(value, str) else tuple(value)
