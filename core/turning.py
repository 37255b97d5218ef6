"""Where a cycle of one cosine wave turns: where loading first reaches a depth, or a load (physics in docs/theory.md).

Loading holds at the running maximum of the depth. So a depth is first reached on the first branch that ends deeper.
Along a branch the load, whose slope has the level (3+k)/2 (curve.py), falls at first and in the end; it is searched
arch by arch, between the place where loading arrives and the place that it leaves. A load that a jump passes turns the
cycle where the jump ends.

Nothing beyond the place is walked where the lower envelope reaches the target, and no branch before the place where the
upper one does. With chi = g C both hold at every z:

    depth >= b z^2/2 - (1 + chi) z^c
    -(1 + 1.06 chi) z^c <= load/z^(1+k) - b z^2/(3+k) <= -(1 - chi) z^c
"""

import math
from typing import Any, Final, TypeAlias

import numpy as np

from gradhesion.core import smooth
from gradhesion.core._jit import NO, YES, kernel
from gradhesion.core.branches import (
    ARRIVAL,
    END,
    END_DEPTH,
    GAP,
    RUN,
    RUN_FIRST,
    RUN_LANDING,
    RUN_LAST,
    START,
    START_DEPTH,
    VALUES,
    WORK,
    ends,
    find_depth,
)
from gradhesion.core.contact import ALWAYS_ONE, least_opening
from gradhesion.core.curve import Curve, curve_of, depth, force_unit, load, slope
from gradhesion.core.cycle import (
    LARGEST,
    MOST_ARCHES,
    extent,
    first_wave_above,
    is_endless_wave,
    is_long,
    is_smooth,
    is_unresolved,
    stride,
    walk,
    wave_of,
)
from gradhesion.core.far_wave import branch_of_wave, jump_of_wave
from gradhesion.core.folds import CLOSE, fold_of_arch, survey_arch
from gradhesion.core.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE
from gradhesion.core.struve.arches import inner_edge
from gradhesion.core.struve.circle import TWO_PI
from gradhesion.core.struve.power import amplitude_power
from gradhesion.core.ties import rim_is_close, tolerance

Turn: TypeAlias = tuple[float, bool]
"""Where a cycle turns (inf if not here), and whether a step of that is close."""
_STEPS: Final = 200
_SURE: Final = 1e-8
"""The last step of Newton's method, in curvature lengths."""
_FEW: Final = 3
"""Turning points of a curve up to which each looks for itself."""
_WIDE: Final = 1.06
"""The most by which the waves of the load exceed chi z^c downwards."""
_AROUND: Final = 1.25
"""Waves beyond a regular one within which the next branch meets every depth of it."""


@kernel(contract=True)
def _envelope(k: float, b: float, pull: float, z: float, by_load: bool) -> float:
    """Return b z^2/2 - pull z^c, or that of the load."""
    power = z ** (0.5 * (1.0 - k))
    if by_load:
        return z ** (1.0 + k) * (b * z * z / (3.0 + k) - pull * power)
    return 0.5 * b * z * z - pull * power


@kernel()
def _reach(k: float, b: float, pull: float, target: float, by_load: bool, outwards: bool) -> float:
    """Return x where an envelope rises through a target >= 0, rounded outwards or inwards by some percent at most."""
    low, high = 0.0, 1.0
    while _envelope(k, b, pull, high, by_load) <= target:
        low, high = high, 2.0 * high
        if high > LARGEST:
            return math.inf
    while low == 0.0:
        if _envelope(k, b, pull, 0.5 * high, by_load) <= target:
            low = 0.5 * high
        elif high < 1.0 / LARGEST:
            return 0.0
        else:
            high *= 0.5
    for _ in range(6):
        middle = 0.5 * (low + high)
        if _envelope(k, b, pull, middle, by_load) <= target:
            low = middle
        else:
            high = middle
    return (high if outwards else low) / TWO_PI


