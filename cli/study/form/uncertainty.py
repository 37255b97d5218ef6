"""The form of [uncertainty]: how far each input may be off, and by how many samples that is followed."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Final

from pydantic import BeforeValidator, Field, WithJsonSchema, create_model

from gradhesion.cli.keys import INPUTS, Key, keys_of
from gradhesion.cli.study.form.table import Table, of_key
from gradhesion.cli.study.text.quantities import ratio_sentence, si_value
from gradhesion.cli.terminal.wording import did_you_mean, example, shown

MOST_SAMPLES: Final = 2**20
"""Samples of the inputs of one scene: all are in memory."""

_PERCENTAGE: Final = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*%\s*")

LONGEST: Final = 60
"""Characters of a percentage."""


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """The distribution of one input, in SI units: normal about the value of each scene, or uniform."""

    deviation: float = 1.0
    relative: bool = False
    """Whether it is a share of the value."""
    low: float = -math.inf
    high: float = math.inf
    """The bounds of the input, or the ends of a uniform distribution."""
    uniform: bool = False


def deviation_of(value: object, name: str) -> Deviation:
    """
    Read the deviation of an input.

    Raises
    ------
    ValueError
        It is none; the message says what to write.

    >>> deviation_of("5 %", "modulus").deviation, deviation_of("20 nm", "c0").deviation
    (0.05, 2e-08)
    >>> nu = deviation_of({"low": 0.28, "high": 0.32}, "nu")
    >>> nu.uniform, nu.low, nu.high
    (True, 0.28, 0.32)
    """
    key = INPUTS[name]
    if isinstance(value, Deviation):
        return value
    if isinstance(value, Mapping):
        return _uniform(value, name)
    low = key.bounds.get("ge", key.bounds.get("gt", -math.inf))
    high = key.bounds.get("le", math.inf)
    share = _PERCENTAGE.fullmatch(value) if isinstance(value, str) and len(value) <= LONGEST else None
    if share:
        number = float(share[1]) / 100.0
        if not 0.0 < number <= 1.0:
            raise ValueError(f"a percentage is above 0 and at most 100; {_forms(name)}")
        return Deviation(deviation=number, relative=True, low=low, high=high)
    number = _number(value, name)
    if not 0.0 < number < math.inf:
        raise ValueError(f"a standard deviation is above 0, and finite; {_forms(name)}, or remove this key")
    return Deviation(deviation=number, low=low, high=high)


def _number(value: object, name: str) -> float:
    """Read a number in the unit of an input."""
    with_unit = INPUTS[name].table == "physical"
    if with_unit and isinstance(value, int | float) and not isinstance(value, bool):
        percentage = f"{100 * value:.4g}" if 0.0 < value <= 1.0 else "10"
        own = f'{name} = "{percentage} %"'
        raise ValueError(f"a number without a unit; write {own} of the value, or a standard deviation with its unit")
    if with_unit:
        return si_value(value, name)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    raise ValueError((isinstance(value, str) and ratio_sentence(value, name)) or f"not a deviation; {_forms(name)}")


def _uniform(value: Mapping[Any, Any], name: str) -> Deviation:
    """Read the ends of a uniform distribution."""
    known = keys_of("deviation")
    for other in value:
        if other not in known:
            raise ValueError(f"a uniform distribution has no key {shown(other)}; {did_you_mean(str(other), known)}")
    if len(value) < len(known):
        raise ValueError(f"a uniform distribution has both low and high; {_forms(name)}")
    key = INPUTS[name]
    low, high = (_number(value[end], name) for end in known)
    inside = (
        (low > key.bounds["gt"] if "gt" in key.bounds else low >= key.bounds.get("ge", -math.inf))
        and high <= key.bounds.get("le", math.inf)
        and math.isfinite(low)
        and math.isfinite(high)
    )
    if not inside:
        raise ValueError(f"out of range; choose low and high with {key.allowed}, both finite")
    if not low < high:
        raise ValueError("low is not below high; exchange the two, or remove this key")
    return Deviation(low=low, high=high, uniform=True)


def _forms(name: str) -> str:
    """Say what may be written."""
    own = f'{name} = "5 %"'
    return f"write for example {own} of the value, a standard deviation in its unit, or {{ low = .., high = .. }}"


def _deviation(key: Key) -> Any:
    """Make the type of the deviation of an input."""
    schema = {"type": ["number", "string", "object"]}
    read = BeforeValidator(lambda value: None if value is None else deviation_of(value, key.name))
    about = f"uncertainty of {key.name}: {key.about}"
    return Annotated[Deviation | None, read, WithJsonSchema(schema), Field(description=about)]


def _samples(value: object) -> object:
    """Check the number of samples."""
    if (
        isinstance(value, int)
        and not isinstance(value, bool)
        and (value == 0 or (2 <= value <= MOST_SAMPLES and value & (value - 1) == 0))
    ):
        return value
    raise ValueError(
        f"the number of samples is a power of two up to {MOST_SAMPLES:,}, or 0 for none; "
        f"{example(('uncertainty', 'samples'))}"
    )


def _uncertainty() -> type[Table]:
    """Make the table of uncertain inputs."""
    fields: Any = {
        **{name: (_deviation(key), None) for name, key in INPUTS.items()},
        "samples": (of_key("samples", Annotated[int, BeforeValidator(_samples)]), 0),
        "seed": (of_key("seed", int, ge=0, lt=2**63), 0),
    }
    return create_model("UncertaintyTable", __base__=Table, **fields)


if TYPE_CHECKING:

    class UncertaintyTable(Table):
        """How far the inputs may be off."""

        samples: int
        seed: int
else:
    UncertaintyTable = _uncertainty()
