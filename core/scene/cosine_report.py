"""Reports on a scene on request: the accuracy of its values, and their ratio to those of the smooth punch.

Each is computed from the curve and from existing results, in a pass of its own: without a request it costs
nothing. In the units of curve/cosine.py the load is a difference of three terms, and the energy a sum of parts of the
drop int z (1 - rho^2) dz, of which |rho| <= 1 + 2 chi; rounding leaves some units in the last place of their sizes:

    error of the force   ROUNDING eps z^(1+k) [b z^2/(3+k) + g (C z^c + 1) + z^c],  and z dP/dz where a cycle turns,
    error of the energy  ROUNDING eps 2 pi a^2 (1 + chi)^2 dgamma, a the outermost radius of a jump,

and the error of a sum over waves is ten times its difference from one that starts and ends elsewhere, and 22 eps of
it. The factors are measured: on 2,184 scenes of an independent solver (tests/twin) the true error is at most 4.2 of the
first and 3.2 of the second. Of 72,000 random curves of 160 to 4,000 arches, each walked wave by wave and its losses
added up exactly (tests/core/walked.py), none is beyond the estimate of its sum. In four of 1,000 a sum is off by more
than 22 eps, and the difference of the two is a seventh of that at least, mostly all of it, so that the true error is at
most half the stated one; a third sum between the two differs no more. In all others some 20 eps are the worst, of weak
waves without a rim, and the 23rd part of the stated error the median.
"""

import math
from typing import Final

import numpy as np

from gradhesion.core.closed import smooth
from gradhesion.core.compiler.jit import NO, YES, constant, kernel
from gradhesion.core.curve.branches import ARRIVAL, END, START, Trace
from gradhesion.core.curve.cosine import Cosine, curve_of, depth, force_unit, slope, wave
from gradhesion.core.curve.cosine_folds import fold_of_arch, survey_arch
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.path.cosine import MOST_ARCHES, extent, is_endless_wave, is_long, is_smooth, walk
from gradhesion.core.path.cosine_long import begin_long, stride
from gradhesion.core.path.cosine_loop import loop_energy
from gradhesion.core.path.cosine_waves import is_reported
from gradhesion.core.path.loading import loading_to
from gradhesion.core.path.unloading import unloading_from
from gradhesion.core.problem.curves import Curves
from gradhesion.core.problem.results import ENERGY, FORCE, RADIUS, TURNED, Results, Slots, put
from gradhesion.core.problem.status import NO_VALUE, PULL_OFF_AT_RIM, TOLERANCE_NOT_MET
from gradhesion.core.scene.scene import Scene
from gradhesion.core.struve.current import ready
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.types import Floats, Table

NEEDED: Final = {
    "pull_off_force_error": "pull_off_radius",
    "dissipated_energy_error": "dissipated_energy",
    "energy_residual": "dissipated_energy",
    "adhesion_gain": "pull_off_force",
    "energy_gain": "dissipated_energy",
}
"""The result that a report starts from."""
FORCE_ERROR, ENERGY_ERROR, RESIDUAL, ROUGHNESS, SATURATION, ADHESION_GAIN, ENERGY_GAIN = map(constant, range(7))
_ROUNDING: Final = 6.0 * 2.0**-52
_PROMISED: Final = 1e-9
"""Error of the energy, in parts of its terms, above which a scene does not meet the tolerance (docs/accuracy.md)."""
_EDGE_ROUNDING: Final = 2.0 * _ROUNDING
"""That of the force of a smooth punch whose pull-off is at its edge: nothing is stationary there, and an error of the
similarity length enters with the power (3+k)/2."""
_APART: Final = 10.0
"""Error of a sum over waves over its difference from one that starts and ends elsewhere."""
_SUMMED: Final = 22.0 * 2.0**-52
"""The least error of a sum over waves, in parts of the energies of loading and unloading."""
_SUMMED_FAR: Final = 5e-13
"""The most, where limits of closed form are the only comparison (tests/core/waves/test_cosine_sum.py)."""
_FAR: Final = 4000.0
"""Arches within which every wave can be walked to all digits, and from which on the least error grows."""
_LOOPED: Final = 4096.0
"""Arches, or halves of waves, up to which a loop is integrated: some milliseconds."""
_ARCHES_BACK: Final = 8
"""Arches from the bound of the last one inwards on which the last fold is looked for."""


@kernel()
def _force_terms(table: Table, curve: Cosine, x: float) -> float:
    """Return the size of the terms of the load at x."""
    b, g, lag = curve
    z, power, _, _, _, _, _ = wave(table, lag, x)
    waviness = g * (table.amplitude * power + 1.0 / (1.0 + z))
    return z / (power * power) * (b * z / (3.0 + table.k) + waviness + power)


@kernel()
def _turn_terms(table: Table, curve: Cosine, x: float) -> float:
    """Return by what the load changes with ln x, where x is no number given but where a cycle turns."""
    z = TWO_PI * x
    value, _, _, _ = slope(table, curve, 0.5 * (3.0 + table.k), x)
    power = amplitude_power(table, z)
    return z * abs(value) / (power * power)