@kernel()
def _reach_outwards(table: Any, curve: Curve, target: float, by_load: bool) -> float:
    """Return x beyond which the depth (or the load) exceeds a target."""
    b, g, _ = curve
    chi = g * table.amplitude
    return _reach(table.k, b, 1.0 + (_WIDE * chi if by_load else chi), target, by_load, YES)


@kernel()
def _value(table: Any, curve: Curve, x: float, by_load: bool) -> float:
    """Return the depth or the load."""
    return load(table, curve, x) if by_load else depth(table, curve, x)


@kernel()
def _size(table: Any, curve: Curve, x: float, by_load: bool) -> float:
    """Return CLOSE times the size of the terms of the depth or the load."""
    size = tolerance(table, curve, x)
    if not by_load:
        return size
    power = amplitude_power(table, TWO_PI * x)
    return size / (power * power)


@kernel()
def _find(table: Any, curve: Curve, low: float, high: float, target: float, by_load: bool) -> float:
    """Return where the depth (or the load) rises through a target between two places (Newton, kept in the bracket)."""
    k = table.k
    level = 0.5 * (3.0 + k) if by_load else 0.5 * (1.0 - k)
    x = 0.5 * (low + high)
    if not by_load:
        branch = (low, _value(table, curve, low, NO) if low > 0.0 else -1.0, high, _value(table, curve, high, NO))
        x = find_depth(table, curve, target, branch)
    for _ in range(_STEPS):
        d, d1, _, rest = slope(table, curve, level, x)
        rate = d
        if by_load:
            power = amplitude_power(table, TWO_PI * x)
            rate /= power * power
            rest = load(table, curve, x)
        rest -= target
        if rest == 0.0:
            return x
        if rest < 0.0:
            low = x
        else:
            high = x
        step = -rest / rate
        small = abs(step) * (abs(d1) + abs(d)) <= _SURE * min(1.0, TWO_PI * x) * abs(d)  # what is left is its square
        x += step / TWO_PI
        if small and low < x < high:
            return x
        if not low < x < high:
            x = 0.5 * (low + high)
            if x <= low or x >= high:
                return x
    return x


@kernel()
def _load_between(table: Any, curve: Curve, low: float, high: float, target: float) -> Turn:
    """Return where the load first reaches a target between two places; at `low` it is below."""
    level = 0.5 * (3.0 + table.k)
    close = False
    before = low
    i = max(0, int(2.0 * low - table.phase / math.pi) - 1)
    edge, _, _ = inner_edge(table, i)
    while edge < high:
        survey = survey_arch(table, curve, level, i)
        kind = survey[0]
        rising = kind == 1 or (kind == 2 and i % 2 == 0)
        for _ in range(abs(kind)):
            x, _ = fold_of_arch(table, curve, level, i, survey, rising, 0.0)
            if low < x < high:
                if not rising:  # the load is largest here
                    above = load(table, curve, x) - target
                    close = close or abs(above) <= _size(table, curve, x, YES)
                    if above >= 0.0:
                        return _find(table, curve, before, x, target, YES), close
                before = x
            rising = not rising
        edge = survey[3]
        i += 1
    above = load(table, curve, high) - target
    close = close or abs(above) <= _size(table, curve, high, YES)
    return _find(table, curve, before, high, target, YES) if above >= 0.0 else math.inf, close


@kernel()
def _turn_on(
    table: Any, curve: Curve, arrival: float, branch: tuple[float, float, float, float], reach: float, target: float
) -> Turn:
    """Return where the load first reaches a target on a branch that loading visits from its arrival on."""
    _, _, end, _ = branch
    high = min(end, reach)
    if load(table, curve, arrival) >= target:
        return arrival, False
    if not arrival < high:
        return math.inf, False
    return _load_between(table, curve, arrival, high, target)


