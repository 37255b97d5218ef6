"""What a study of kind "optimum" seeks: the goal, the inputs that are searched, and what is required."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from gradhesion.cli.keys import INPUTS, Path
from gradhesion.cli.names.outputs import OF_LINEAR, OUTPUTS, SI, SPREADABLE
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.inputs import Range
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.form.optimum import OptimumTable
from gradhesion.cli.terminal.wording import did_you_mean, example, nearest, shown
from gradhesion.core.problem.names import CONTACT_SLOPE, SENSITIVITIES

KIND: Final = "optimum"
"""The kind of study, and its table."""
MOST_INPUTS: Final = 3
"""That are searched at once: a sweep has a power of the resolution."""
MOST_POINTS: Final = 2**24
"""Of the sweep of one cell: all are in memory."""
ON_LOADING: Final = "delta_max"
"""An output that follows the loading path, where nothing else does that tells whether the contact is one disc."""


@dataclass(frozen=True, kw_only=True)
class Input:
    """An input that is searched."""

    name: str
    low: float
    high: float
    log: bool
    """Whether it is searched in its logarithm."""


@dataclass(frozen=True, kw_only=True)
class Search:
    """What is sought."""

    goals: tuple[str, ...] = ()
    """One output, or two whose best compromises are sought; those in SI units end so."""
    signs: tuple[int, ...] = ()
    """1 where a goal is to be as large as possible, -1 where as small."""
    inputs: tuple[Input, ...] = ()
    resolution: int = 200
    one_disc: bool = False
    limits: tuple[tuple[str, float, float], ...] = ()
    """Outputs with the least and the greatest value that they may have."""

    def __bool__(self) -> bool:
        """Report whether anything is sought."""
        return bool(self.goals)

    @property
    def is_front(self) -> bool:
        """Whether the best compromises of two goals are sought."""
        return len(self.goals) > 1

    @property
    def reported(self) -> tuple[str, ...]:
        """The outputs that are reported of an optimum: the goals, and what is limited."""
        return tuple(dict.fromkeys(name.removesuffix(SI) for name in (*self.goals, *(one for one, *_ in self.limits))))

    @property
    def solved(self) -> tuple[str, ...]:
        """The outputs that are solved for on the way."""
        return (*self.reported, *((ON_LOADING,) if self.one_disc else ()))

    @property
    def points(self) -> int:
        """Points of the sweep of one cell: at twice the resolution."""
        return int((2 * self.resolution - 1) ** len(self.inputs)) if self else 1

    @property
    def slope(self) -> str:
        """The sensitivity that belongs to the goal; empty if it has none, or there are two."""
        plain = self.goals[0].removesuffix(SI) if len(self.goals) == 1 else ""
        return f"{plain}_sensitivity" if plain in OF_LINEAR else ""


@dataclass(frozen=True, kw_only=True)
class Sought:
    """What the table [optimum] of a study names, before anything of it is checked."""

    over: tuple[str, ...] = ()
    """The inputs to be searched that have bounds alone, also those whose names are misspelt."""
    data: Mapping[str, Any] = field(default_factory=dict)

    def beside(self) -> dict[str, Any]:
        """Give the keys of the study as those of a map: searched inputs are axes of two values, their bounds."""
        found = {**self.data}
        if found.get("kind") != KIND:
            return found
        found.setdefault("outputs", ["pull_off_force"])
        for name in self.over:
            table = INPUTS[name].table
            found[table] = {**found[table], name: {**found[table][name], "num": 2}}
        return found


def sought_in(data: Mapping[str, Any]) -> Sought:
    """Find what is searched."""
    table = data.get(KIND)
    if data.get("kind") != KIND or not isinstance(table, Mapping) or not isinstance(table.get("over"), list):
        return Sought(data=data)
    bounded = [name for name in INPUTS if _is_bounded(data, name)]
    meant = (name if name in bounded else _slip(name, bounded) for name in table["over"] if isinstance(name, str))
    return Sought(over=tuple(dict.fromkeys(name for name in meant if name)), data=data)


def _slip(word: str, known: Sequence[str]) -> str | None:
    """Find the known name that a misspelt one stands for: its own sentence is enough."""
    return None if word in INPUTS else nearest(word, known)


def _entry(data: Mapping[str, Any], name: str) -> Any:
    """Find what a study gives for an input; None if it gives nothing."""
    table = data.get(INPUTS[name].table) if name in INPUTS else None
    return table.get(name) if isinstance(table, Mapping) else None


def _is_bounded(data: Mapping[str, Any], name: str) -> bool:
    """Report whether an input has bounds and no number of values."""
    entry = _entry(data, name)
    return isinstance(entry, Mapping) and "num" not in entry


def _is_misspelt(data: Mapping[str, Any], name: str) -> bool:
    """Report whether a study gives an input by a key that is nearly its name."""
    table = data.get(INPUTS[name].table) if name in INPUTS else None
    return isinstance(table, Mapping) and any(_slip(str(key), (*INPUTS,)) == name for key in table)


def search_of(checked: Checked, sought: Sought) -> Search:
    """Read a valid table."""
    table = checked.form.optimum
    if checked.form.kind != KIND or table is None:
        return Search()
    entries = checked.form.entries
    inputs = []
    for name in (one for one in INPUTS if one in sought.over):
        entry = entries[name]
        assert isinstance(entry, Range)  # noqa: S101 (what is searched is one)
        low, high = sorted((entry.start, entry.stop))
        inputs.append(Input(name=name, low=low, high=high, log=entry.spacing == "log"))
    limits = {name: [-np.inf, np.inf] for name in (*table.require.minimum, *table.require.maximum)}
    for name, value in table.require.minimum.items():
        limits[name][0] = value
    for name, value in table.require.maximum.items():
        limits[name][1] = value
    return Search(
        goals=(*table.goals("maximise"), *table.goals("minimise")),
        signs=(*(1 for _ in table.goals("maximise")), *(-1 for _ in table.goals("minimise"))),
        inputs=tuple(inputs),
        resolution=table.resolution,
        one_disc=table.require.one_disc,
        limits=tuple((name, low, high) for name, (low, high) in limits.items()),
    )


def mistakes_of_search(checked: Checked, sought: Sought, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that what is sought goes together with the rest of a study."""
    is_written, is_kind = KIND in checked.data, checked.form.kind == KIND
    if not (is_kind and is_written):
        if is_kind:
            yield Mistake((KIND,), None, "this table is required; write for example " + example((KIND,)))
        elif is_written:
            yield Mistake((KIND,), None, 'the study is of another kind; write kind = "optimum", or remove [optimum]')
        return
    if (KIND,) in checked.wrong or checked.form.optimum is None:
        return
    if "outputs" in sought.data:
        sentence = "[optimum] names the outputs; remove this key"
        yield Mistake(("outputs",), sought.data["outputs"], sentence)
    yield from _mistakes_of_goals(checked)
    yield from _mistakes_of_over(checked, sought, sound)
    yield from _mistakes_of_requirements(checked)
    yield from _mistakes_of_company(checked)