@kernel()
def last_fold(table: Table, curve: Cosine, arches: tuple[float, float]) -> float:
    """Return x of the outermost fold of a curve, 0 if it has none."""
    first, final = arches
    level = 0.5 * (1.0 - table.k)
    if final > MOST_ARCHES:
        return 0.5 * final
    i = int(final)
    while i >= max(0, int(first) - 1, int(final) - _ARCHES_BACK):
        survey = survey_arch(table, curve, level, i)
        if survey[0] > 0:
            x, _ = fold_of_arch(table, curve, level, i, survey, YES, 0.0)
            return x
        i -= 1
    return 0.0


@kernel()
def _outermost(count: int, trace: Trace, rim: float) -> float:
    """Return the outermost place on the way of a jump: the rim, or where loading arrives on the branch of the rim."""
    now = count - 1
    while now >= 0 and trace[START, now] > rim:
        now -= 1
    if now >= 0 and trace[END, now] >= rim and trace[ARRIVAL, now] < math.inf:
        return min(rim, trace[ARRIVAL, now])
    return rim


@kernel()
def _energies_at(table: Table, curve: Cosine, count: int, trace: Trace, rim: float) -> tuple[float, float]:
    """Return the reduced energies of loading up to the rim and of unloading."""
    rim_depth = depth(table, curve, rim) if rim < math.inf else math.inf
    loading, _ = loading_to(table, curve, count, trace, rim, YES)
    unloading, _, _ = unloading_from(table, curve, count, trace, rim, rim_depth, YES)
    return loading, unloading


@kernel()
def _wave_terms(table: Table, curve: Cosine, arch: float) -> float:
    """Return what a wave on an arch may lose on both ways, of which rounding may put one too many within the rim."""
    _, g, _ = curve
    chi = g * table.amplitude
    return 8.0 * TWO_PI * math.pi * arch * chi * (1.0 + chi)


@kernel()
def _energy_terms(table: Table, curve: Cosine, count: int, trace: Trace, rim: float) -> float:
    """Return the size of the terms of the reduced energy."""
    _, g, _ = curve
    return (TWO_PI * _outermost(count, trace, rim) * (1.0 + g * table.amplitude)) ** 2


@kernel()
def _report_energy(
    table: Table,
    curve: Cosine,
    arches: tuple[float, float],
    scene: Scene,
    x: float,
    energy: float,
    i: int,
    scratch: Trace,
) -> None:
    """Store the error of the energy of rim number i, at x, and the flag if it is not as accurate as promised.

    The energy is in R^2 dgamma; `arches` are the first and the last one on which the curve can fold, `scratch` is room
    for a trace, of shape (ROWS, branches).
    """
    results, scale = scene.results, scene.energy
    long = is_long(table, arches, x)
    residual = math.nan
    if long:
        wide = begin_long(table, curve, arches, scratch, YES, 2.0)
        trace = wide.trace
        count = stride(table, curve, x, wide, YES, 2.0)
        loaded, unloaded = _energies_at(table, curve, count, trace, x)
        last = min(arches[1], 2.0 * x)
        least = min(_SUMMED_FAR, _SUMMED * (1.0 + max(0.0, (last - arches[0]) / _FAR - 1.0)))
        error = _APART * abs(energy - scale * (loaded + unloaded)) + least * scale * (abs(loaded) + abs(unloaded))
        if not is_reported(table, curve, last):
            error += scale * _wave_terms(table, curve, last)
    else:
        count, trace = walk(table, curve, arches, x, scratch, YES)
        error = _ROUNDING * scale * _energy_terms(table, curve, count, trace, x)
    error *= table.rounding
    terms = scale * _energy_terms(table, curve, count, trace, x)
    if error > _PROMISED * terms:
        results.status[i] |= TOLERANCE_NOT_MET
    waves = _outermost(count, trace, x) - (trace[START, 0] if count > 0 else 0.0)
    if results.slots[RESIDUAL] >= 0 and max(min(arches[1], 2.0 * x) - arches[0], 2.0 * waves) <= _LOOPED:
        if long:
            count, trace = walk(table, curve, arches, x, scratch, NO)
        rim_depth = depth(table, curve, x) if x < math.inf else math.inf
        residual = energy - scale * loop_energy(table, curve, count, trace, x, rim_depth)
    put(results, ENERGY_ERROR, i, error)
    put(results, RESIDUAL, i, residual)