@kernel()
def _turn_at_depth(table: Any, curve: Curve, first: int, last: int, trace: Any, reach: float, target: float) -> Turn:
    """Return where loading first reaches a depth on the branches `first` to `last` - 1 of a trace."""
    close = False
    for branch in range(first, last):
        end, bottom = trace[END, branch], trace[END_DEPTH, branch]
        if end < math.inf:
            close = close or abs(bottom - target) <= tolerance(table, curve, end)
        if bottom > target:
            high = min(end, reach)
            if high <= trace[START, branch] or _value(table, curve, high, NO) < target:
                return math.inf, close  # beyond the rim
            return _find(table, curve, trace[START, branch], high, target, NO), close
    return math.inf, close


@kernel()
def _peak(table: Any, curve: Curve, low: float, high: float) -> float:
    """Return the largest load between the place where loading arrives on a branch and the end of that."""
    level = 0.5 * (3.0 + table.k)
    highest = max(load(table, curve, low), load(table, curve, high))
    i = max(0, int(2.0 * low - table.phase / math.pi) - 1)
    edge, _, _ = inner_edge(table, i)
    while edge < high:
        survey = survey_arch(table, curve, level, i)
        kind = survey[0]
        if kind in (-1, 2):
            x, _ = fold_of_arch(table, curve, level, i, survey, NO, 0.0)
            if low < x < high:
                highest = max(highest, load(table, curve, x))
        edge = survey[3]
        i += 1
    return highest


@kernel()
def _peaks(table: Any, curve: Curve, count: int, trace: Any, inner: float, targets: int) -> Any:
    """Return the largest load of loading on each branch, or a bound of it.

    It is -inf for a branch that ends before `inner`, where no target is reached, and inf for one that does not end, or
    where `targets` are so few that it is not worth knowing.
    """
    peaks = np.full(count, math.inf)
    for branch in range(count):
        if trace[END, branch] < inner:
            peaks[branch] = -math.inf
        elif targets > _FEW and trace[ARRIVAL, branch] < math.inf and trace[END, branch] < math.inf:
            peaks[branch] = _peak(table, curve, trace[ARRIVAL, branch], trace[END, branch])
    return peaks


@kernel()
def _turn_at_load(
    table: Any, curve: Curve, first: int, last: int, trace: Any, peaks: Any, reach: float, target: float
) -> Turn:
    """Return where loading first reaches a load on the branches `first` to `last` - 1 of a trace."""
    close = False
    for branch in range(first, last):
        arrival, peak = trace[ARRIVAL, branch], peaks[branch]
        if not arrival <= reach:
            continue
        if peak < target:
            close = close or target - peak <= _size(table, curve, trace[END, branch], YES)
            continue
        x, near = _turn_on(table, curve, arrival, ends(trace, branch), reach, target)
        close = close or near
        if x < math.inf:
            return x, close
    return math.inf, close


@kernel()
def _turn_on_wave(table: Any, curve: Curve, trace: Any, wave: float, reach: float, target: float) -> Turn:
    """Return where loading first reaches a load on a regular wave."""
    arrival = trace[RUN, RUN_LANDING] if wave == trace[RUN, RUN_FIRST] else 0.0
    if arrival == 0.0:
        landing, _ = jump_of_wave(table, curve, wave - 1.0, YES, trace[WORK])
        arrival = wave - 1.0 + landing
    return _turn_on(table, curve, arrival, branch_of_wave(table, curve, wave), reach, target)


@kernel()
def _turn_on_waves(table: Any, curve: Curve, trace: Any, reach: float, target: float) -> Turn:
    """Return where loading first reaches a load on the regular waves that it visits: their loads rise outwards."""
    low, high = trace[RUN, RUN_FIRST] - 1.0, trace[RUN, RUN_LAST]
    if high <= low:
        return math.inf, False
    found, close = _turn_on_wave(table, curve, trace, high, reach, target)
    if found == math.inf:
        return found, close
    while high - low > 1.0:
        middle = np.floor(0.5 * (low + high))
        x, near = _turn_on_wave(table, curve, trace, middle, reach, target)
        if x < math.inf:
            high, found, close = middle, x, near
        else:
            low, close = middle, close or near
    return found, close


