"""A study as its rules look at it: what is right of it, expanded, and which keys are there."""

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from gradhesion.cli.study.rules.form import KINDS, Entry, Form
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.rules.mistakes import Mistake, mistakes_of
from gradhesion.cli.study.text.toml import Key, steps_of
from gradhesion.cli.terminal.wording import nearest
from gradhesion.core.problem.inputs import INPUTS

Found = Iterator[tuple[str, str]]
"""Dotted keys, and what is wrong with each."""
Values = float | NDArray[np.float64]
"""The values of a parameter: a float is fixed, an array is an axis."""
_DIGITS: Final = 12
"""Significant digits of the decimals that the values of a range are moved to, where these are within rounding."""
_REQUIRED: Final[dict[Key, Any]] = {("parameters", "k"): 0.5, ("parameters", "nu"): 0.3, ("data", "file"): "loop.csv"}
"""Keys that a form needs, with valid values: they stand for wrong ones, so that all else can be read."""
_KINDS_OF: Final = {
    "outputs": ("map", "curve"),
    **dict.fromkeys(("layout", "states", "method"), ("map", "curve", "optimum")),
    "optimum": ("optimum",),
    "uncertainty": ("map",),
    **dict.fromkeys(("data", "fit"), ("fit",)),
}
"""The kinds of study that have a key, where not all have it."""


@dataclass(frozen=True, kw_only=True)
class Asked:
    """A study whose keys are right, or left out; its inputs expanded."""

    form: Form
    """The study, but for what is wrong."""
    data: Mapping[str, Any]
    """The study with what files give, and without keys of other kinds."""
    kind: str
    """The kind that is meant."""
    mistakes: list[Mistake]
    """What is wrong with each key for itself."""
    wrong: Collection[Key]
    """The keys that are wrong or missing (those themselves, where an item of their value is), or meant by others."""
    values: dict[str, Values]
    """Of the inputs that are right; the two ends of those that are searched."""

    @property
    def over(self) -> list[str]:
        """The inputs that are searched for an optimum: those with two ends alone."""
        written = {} if self.kind != "optimum" else {one: self.at(home(one)) for one in INPUTS}
        return [name for name, one in written.items() if isinstance(one, Mapping) and "num" not in one]

    @property
    def points(self) -> bool:
        """Whether lists are combined item by item."""
        return nearest(str(self.data.get("layout", "grid")), ("grid", "points")) == "points"

    @property
    def units(self) -> bool:
        """Whether there is a table [physical], right or wrong."""
        return isinstance(self.data.get("physical"), Mapping)

    @property
    def axes(self) -> dict[str, Values]:
        """The values of the inputs that are not searched."""
        over = self.over
        return {name: values for name, values in self.values.items() if name not in over}

    def at(self, key: str) -> Any:
        """Give what is written at a key; None if it is not there."""
        return value_at(self.data, steps_of(key))

    def has(self, key: str) -> bool:
        """Report whether a key is there, right or wrong."""
        return self.at(key) is not None

    def given(self, *names: str) -> list[str]:
        """List those of some inputs that are there, right or wrong, perhaps misspelt or in the wrong table."""
        paths: dict[str, Key] = {name: (INPUTS[name].table, name) for name in names}
        return [name for name, path in paths.items() if value_at(self.data, path) is not None or path in self.wrong]

    def of(self, group: str) -> list[str]:
        """List the inputs of a group that are there."""
        return self.given(*(name for name, own in INPUTS.items() if own.group == group))

    def right(self, *keys: str) -> bool:
        """Report whether nothing is wrong with some keys or tables, within them or above."""
        return not any(own[: len(path)] == path[: len(own)] for path in self.wrong for own in map(steps_of, keys))

    def beside(self, *values: Values) -> Sequence[NDArray[np.float64]]:
        """Give values of inputs as they meet in scenes, in a grid their extremes; none where lists differ in length."""
        own = [np.atleast_1d(one) for one in values]
        if not self.points:
            return np.meshgrid(*([one.min(), one.max()] for one in own))
        return np.broadcast_arrays(*own) if len({one.size for one in own} - {1}) < 2 else [np.zeros(0)] * len(own)

    @property
    def waved(self) -> list[str]:
        """What gives the waves an amplitude that is not zero everywhere."""
        return [name for name in ("A", "chi", "amplitude") if np.any(np.asarray(self.values.get(name, 0.0)) != 0.0)]

    @property
    def turns(self) -> list[str]:
        """What gives where cycles turn before the rim; a fit turns where its data do."""
        return self.of("turn") or (["indentation_max"] if self.kind == "fit" and self.units else [])

    @property
    def ends(self) -> bool:
        """Whether every cycle turns somewhere."""
        rims = [one for name, one in self.values.items() if INPUTS[name].gives == "a_max_over_R"]
        return bool(self.turns) or bool(np.all(np.isfinite(rims[0] if rims else math.inf)))

    @property
    def turn(self) -> str:
        """The key that would turn it at a depth."""
        return "indentation_max" if self.units else "indentation_max_over_R"