@kernel()
def _report_smooth(k: float, stretch: float, rims: Floats, results: Results) -> None:
    """Report on a smooth punch of stretch s for all its rims a_max/R, of shape (rims,)."""
    jump_in = smooth.smooth_square(k, stretch, smooth.ABSCISSA_OF_JUMP_IN)
    last_radius = math.sqrt(smooth.smooth_square(k, stretch, smooth.abscissa_of_jump_out(k)))
    for i in range(rims.size):
        abscissa = min(smooth.smooth_abscissa(k, stretch, rims[i]), smooth.abscissa_of_pull_off(k))
        put(results, FORCE_ERROR, i, _EDGE_ROUNDING * smooth.FORCE_SCALE * abscissa * (1.0 + abscissa / (3.0 + k)))
        put(results, ENERGY_ERROR, i, _ROUNDING * TWO_PI * min(rims[i] * rims[i], jump_in))
        put(results, RESIDUAL, i, 0.0)
        put(results, ROUGHNESS, i, 0.0)
        put(results, SATURATION, i, last_radius)
        put(results, ADHESION_GAIN, i, 1.0)
        put(results, ENERGY_GAIN, i, 1.0)


@kernel()
def _report_gains(k: float, stretch: float, rims: Floats, solved: Slots, results: Results) -> None:
    """Set force and energy in relation to those of the smooth punch of the same material and rim.

    `rims` are a_max/R, of shape (rims,), `solved` the slots of force and energy themselves.
    """
    slots, out, _ = results
    jump_in = smooth.smooth_square(k, stretch, smooth.ABSCISSA_OF_JUMP_IN)
    jump_out = smooth.smooth_square(k, stretch, smooth.abscissa_of_jump_out(k))
    for i in range(rims.size):
        abscissa = smooth.smooth_abscissa(k, stretch, rims[i])
        if slots[ADHESION_GAIN] >= 0:
            out[slots[ADHESION_GAIN], i] = out[solved[FORCE], i] / smooth.smooth_force(k, abscissa)
        if slots[ENERGY_GAIN] >= 0:
            loaded = smooth.smooth_loading(k, abscissa, rims[i], jump_in)
            unloaded = smooth.smooth_unloading(k, abscissa, rims[i], jump_out)
            out[slots[ENERGY_GAIN], i] = out[solved[ENERGY], i] / (loaded + unloaded)


@kernel()
def _report_curve(
    table: Table,
    stretch: float,
    wavelength: float,
    amplitude: float,
    rims: Floats,
    solved: Slots,
    results: Results,
    scratch: Trace,
) -> None:
    """Report on one curve (s, lambda/R, A) for all its rims a_max/R, of shape (rims,).

    `solved` are the slots of what is solved already; `results` holds all values, with the slots of the reports.
    """
    k = table.k
    slots, out, status = results
    curve, length, depth_scale = curve_of(k, stretch, wavelength, amplitude * wavelength)
    endless = is_endless_wave(wavelength, amplitude)
    arches = (0.0, 0.0) if endless else extent(table, curve)
    if endless or is_smooth(arches):
        _report_smooth(k, stretch, rims, results)
        for i in range(rims.size):
            put(results, ROUGHNESS, i, curve.gain * table.amplitude if amplitude > 0.0 else 0.0)
        return
    _report_gains(k, stretch, rims, solved, results)
    force_scale = force_unit(k, length, depth_scale)
    scene = Scene(wavelength, length, TWO_PI * length * length, depth_scale, results)
    saturation = last_fold(table, curve, arches) * wavelength if slots[SATURATION] >= 0 else 0.0
    for i in range(rims.size):
        if status[i] & NO_VALUE:
            continue
        put(results, ROUGHNESS, i, curve.gain * table.amplitude)
        put(results, SATURATION, i, saturation)
        if slots[FORCE_ERROR] >= 0:
            x = out[solved[RADIUS], i] / wavelength
            terms = _force_terms(table, curve, x)
            if solved[TURNED] > 0 and status[i] & PULL_OFF_AT_RIM:
                terms += _turn_terms(table, curve, x)
            out[slots[FORCE_ERROR], i] = _ROUNDING * table.rounding * force_scale * terms
        if slots[ENERGY_ERROR] >= 0 or slots[RESIDUAL] >= 0:
            x = rims[i] / wavelength
            _report_energy(table, curve, arches, scene, x, out[solved[ENERGY], i], i, scratch)


@kernel()
def report_curves(curves: Curves, solved: Slots, results: Results, scratch: Trace) -> None:
    """Report on curves; `solved` are the slots of what is solved already.

    The other arguments are those of `solve_curves` (scene/solvers.py), but the slots of `results`, of shape (7,), which
    are those of the reports.
    """
    tables, which, index, stiffness, wavelength, amplitude, rims = curves
    for j in range(index.size):
        i, table = index[j], tables[ready(tables, which[j])]
        stretch_factor = 2.0 ** (1.0 + table.k) * math.pi
        row = rims[i if rims.shape[0] > 1 else 0]
        own = Results(results.slots, results.out[:, i], results.status[i])
        stretch = math.sqrt(stretch_factor / stiffness[i])
        if np.any((own.status & NO_VALUE) == 0):  # scenes without a value may be out of every range
            _report_curve(table, stretch, wavelength[i], amplitude[i], row, solved, own, scratch)
        for rim in range(own.status.size):
            if own.status[rim] & NO_VALUE:
                for slot in own.slots:
                    if slot >= 0:
                        own.out[slot, rim] = math.nan