@kernel()
def _turn_long_at_load(
    table: Any, curve: Curve, count: int, trace: Any, peaks: Any, reach: float, target: float
) -> Turn:
    """Return where loading first reaches a load on a long curve (stride of cycle.py)."""
    gap = int(trace[RUN, GAP])
    x, close = _turn_at_load(table, curve, 0, gap, trace, peaks, reach, target)
    if x == math.inf:
        x, near = _turn_on_waves(table, curve, trace, reach, target)
        close = close or near
    if x == math.inf:
        x, near = _turn_at_load(table, curve, gap, count, trace, peaks, reach, target)
        close = close or near
    return x, close


@kernel()
def _turn_long_at_depth(table: Any, curve: Curve, count: int, trace: Any, reach: float, target: float) -> Turn:
    """Return where loading first reaches a depth on a long curve (stride of cycle.py)."""
    gap = int(trace[RUN, GAP])
    x, close = _turn_at_depth(table, curve, 0, gap, trace, reach, target)
    if x < math.inf:
        return x, close
    if trace[END_DEPTH, gap] > target:
        before, after = wave_of(table, trace[START, gap - 1]) if gap > 0 else 0.0, wave_of(table, trace[START, gap])
        wave = first_wave_above(table, curve, before, after, target)
        if wave < after:
            start, _, end, bottom = branch_of_wave(table, curve, wave)
            if wave - 1.0 > before:
                _, _, place, below = branch_of_wave(table, curve, wave - 1.0)
                close = close or abs(below - target) <= tolerance(table, curve, place)
            close = close or abs(bottom - target) <= tolerance(table, curve, end)
            return _find(table, curve, start, end, target, NO), close
    x, near = _turn_at_depth(table, curve, gap, count, trace, reach, target)
    return x, close or near


@kernel()
def _is_first_contact(k: float, b: float, target: float) -> bool:
    """Return whether a depth is that of the first contact, 0, as far as anybody can tell."""
    return abs(target) <= CLOSE * (2.0 / b) ** ((1.0 - k) / (3.0 + k))


@kernel()
def _is_vague(table: Any, arches: tuple[float, float], reach: float) -> bool:
    """Return whether folds stand so far out that no float tells the waves at which loading looks."""
    return is_long(table, arches, reach) and min(arches[1], 2.0 * reach) > MOST_ARCHES


@kernel()
def _is_one_disc(table: Any, curve: Curve, count: int, trace: Any, long: bool, x: float, rim: float) -> bool:
    """Return whether the contact that turns at x is one disc, out to the rim of the punch."""
    _, g, _ = curve
    if g * table.amplitude <= ALWAYS_ONE:
        return True
    level = depth(table, curve, x)
    now = count - 1
    while now >= 0 and trace[START, now] > x:
        now -= 1
    gap = int(trace[RUN, GAP]) if long else count + 1
    if now >= 0 and (not long or now >= gap or x <= trace[END, now]):
        if trace[END, now] == math.inf:
            return True
        lowest = math.inf
        end = min(rim, _reach_outwards(table, curve, max(0.0, level), NO))
        for other in range(now + 1, count):
            if other == gap:
                break
            lowest = min(lowest, trace[START_DEPTH, other])
            if trace[END_DEPTH, other] > level:
                end = min(rim, find_depth(table, curve, level, ends(trace, other)))
                z = TWO_PI * x
                if lowest + z * amplitude_power(table, z) >= level:
                    return True
                break
    else:
        end = min(rim, x + _AROUND)
    return not x < end or least_opening(table, curve, x, end, trace[WORK], trace[VALUES]) >= 0.0


