"""The rims of any profile that share no trace, which scene/general.py leaves: waves are summed, or walked for each.

Sensitivities are read off the notes of a long cycle. The loop over curves is one of its own, so that a map without such
rims compiles none of it.
"""

import math

from gradhesion.core.compiler.jit import NONE, kernel
from gradhesion.core.curve.general import Basis, Series, curve_at, rims_of, state
from gradhesion.core.curve.general_folds import MOST_CELLS
from gradhesion.core.face import window
from gradhesion.core.harmonics.series import highest_harmonic
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.numbers.intrinsics import fma
from gradhesion.core.path.general_long import Tasks, stride
from gradhesion.core.path.general_middle import FEW, LONGEST_WALK, REGULAR, Middle, middle_of
from gradhesion.core.path.pieces import notes_for
from gradhesion.core.problem.curves import GeneralCurves
from gradhesion.core.problem.results import (
    CONTACT,
    OUTERMOST,
    TURNED,
    Cycle,
    Results,
    part_of,
    put,
    wants_losses,
)
from gradhesion.core.problem.status import LEFT
from gradhesion.core.scene.general_rim import only, put_rim, walked
from gradhesion.core.scene.scene import Scene, has_left, refuse
from gradhesion.core.sensitivities.general_slopes import NOTES, put_noted, sensed_by
from gradhesion.core.sensitivities.wanted import AnySense
from gradhesion.core.types import Floats


@kernel()
def _strode(
    basis: Basis,
    curve: Series,
    scene: Scene,
    first: float,
    middle: Middle,
    rim: tuple[float, float],
    i: int,
    own: AnySense,
) -> bool:
    """Solve rim number i of a long curve, x and its rounding error; return whether its waves could be summed.

    No fold stands before x = `first`.
    """
    slots = scene.results.slots
    tasks = Tasks(wants_losses(slots), curve.alpha > 0.0, slots[CONTACT] >= 0, slots[TURNED] > 0)
    notes = notes_for(NOTES if own.energy > 0 else NONE)
    done, up, down, close, one_disc, waves, x = stride(basis, curve, first, middle, rim, tasks, notes)
    if not done:
        return False
    depth = -1.0
    if down.waves + down.left > 0.0:
        _, _, _, depth, _ = state(basis, curve, down.left, down.waves)
    cycle = Cycle(up.loss, up.jumps, down.loss, down.jumps, depth, up.level)
    put_rim(basis, curve, scene, (x, waves), cycle, (close, one_disc), i)
    if x == math.inf:
        put(scene.results, OUTERMOST, i, TWO_PI * scene.length * (up.waves + up.left))
    put_noted(basis, curve, own, middle.cut, notes, (x, waves), part_of(own.energy, up.loss, down.loss), i)
    return True


@kernel()
def _follow_alone(
    basis: Basis,
    curve: Series,
    scene: Scene,
    bounds: tuple[float, float],
    rims: Floats,
    places: Floats,
    i: int,
    own: AnySense,
) -> None:
    """Follow the cycle of rim number i, which shares no trace, or refuse it.

    All folds stand between the two x of `bounds`; rims are in R, `places` in wavelengths, both of shape (rims,). The
    waves of a long curve are summed, or walked for this rim.
    """
    series, x, (first, last) = basis.series, places[i], bounds
    waves = min(x, last) - first
    if series.shape[0] > 0 and LONGEST_WALK < waves < math.inf:
        middle = middle_of(basis, curve, first, min(x, last), 0.0)
        x_low = fma(-x, scene.wavelength, rims[i]) / scene.wavelength if x < math.inf else 0.0
        if middle.kind == REGULAR and _strode(basis, curve, scene, first, middle, (x, x_low), i, own):
            return
        few = (first, middle.until)
        if middle.kind == FEW and walked(basis, curve, scene, few, places, only(i, rims.size), own):
            return
    near = waves * highest_harmonic(series) < MOST_CELLS
    if not (near and walked(basis, curve, scene, bounds, places, only(i, rims.size), own)):
        refuse(scene.results, i)


@kernel()
def solve_left(basis: Basis, curves: GeneralCurves, results: Results, sense: AnySense) -> None:
    """Follow the cycles of the rims that `solve_scenes` (scene/general.py) leaves, with its arguments."""
    for i in curves.numbers:
        own = Results(results.slots, results.out[:, i], results.status[i])
        if not has_left(own.status):
            continue
        made = curve_at(basis, curves, i)
        waves, rims = Basis(basis.table, made.cosine_bins, made.series), rims_of(curves, i)
        bounds = window(waves, made.curve)
        scene = Scene(made.wavelength, made.length, TWO_PI * made.length * made.length, made.depth, own)
        sensed = sensed_by(sense, curves, made, i)
        places = rims / made.wavelength
        for rim in range(rims.size):
            if own.status[rim] & LEFT:
                own.status[rim] &= ~LEFT
                _follow_alone(waves, made.curve, scene, bounds, rims, places, rim, sensed)
