"""The form of [profile]: the shape of the punch."""

import math
from typing import Annotated, Final, Literal

from pydantic import BeforeValidator, Field

from gradhesion.cli.keys import KEYS
from gradhesion.cli.study.form.table import Table
from gradhesion.cli.study.text.quantities import si_value
from gradhesion.cli.terminal.wording import example
from gradhesion.core.problem.profile import MOST_HARMONICS

MOST_WAVES: Final = 10_000
"""The shortest wave of a series, in waves a wavelength: beyond it hardly any scene can be followed."""

MOST_REALISATIONS: Final = 100_000
"""Profiles of one study: each is solved by itself."""


class Wave(Table):
    """One wave of the series of a profile."""

    n: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["n"].about)]
    cos: Annotated[float | None, Field(allow_inf_nan=False, description=KEYS["cos"].about)] = None
    sin: Annotated[float | None, Field(allow_inf_nan=False, description=KEYS["sin"].about)] = None


def _exponent(value: object) -> object:
    """Check the power of a punch."""
    if value == "fit" or (isinstance(value, int | float) and not isinstance(value, bool) and 1.0 <= value < math.inf):
        return float(value) if isinstance(value, int) else value
    raise ValueError(
        f"the power of the punch is a number of 1 or more, and finite (1 is a cone); {example(('profile', 'exponent'))}"
    )


class SpectrumTable(Table):
    """Random self-affine roughness."""

    hurst: Annotated[float, Field(ge=0.0, le=1.0, description=KEYS["hurst"].about)]
    first: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["first"].about)] = 1
    last: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["last"].about)]
    realisations: Annotated[int, Field(ge=1, le=MOST_REALISATIONS, description=KEYS["realisations"].about)] = 1
    seed: Annotated[int, Field(ge=0, lt=2**63, description=KEYS["seed"].about)] = 0


class ProfileTable(Table):
    """The shape of the punch."""

    exponent: Annotated[
        float | Literal["fit"],
        BeforeValidator(_exponent),
        Field(description=KEYS["exponent"].about, json_schema_extra={"minimum": 1.0}),
    ] = 2.0
    harmonics: Annotated[
        Annotated[list[Wave], Field(min_length=1, max_length=MOST_HARMONICS)] | None,
        Field(description=KEYS["harmonics"].about),
    ] = None
    spectrum: Annotated[SpectrumTable | None, Field(description=KEYS["spectrum"].about)] = None
    file: Annotated[str | None, Field(min_length=1, description=KEYS["file"].about)] = None
    sha256: Annotated[str, Field(pattern="^[0-9a-f]{64}$", description=KEYS["sha256"].about)] = ""
    terms: Annotated[int | None, Field(ge=1, le=MOST_HARMONICS, description=KEYS["terms"].about)] = None
    up_to: Annotated[
        float | None,
        BeforeValidator(lambda value: si_value(value, "up_to")),
        Field(description=KEYS["up_to"].about, json_schema_extra={"type": "string"}),
    ] = None