@kernel()
def _turn_smooth(k: float, stretch: float, rims: Any, targets: Any, by_load: bool, radii: Any, flags: Any) -> None:
    """Turn a smooth punch, all its rims, in closed form (smooth.py)."""
    length = smooth.smooth_length(k, stretch)
    depth_scale = 2.0 * length * length / (1.0 + k)
    z_in = 2.0 ** (2.0 / (3.0 + k))
    for i in range(rims.size):
        if not _has_value(rims[i], targets[i], by_load):
            radii[i], flags[i] = math.nan, NO_VALUE
            continue
        if by_load:
            half = 0.5 * (3.0 + k)
            abscissa = half * (1.0 + math.sqrt(1.0 + 2.0 * targets[i] / (smooth.FORCE_SCALE * half)))
            z = abscissa ** (1.0 / half)
        else:
            target = targets[i] / depth_scale
            if abs(target) <= CLOSE:
                flags[i] |= CLOSE_TO_A_JUMP
            if target < 0.0:
                radii[i] = 0.0
                continue
            z = z_in + math.sqrt(2.0 * target)
            for _ in range(_STEPS):
                power = z ** (0.5 * (1.0 - k))
                step = (0.5 * z * z - power - target) / (z - 0.5 * (1.0 - k) * power / z)
                z -= step
                if not step > 1e-16 * z:
                    break
            z = max(z, z_in)
        radii[i] = min(rims[i], z * length)


@kernel()
def _has_value(rim: float, target: float, by_load: bool) -> bool:
    """Return whether rim and target are in their ranges."""
    return rim > 0.0 and abs(target) < math.inf and (target > 0.0 or not by_load)


@kernel()
def _turn_rim(
    table: Any,
    curve: Curve,
    count: int,
    trace: Any,
    peaks: Any,
    long: bool,
    reach: float,
    scene: tuple[float, float, float],
    modes: tuple[bool, bool],
) -> tuple[float, int]:
    """Return x where one scene turns, inf for the rim, and its flags; `scene` is rim, target and lambda/R."""
    rim, target, wavelength = scene
    by_load, check = modes
    b, _, _ = curve
    if by_load:
        if long:
            x, close = _turn_long_at_load(table, curve, count, trace, peaks, reach, target)
        else:
            x, close = _turn_at_load(table, curve, 0, count, trace, peaks, reach, target)
    else:
        if long:
            x, close = _turn_long_at_depth(table, curve, count, trace, reach, target)
        else:
            x, close = _turn_at_depth(table, curve, 0, count, trace, reach, target)
        close = close or _is_first_contact(table.k, b, target)
    flags = 0
    if not (x < rim and x * wavelength < rim * wavelength):
        x = math.inf
        level = depth(table, curve, rim) if rim < math.inf else math.inf
        close = close or rim_is_close(table, curve, count, trace, rim, level)
    elif check and not _is_one_disc(table, curve, count, trace, long, x, rim):
        flags |= LOADING_NOT_ONE_DISC
    return x, flags | CLOSE_TO_A_JUMP if close else flags


