"""The form of [toughness] and [rate]: what the edge of a contact meets."""

from typing import Annotated

from pydantic import Field

from gradhesion.cli.keys import KEYS
from gradhesion.cli.study.form.profile import MOST_WAVES
from gradhesion.cli.study.form.table import Table
from gradhesion.core.problem.profile import MOST_HARMONICS
from gradhesion.core.problem.rate import EXPONENTS

SLOWEST, FASTEST = EXPONENTS
"""The range of the power of the speed."""


class ToughnessWave(Table):
    """One wave of a pattern of toughness."""

    n: Annotated[int, Field(ge=1, le=MOST_WAVES, description=KEYS["n"].about)]
    cos: Annotated[float, Field(allow_inf_nan=False, description="cosine of the wave, in units of the amplitude")] = 0.0
    sin: Annotated[float, Field(allow_inf_nan=False, description=KEYS["sin"].about)] = 0.0


class ToughnessTable(Table):
    """A toughness that varies with the radius."""

    harmonics: Annotated[
        list[ToughnessWave],
        Field(min_length=1, max_length=MOST_HARMONICS, description="waves of the series, a sum that is added to 1"),
    ]
    of: Annotated[str, Field(description=KEYS["of"].about)] = "toughness"


class RateTable(Table):
    """An edge whose work grows with its speed."""

    exponent: Annotated[
        float, Field(ge=SLOWEST, le=FASTEST, description="power n of the speed of the edge in its work, 1 + (v/v*)^n")
    ]
    closing: Annotated[str, Field(description=KEYS["closing"].about)] = "quasi-static"
