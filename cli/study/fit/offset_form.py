"""What [fit] offsets says: which zeros of the instrument are fitted, and within what."""

from collections.abc import Mapping
from typing import Any, Final

from gradhesion.cli.study.text.quantities import si_value
from gradhesion.cli.terminal.wording import did_you_mean, example, shown
from gradhesion.core.loops.paths.offsets import NO_OFFSETS, Offsets

_KEYS: Final = ("indentation", "load", "slope")
_ZEROS: Final[Mapping[str, tuple[str, tuple[str, ...], str]]] = {
    "indentation": ("a length", ("free", "contact"), '["-1 um", "2 um"]'),
    "load": ("a force", ("free",), '["-5 nN", "5 nN"]'),
}
"""For each zero: what it is, its words, and a range to show."""


def offsets_of(value: object) -> Offsets:
    """
    Read which zeros are fitted.

    Raises
    ------
    ValueError
        It is neither true, false nor a table of them; the message says what to write.

    >>> offsets_of({"indentation": ["-1 um", "2 um"], "slope": True})
    Offsets(indentation=(-1e-06, 2e-06), load='free', slope=True)
    >>> offsets_of(False).names
    ()
    """
    if isinstance(value, Offsets):
        return value
    if isinstance(value, bool):
        return Offsets() if value else NO_OFFSETS
    if not isinstance(value, Mapping):
        raise ValueError(f"this must be true or false, or a table; {example(('fit', 'offsets'))}")  # noqa: TRY004
    for name in value:
        if name not in _KEYS:
            raise ValueError(f"{shown(name)} is not a zero of an instrument; {did_you_mean(str(name), _KEYS)}")
    slope = value.get("slope", False)
    if not isinstance(slope, bool):
        raise ValueError("slope must be true or false; write slope = true to fit a tilt")  # noqa: TRY004
    zeros: dict[str, Any] = {name: _zero(name, value[name]) for name in _ZEROS if name in value}
    return Offsets(**zeros, slope=slope)


def _zero(name: str, value: object) -> str | bool | tuple[float, float]:
    """Read one zero."""
    dimension, words, ends = _ZEROS[name]
    listed = ", ".join(f'"{word}"' for word in words)
    what = f"write {name} = {listed}, false, or a range of two quantities as {ends}"
    if value is False or (isinstance(value, str) and value in words):
        return value
    if not isinstance(value, list) or len(value) != 2:
        raise ValueError(f"{name} = {shown(value)} is not a zero that can be fitted; {what}")
    numbers = []
    for end in value:
        try:
            numbers.append(si_value(end, name))
        except ValueError:
            raise ValueError(f"{name}: {shown(end)} is not {dimension} with its unit; {what}") from None
    if not numbers[0] < numbers[1]:
        raise ValueError(f"{name} = {shown(value)}: the ends of a range must rise; exchange the two")
    return numbers[0], numbers[1]
