"""A table of a study, and a key in it."""

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from gradhesion.cli.keys import KEYS


class Table(BaseModel):
    """A table of a study: no unknown keys, no silent conversions."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, defer_build=True)


def of_key(name: str, kind: Any, **limits: Any) -> Any:
    """Make the type of a key, with what it is about."""
    return Annotated[kind, Field(description=KEYS[name].about, **limits)]