def _table(checked: Checked) -> OptimumTable:
    """Give the table that is there."""
    table = checked.form.optimum
    assert table is not None  # noqa: S101 (whoever asks has looked)
    return table


def _mistakes_of_goals(checked: Checked) -> Iterator[Mistake]:
    """Check that one goal or two are named, each an output with one value a scene."""
    table, written = _table(checked), checked.data[KIND]
    if (checked.wrong | checked.meant) & {(KIND, "maximise"), (KIND, "minimise")}:
        return
    goals = [(key, name) for key in ("maximise", "minimise") for name in table.goals(key)]
    if not goals:
        sentence = f"there is no goal; {example((KIND, 'maximise'))}"
        yield Mistake((KIND, "maximise"), None, sentence)
    if len(goals) > 2:
        yield Mistake((KIND, goals[2][0]), written[goals[2][0]], "at most two goals are possible; remove the others")
    known = [
        *SPREADABLE,
        CONTACT_SLOPE,
        *(name + SI for name in SPREADABLE if name in UNITS and "physical" in checked.data),
    ]
    names = [name for _, name in goals]
    for i, (key, name) in enumerate(goals):
        path: Path = (KIND, key)
        if name in names[:i]:
            yield Mistake(path, written[key], f"{shown(name)} is named twice; remove one of the two")
        elif name.endswith("_jumps"):
            sentence = f"{shown(name)} is a count, which changes in steps and has no optimum; choose another output"
            yield Mistake(path, written[key], sentence)
        elif name not in known:
            yield Mistake(path, written[key], f"{shown(name)} cannot be a goal; {did_you_mean(name, known)}")