@kernel()
def _turn_curve(
    table: Any,
    curve: Curve,
    arches: tuple[float, float],
    scales: tuple[float, float],
    rims: Any,
    targets: Any,
    modes: tuple[bool, bool],
    radii: Any,
    flags: Any,
    scratch: Any,
) -> None:
    """Turn a wavy punch, all its rims: those that need no long curve share one trace."""
    wavelength, unit = scales
    by_load, _ = modes
    b, g, _ = curve
    least, greatest = math.inf, -math.inf
    for i in range(rims.size):
        target = targets[i] / unit
        radii[i], flags[i] = rims[i], 0
        if not _has_value(rims[i], target, by_load):
            radii[i], flags[i] = math.nan, NO_VALUE
        elif target < 0.0:  # the first contact is at the depth 0
            radii[i], flags[i] = 0.0, CLOSE_TO_A_JUMP if _is_first_contact(table.k, b, target) else 0
        else:
            least, greatest = min(least, target), max(greatest, target)
    if greatest < least:
        return
    furthest = 0.0
    reaches = np.zeros(rims.size)
    reach = _reach_outwards(table, curve, greatest, by_load)
    for i in range(rims.size):
        if radii[i] > 0.0:
            reaches[i] = min(rims[i] / wavelength, reach)
            if is_long(table, arches, reaches[i]):
                reaches[i] = min(rims[i] / wavelength, _reach_outwards(table, curve, targets[i] / unit, by_load))
            if is_unresolved(arches, reaches[i]) or _is_vague(table, arches, reaches[i]):
                radii[i], flags[i], reaches[i] = math.nan, NO_VALUE, 0.0
            elif not is_long(table, arches, reaches[i]):
                furthest = max(furthest, reaches[i])
    inner = _reach(table.k, b, 1.0 - g * table.amplitude, least, YES, NO) if by_load else 0.0
    if furthest > 0.0:
        count, trace = walk(table, curve, arches, furthest, scratch, NO)
        peaks = _peaks(table, curve, count, trace, inner, rims.size) if by_load else reaches
        for i in range(rims.size):
            if reaches[i] > 0.0 and not is_long(table, arches, reaches[i]):
                scene = (rims[i] / wavelength, targets[i] / unit, wavelength)
                x, flags[i] = _turn_rim(table, curve, count, trace, peaks, False, reaches[i], scene, modes)
                radii[i] = min(rims[i], x * wavelength)
    for i in range(rims.size):
        if reaches[i] > 0.0 and is_long(table, arches, reaches[i]):
            count, trace = stride(table, curve, arches, reaches[i], scratch, NO, 1.0)
            peaks = _peaks(table, curve, count, trace, inner, 1) if by_load else reaches
            scene = (rims[i] / wavelength, targets[i] / unit, wavelength)
            x, flags[i] = _turn_rim(table, curve, count, trace, peaks, True, reaches[i], scene, modes)
            radii[i] = min(rims[i], x * wavelength)


@kernel()
def turn_curves(
    table: Any,
    index: Any,
    stiffness: Any,
    wavelength: Any,
    amplitude: Any,
    rims: Any,
    targets: Any,
    by_load: bool,
    check: bool,
    radii: Any,
    flags: Any,
    scratch: Any,
) -> None:
    """Find where the curves `index` of one gradient exponent turn.

    Parameters
    ----------
    table, index, stiffness, wavelength, amplitude, rims, scratch
        As those of the loops of solvers.py.
    targets
        What the cycles turn at, of the shape of the rims: depths in R, or loads in 1.5 pi R dgamma.
    by_load, check
        Whether they are loads; whether the contact that turns is tested for being one disc.
    radii, flags
        The results, of the shape (curves, rims): a/R, 0 without contact, NaN without a value; and bits of the status.
    """
    k = table.k
    front = 2.0 ** (1.0 + k) * math.pi
    for j in range(index.size):
        i = index[j]
        row = i if rims.shape[0] > 1 else 0
        stretch = math.sqrt(front / stiffness[i])
        if not (0.0 < stretch < math.inf and 0.0 < wavelength[i] < math.inf and 0.0 <= amplitude[i] < math.inf):
            radii[i, :], flags[i, :] = math.nan, NO_VALUE
            continue
        plain = is_endless_wave(wavelength[i], amplitude[i])
        curve, length, unit = curve_of(k, stretch, wavelength[i], amplitude[i] * wavelength[i])
        arches = (0.0, 0.0)
        if not plain:
            if not (0.0 < curve[0] < LARGEST and curve[1] < LARGEST):
                radii[i, :], flags[i, :] = math.nan, NO_VALUE
                continue
            arches = extent(table, curve)
            plain = is_smooth(arches)
        if by_load:
            unit = force_unit(k, length, unit)
        if plain:
            _turn_smooth(k, stretch, rims[row], targets[row], by_load, radii[i], flags[i])
        else:
            scales, modes = (wavelength[i], unit), (by_load, check)
            _turn_curve(table, curve, arches, scales, rims[row], targets[row], modes, radii[i], flags[i], scratch)