def checked(data: Mapping[str, Any]) -> Asked:
    """Check the form of a study, each key for itself; an array is a column of a file, which is right."""
    kind = kind_of(data)
    foreign = {key: kinds[0] for key, kinds in _KINDS_OF.items() if kind not in kinds}
    words = f'a study of kind "{kind}" does not have this; remove it, or write kind = '
    mistakes: list[Mistake] = [((key,), f'{words}"{foreign[key]}"') for key in foreign if key in data]
    own = {key: value for key, value in data.items() if key not in foreign}
    wrong: set[Key] = set()
    try:
        form = Form.model_validate(own, context={"kind": kind})
    except ValidationError as error:
        found, meant = mistakes_of(error, own)
        meant = {path for path in meant if value_at(own, path) is None}
        mistakes += [(path, words) for path, words in found.items() if path not in meant]
        wrong = {path[:2] if len(path) > 1 and isinstance(path[1], str) else path[:1] for path in (*found, *meant)}
        form = Form.model_validate(_without(own, wrong), context={"kind": kind})
    values: dict[str, Values] = {}
    for name, entry in form.entries.items():
        if isinstance(entry, str) or (INPUTS[name].table, name) in wrong:
            continue
        if kind == "fit" and isinstance(entry, Range):  # searched, whatever else it has is refused
            values[name] = np.array(entry.ends)
        elif amiss := [*_range_mistakes(home(name), entry)]:
            mistakes += [(steps_of(key), sentence) for key, sentence in amiss]
        else:
            values[name] = expanded(entry)
    return Asked(form=form, data=own, kind=kind, mistakes=mistakes, wrong=wrong, values=values)


def value_at(data: Mapping[str, Any], path: Key) -> Any:
    """Give what is written at a path; None if it is not there."""
    value: Any = data
    for step in path:
        inside = isinstance(value, list) and isinstance(step, int) and step < len(value)
        value = value[step] if inside else value.get(step) if isinstance(value, Mapping) else None
    return value


def _without(data: Mapping[str, Any], wrong: Iterable[Key]) -> dict[str, Any]:
    """Leave out the keys that are wrong, and the tables that cannot be without one, but for what a form needs."""
    sound = {key: {**value} if isinstance(value, Mapping) else value for key, value in data.items()}
    for top, *rest in sorted(wrong, key=len, reverse=True):
        if not rest or top in ("toughness", "rate"):
            sound.pop(str(top), None)
        elif isinstance(table := sound.get(str(top)), dict):
            table.pop(rest[0], None)
    for (table, name), value in _REQUIRED.items():
        if table == "parameters" or table in sound:
            sound.setdefault(str(table), {}).setdefault(name, value)
    return sound


def kind_of(data: Mapping[str, Any]) -> str:
    """Name the kind of study that is meant."""
    kind = data.get("kind", "map")
    return (isinstance(kind, str) and nearest(kind, KINDS)) or "map"


def home(name: str) -> str:
    """Write an input with its table."""
    return f"{INPUTS[name].table}.{name}"


def expanded(entry: Entry) -> Values:
    """Expand a valid input of a study; a range begins and ends at exactly its `start` and `stop`."""
    if not isinstance(entry, Range):
        given = np.asarray(entry, dtype=np.float64) + 0.0  # no negative zeros
        return given if given.ndim else float(given)
    if entry.num is None:  # searched
        return np.array(entry.ends)
    ends = np.array([entry.start, entry.stop]) + 0.0
    spaced = np.geomspace if entry.spacing == "log" else np.linspace
    values = spaced(ends[0], ends[1], entry.num)
    values = _shortest(values, np.abs(values) if entry.spacing == "log" else np.abs(ends).max())
    values = np.clip(values, ends.min(), ends.max())
    values[0], values[-1] = ends
    return np.asarray(values + 0.0)


def _shortest(values: NDArray[np.float64], size: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Move values to decimals of a few digits within the rounding of a range of this `size`."""
    with np.errstate(all="ignore"):
        places = np.clip(_DIGITS - 1 - np.floor(np.log10(size)), -22, 22)
        power = 10.0 ** np.abs(places)  # exact to 10^22
        decimals = np.where(places >= 0, np.rint(values * power) / power, np.rint(values / power) * power)
        near = np.abs(decimals - values) <= 4 * np.finfo(float).eps * size  # of a few roundings in making the range
    moved = np.where(near & np.isfinite(decimals), decimals, values)
    return moved if np.unique(moved).size == np.unique(values).size else values


def _range_mistakes(key: str, entry: Entry) -> Found:
    """Check that a range makes sense as a whole."""
    if not isinstance(entry, Range):
        return
    if entry.num == 1 and entry.start != entry.stop:
        yield f"{key}.num", "one value cannot be at both start and stop; use num = 2 or more, or a list of one value"
    elif entry.start == entry.stop and entry.num != 1:
        yield key, "start and stop are the same; write another stop, or a number"
    elif entry.spacing == "log" and entry.ends[0] <= 0.0:
        end = "start" if entry.start <= 0.0 else "stop"
        yield f"{key}.{end}", 'log spacing needs values > 0; raise it, or use spacing = "linear"'


def repeated(name: str, values: Values) -> Found:
    """Check that an axis has no value twice."""
    unique, counts = np.unique(values, return_counts=True)
    if counts.max(initial=1) > 1:
        value = float(unique[counts.argmax()])
        first, second, *_ = np.flatnonzero(values == value).tolist()
        unit = "" if INPUTS[name].unit == "1" else f" {INPUTS[name].unit}"
        yield home(name), f"the axis repeats the value {value!r}{unit} (items {first} and {second}); remove one"