def _mistakes_of_over(checked: Checked, sought: Sought, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that all that is searched has bounds, and that the other axes have values."""
    table, written = _table(checked), checked.data[KIND]
    path: Path = (KIND, "over")
    if path in checked.wrong:
        return
    if not table.over:
        yield Mistake(path, written.get("over"), f"no input is searched; {example(path)}")
    for i, name in enumerate(table.over):
        own: Path = (KIND, "over", i)
        entry = _entry(sought.data, name)
        if name in table.over[:i]:
            yield Mistake(own, name, "this input is named twice; remove one of the two")
        elif entry is None and _is_misspelt(sought.data, name):
            continue  # the sentence about the unknown key is enough
        elif entry is None:
            known = [one for one in INPUTS if _entry(sought.data, one) is not None]
            near = nearest(name, known)
            remedy = did_you_mean(name, known) if near else f"add {name} = {{ start = .., stop = .. }}"
            yield Mistake(own, name, f"the study gives no {name} to search; {remedy}")
        elif not isinstance(entry, Mapping):
            home = f"{INPUTS[name].table}.{name}"
            sentence = f"it has no bounds, {home} = {shown(entry)}; write {name} = {{ start = .., stop = .. }}"
            yield Mistake(own, name, sentence + ", or remove it here")
        elif "num" in entry:
            sentence = f"a searched input has bounds only; remove num from {INPUTS[name].table}.{name}"
            yield Mistake(own, name, sentence + ", or remove it here")
        elif name in sound and np.ptp(np.asarray(sound[name])) == 0.0:
            yield Mistake((INPUTS[name].table, name), entry, "the bounds are the same; write another stop, or a number")
    if len(table.over) > MOST_INPUTS:
        yield Mistake(path, written["over"], f"at most {MOST_INPUTS} inputs are searched at once; fix the others")
    elif (2 * table.resolution - 1) ** len(table.over) > MOST_POINTS:
        most = int(0.5 * (1 + MOST_POINTS ** (1.0 / len(table.over))))
        sentence = f"a sweep over {len(table.over)} inputs has a resolution of at most {most}; use that or less"
        yield Mistake((KIND, "resolution"), table.resolution, sentence)
    if checked.form.layout == "grid":
        for name, values in sound.items():
            if name not in sought.over and isinstance(values, np.ndarray) and values.size == 1:
                sentence = f"an axis of one value cannot be combined with searched inputs; write {name} = {values[0]!s}"
                yield Mistake((INPUTS[name].table, name), values.tolist(), sentence)


def _mistakes_of_requirements(checked: Checked) -> Iterator[Mistake]:
    """Check what is required."""
    table, written = _table(checked).require, checked.data[KIND].get("require")
    if (KIND, "require") in checked.wrong or not isinstance(written, Mapping):
        return
    known = tuple(name for name in OUTPUTS if name not in SENSITIVITIES)
    for word in ("minimum", "maximum"):
        for name, value in getattr(table, word).items():
            if name not in known:
                yield Mistake((KIND, "require", word, name), value, f"not an output; {did_you_mean(name, known)}")
            elif word == "maximum" and table.minimum.get(name, -np.inf) > value:
                sentence = f"the maximum is below the minimum, {table.minimum[name]:g}; exchange the two"
                yield Mistake((KIND, "require", word, name), value, sentence)
    if table.one_disc and checked.form.method.solver != "exact":
        sentence = 'only the exact solver checks whether the contact is one disc; write solver = "exact"'
        yield Mistake((KIND, "require", "one_disc"), written["one_disc"], sentence)
    if table.one_disc and not checked.form.method.check_contact:
        sentence = "the contact is not checked; remove check_contact = false under [method]"
        yield Mistake((KIND, "require", "one_disc"), written["one_disc"], sentence)


def _mistakes_of_company(checked: Checked) -> Iterator[Mistake]:
    """Check that each cell has one punch and one solver."""
    form = checked.form
    if form.profile.spectrum is not None:
        sentence = 'optima are not available for random roughness; give harmonics, or write kind = "map"'
        yield Mistake(("profile", "spectrum"), dict(form.profile.spectrum), sentence)
    if not isinstance(form.method.solver, str):
        yield Mistake(("method", "solver"), form.method.solver, "an optimum has one solver; choose one of these")
