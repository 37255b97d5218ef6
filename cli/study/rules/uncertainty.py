"""The table [uncertainty]: which inputs are uncertain, and whether that goes together with the rest of a study."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from gradhesion.cli.keys import INPUTS, Path
from gradhesion.cli.names.outputs import OF_LINEAR, SPREAD, SPREADABLE
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.form.uncertainty import Deviation
from gradhesion.cli.terminal.wording import nearest

TABLE: Final = "uncertainty"


@dataclass(frozen=True, kw_only=True)
class Uncertainty:
    """What is uncertain, and how its effect is found."""

    deviations: tuple[tuple[str, Deviation], ...] = ()
    """The uncertain inputs, in the order of a dataset's dimensions."""
    samples: int = 0
    """Of quasi-random inputs, the same for all scenes; 0: sensitivities alone."""
    seed: int = 0

    def __bool__(self) -> bool:
        """Report whether anything is uncertain."""
        return bool(self.deviations)

    def linear(self, outputs: tuple[str, ...], *, exact: bool) -> tuple[str, ...]:
        """Name the outputs whose deviation is known by sensitivities."""
        return tuple(name for name in outputs if name in OF_LINEAR) if self and exact else ()

    def spreads(self, outputs: tuple[str, ...], *, exact: bool) -> tuple[str, ...]:
        """Name the variables that a dataset has beside its outputs."""
        if not self:
            return ()
        linear, ways = self.linear(outputs, exact=exact), tuple(SPREAD)
        return tuple(
            f"{name}_{way}"
            for name in outputs
            if name in SPREADABLE
            for way in (ways if self.samples else ways[:1] if name in linear else ())
        )


def uncertainty_of(checked: Checked) -> Uncertainty:
    """Read a valid table."""
    form = checked.form.uncertainty
    given = {name: getattr(form, name) for name in INPUTS}
    return Uncertainty(
        deviations=tuple((name, one) for name, one in given.items() if one is not None),
        samples=form.samples,
        seed=form.seed,
    )


def mistakes_of_uncertainty(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that what is uncertain is there, and has a deviation at every scene."""
    written = checked.data.get(TABLE)
    if not isinstance(written, Mapping):
        return
    form = checked.form
    if form.kind != "map":
        sentence = 'only maps have uncertain inputs; write kind = "map", or remove [uncertainty]'
        yield Mistake((TABLE,), None, sentence)
        return
    requested = uncertainty_of(checked)
    if not requested and not any(path[:1] == (TABLE,) for path in checked.wrong):
        yield Mistake((TABLE,), None, 'no input is uncertain; add for example modulus = "5 %", or remove [uncertainty]')
    for name, one in requested.deviations:
        if name not in form.entries:
            yield Mistake((TABLE, name), written[name], _sentence_of_absent(name, [*form.entries]))
        elif name in sound:
            yield from _mistakes_of_deviation(name, one, sound[name], written[name])
    if form.profile.spectrum and {*form.outputs} & {*OF_LINEAR}:
        sentence = "standard deviations apply to one punch, but a spectrum draws many; remove [uncertainty]"
        yield Mistake((TABLE,), None, sentence)
    yield from _mistakes_of_outputs(checked, requested)


def _sentence_of_absent(name: str, known: list[str]) -> str:
    """Say that an input is uncertain that the study does not give."""
    kin = (one for one in known if INPUTS[one].gives == INPUTS[name].gives)
    near = next(kin, None) or nearest(name, known)
    remedy = f'use "{near}"' if near else f"name one that it gives, {', '.join(known)}"
    return f"the study gives no {name} that could be uncertain; {remedy}, or remove this key"


def _mistakes_of_deviation(name: str, one: Deviation, values: Values, written: Any) -> Iterator[Mistake]:
    """Check the deviation of an input against its values."""
    own, path = np.atleast_1d(values), (TABLE, name)
    if one.relative and np.any(own == 0.0):
        yield Mistake(path, written, f"{name} is 0 in some scene, and a percentage of 0 is 0; give a number instead")
    if np.any(np.isinf(own)):
        sentence = f"{name} is inf in some scene, which has no deviation; use finite values, or remove this key"
        yield Mistake(path, written, sentence)
    if one.uniform and np.any((own < one.low) | (own > one.high)):
        outside = own[(own < one.low) | (own > one.high)][0]
        unit = "" if INPUTS[name].unit == "1" else f" {INPUTS[name].unit}"
        sentence = (
            f"the study has {name} = {outside:g}{unit}, which is outside; a uniform distribution is the same in all "
            'scenes: widen it, or give a standard deviation such as "5 %"'
        )
        yield Mistake(path, written, sentence)


def _mistakes_of_outputs(checked: Checked, requested: Uncertainty) -> Iterator[Mistake]:
    """Check that an output has a spread, and that samples are drawn for what no sensitivity is known of."""
    form, path = checked.form, (TABLE, "samples")
    if ("outputs",) in checked.wrong or path in checked.wrong or not requested:
        return
    own = tuple(name for name in form.outputs if name in SPREADABLE)
    if not own:
        names = ", ".join(f'"{name}"' for name in OF_LINEAR)
        place: Path = ("outputs",)
        yield Mistake(place, list(form.outputs), f"none of these has a spread; add for example {names}")
    elif not requested.samples and not requested.linear(own, exact=form.method.solver == "exact" and form.rate is None):
        why = "are not those of the exact solver" if form.method.solver != "exact" else "have no sensitivities"
        sentence = f"the outputs {why}, and their spread needs samples; write samples = 1024 under [uncertainty]"
        yield Mistake(path, 0, sentence)
