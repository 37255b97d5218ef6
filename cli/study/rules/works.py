"""An edge that closes at a smaller work of adhesion than it opens at: the keys that say so, and what needs a turn."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from gradhesion.cli.keys import CLOSING, CLOSING_WORK, INPUTS, Path
from gradhesion.cli.names.outputs import OUTPUTS, SI
from gradhesion.cli.study.form.axes import Values
from gradhesion.cli.study.form.mistakes import Checked, Mistake
from gradhesion.cli.study.rules.roles import is_given
from gradhesion.cli.study.rules.turn import KEYS as TURN_KEYS
from gradhesion.cli.terminal.wording import example

_RATIO: Final[Path] = ("parameters", CLOSING)
_WORK: Final[Path] = ("physical", CLOSING_WORK)
_OPENING: Final[Path] = ("physical", "work_of_adhesion")
_UNBOUNDED: Final = (
    "dissipated_energy",
    "dissipated_energy_sensitivity",
    "energy_gain",
    "energy_residual",
    "front_energy",
    "pinned_depth",
)
"""The outputs that an unbounded punch has not, unless its cycle turns."""


def mistakes_of_works(checked: Checked, sound: Mapping[str, Values], *, points: bool) -> Iterator[Mistake]:
    """Check that one key gives the work of closing, that it is not above that of opening, and that the edge turns."""
    ratio, work = is_given(checked, _RATIO), is_given(checked, _WORK)
    if ratio and work:
        sentence = f"{CLOSING} gives the work of closing already; keep one of the two and remove the other"
        yield Mistake(_WORK, checked.data["physical"][CLOSING_WORK], sentence)
    elif work and not is_given(checked, _OPENING):
        sentence = f"it closes at this work and opens at work_of_adhesion; {example(_OPENING)}"
        yield Mistake(_WORK, checked.data["physical"][CLOSING_WORK], sentence)
    elif work and {CLOSING_WORK, "work_of_adhesion"} <= sound.keys():
        yield from _mistakes_of_order(checked, sound, points=points)
    if (ratio or work) and not any(is_given(checked, path) for path in TURN_KEYS):
        yield from _mistakes_without_a_turn(checked, sound)


def _mistakes_of_order(checked: Checked, sound: Mapping[str, Values], *, points: bool) -> Iterator[Mistake]:
    """Check that no scene closes at more work than it opens at."""
    closing, opening = np.atleast_1d(sound[CLOSING_WORK]), np.atleast_1d(sound["work_of_adhesion"])
    if points and 1 not in (closing.size, opening.size) and closing.size != opening.size:
        return  # which is said of the lists
    if not points:
        closing, opening = closing.max(keepdims=True), opening.min(keepdims=True)
    closing, opening = np.broadcast_arrays(closing, opening)
    above = np.flatnonzero(closing > opening)
    if above.size:
        i = above[0]
        sentence = (
            f"an edge cannot close at more work than it opens at, but {CLOSING_WORK} = {closing[i]:g} J/m^2 exceeds "
            f"work_of_adhesion = {opening[i]:g} J/m^2; lower it, or raise work_of_adhesion"
        )
        yield Mistake(_WORK, checked.data["physical"][CLOSING_WORK], sentence)


def _mistakes_without_a_turn(checked: Checked, sound: Mapping[str, Values]) -> Iterator[Mistake]:
    """Check that no energy is wanted of a punch that is unbounded and does not turn."""
    rims = [values for name, values in sound.items() if INPUTS[name].gives == "a_max_over_R"]
    wanted: list[tuple[Path, str]] = [(("outputs", i), name) for i, name in enumerate(checked.form.outputs)]
    if (table := checked.form.optimum) is not None:
        goals = {way: table.goals(way) for way in ("maximise", "minimise")}
        wanted = [(("optimum", way), name) for way, names in goals.items() for name in names]
    wanted = [(path, name) for path, name in wanted if name.removesuffix(SI) in _UNBOUNDED]
    if not wanted or ("outputs",) in checked.wrong or (rims and np.all(np.isfinite(rims[0]))):
        return
    if any(path[-1] in ("a_max", "a_max_over_R") or path[:1] == ("parameters",) for path in checked.wrong if path):
        return
    even = CLOSING in sound and np.all(np.asarray(sound[CLOSING]) == 1.0)
    if even:
        return
    path, name = wanted[0]
    turn = "indentation_max" if "physical" in checked.data else "indentation_max_over_R"
    about = OUTPUTS[name.removesuffix(SI)].split(",")[0]
    sentence = (
        f"an unbounded punch that does not turn opens from ever larger radii, and {about} has no bound where it closes "
        f"at less work; give {turn} or a finite radius of the punch, or remove this output"
    )
    yield Mistake(path, name, sentence)
