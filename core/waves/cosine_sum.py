"""The energy lost in the jumps of millions of waves, from at most a hundred of them.

Far from zero contact loading goes from every wave to the next one, and so does unloading. What such a jump loses is a
smooth function e of the index of the wave, which may be any real number (waves/cosine.py). So the sum is an integral,
with Euler's and Maclaurin's terms from a few single waves at both ends:

    sum_{w=p}^{q} e_w = int_{p-1/2}^{q+1/2} e dw - [e'/24 - 7 e'''/5760 + 31 e^(5)/967680 - ...] between the limits

The function has two branch points, both outside of the sum. At one, w = `outer`, the last fall of the coordinate
vanishes: e is a power series in the root of the distance there, and in w^((1+k)/4) further in. Gauss's rule is used in
y, with w = outer (1 - y^2)^4. At the other, w = `inner`, neighbouring waves are level, and a jump just reaches the fold
of the wave on which it lands: e has the power 3/2 of the distance. Near it Gauss's rule is used in v,
w = inner + v^2.

    outer   b z^n = g C + (1-k)/(2 z), half a wave before it (outwards) or after it (inwards)
    inner   b z^(1+n) = (1-k)/2 (1 -+ g C), where the upper or the lower envelope of the depth is level

Against the sum wave by wave, of 10^2 to 10^5 of them: 1e-12 of the loss, mostly 1e-15 (test_cosine_sum.py).
"""

import math
from typing import Final

from gradhesion.core.compiler.jit import NO, YES, kernel
from gradhesion.core.curve.cosine import Cosine
from gradhesion.core.curve.cosine_energy import NODES, WEIGHTS
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.types import Floats, Table
from gradhesion.core.waves.cosine_at_once import BATCH, LOSSES, WAVES, Batch, jumps_in_a_row, jumps_of_batch

_EDGE: Final = 4
"""Waves at a limit of the integral that are added one by one: its derivatives there come from eight around it."""
_FIRST: Final = BATCH - _EDGE
"""The same at the first limit: waves next to a branch point are no polynomial."""
_DIRECT: Final = 4 * BATCH
"""Waves that are summed one by one."""
_WIDE: Final = 0.3
"""The inner branch point over the first wave from which on the integral is split into two parts."""
_LONG: Final = 500.0
"""Last wave over the first one from which on it is, too."""
_PART: Final = 6.0
"""Outer end of the inner part over its begin."""
_EVEN: Final = 2.0e7
"""Number of waves from which on the terms at the limits are below rounding, 1/(12 N^2)."""
_LONGEST: Final = 1e4
"""End of the outer part over its begin from which on it is split in two."""
_FRACTION: Final = 0.03
"""Begin of the last part of such an integral over its end."""
_REMOTE: Final = 1e8
"""Outer branch point over the last wave of a sum, from which on it makes no difference where it stands."""


@kernel()
def limit_terms(values: Floats) -> float:
    """Return e'/24 - 7 e'''/5760 + 31 e^(5)/967680 - 127 e^(7)/154828800 in the middle of 8 values, or of 6."""
    half = values.size // 2
    one, two = values[half] - values[half - 1], values[half + 1] - values[half - 2]
    three = values[half + 2] - values[half - 3]
    third, fifth, seventh = two - 3.0 * one, three - 5.0 * two + 10.0 * one, 0.0
    if half > 3:
        seventh = values[half + 3] - values[half - 4] - 7.0 * three + 21.0 * two - 35.0 * one
    slope = one - third / 24.0 + 3.0 * fifth / 640.0 - 5.0 * seventh / 7168.0
    bow = third - fifth / 8.0 + 37.0 * seventh / 1920.0
    rest = 31.0 / 967680.0 * (fifth - 5.0 * seventh / 24.0) - 127.0 / 154828800.0 * seventh
    return slope / 24.0 - 7.0 / 5760.0 * bow + rest


@kernel()
def branch_points(table: Table, curve: Cosine, final: float, outwards: bool) -> tuple[float, float]:
    """Return the real indices of waves at which what a jump loses is not smooth, the inner and the outer one.

    `final` is the last arch on which the curve can fold, a bound that is one arch and a half too far
    (curve/cosine_folds.py).
    """
    b, g, _ = curve
    sign = 1.0 if outwards else -1.0
    k = table.k
    level = 0.5 * (1.0 - k) * max(0.0, 1.0 - sign * g * table.amplitude)
    z = (level / b) ** (2.0 / (3.0 + k))
    return (z - table.phase) / TWO_PI - 0.75 * sign, 0.5 * final - 0.75 - 0.5 * sign


@kernel()
def limits(begin: float, end: float, at: tuple[float, bool]) -> tuple[float, float, float]:
    """Return a branch point, and the limits of the integral between two waves in y, or in v, as `at` says.

    They are the lower one, y at the end or v at the begin, and how much larger the other one is: not as a difference of
    the two, which would lose the length of a short run far out over its place.
    """
    point, in_y = at
    if not in_y:
        point = min(point, begin)
        low = math.sqrt(begin - point)
        return point, low, (end - begin) / (low + math.sqrt(end - point))
    point = min(max(point, end), _REMOTE * end)  # so that 1 - y^2 keeps its digits
    near, far = (begin / point) ** 0.25, (end / point) ** 0.25
    low, high = math.sqrt(1.0 - far), math.sqrt(1.0 - near)
    return point, low, (end - begin) / (point * (near + far) * (near * near + far * far) * (low + high))


@kernel()
def place_and_share(point: float, place: float, weight: float, in_y: bool) -> tuple[float, float]:
    """Return the wave at y, or v, and the weight there of an integral over waves, by that in y or v."""
    if not in_y:
        return point + place * place, weight * 2.0 * place
    rest = 1.0 - place * place
    return point * rest**4, weight * 8.0 * point * place * rest**3


@kernel()
def _part(
    table: Table, curve: Cosine, begin: float, end: float, at: tuple[float, bool], outwards: bool, room: Batch
) -> float:
    """Return the integral between two waves in y or in v."""
    _, in_y = at
    point, low, width = limits(begin, end, at)
    for i in range(BATCH):
        room[WAVES + i], _ = place_and_share(point, low + width * NODES[i], 1.0, in_y)
    jumps_of_batch(table, curve, outwards, room)
    total = 0.0
    for i in range(BATCH):
        _, part = place_and_share(point, low + width * NODES[i], WEIGHTS[i] * room[LOSSES + i], in_y)
        total += part
    return total * width


@kernel()
def _integral(
    table: Table, curve: Cosine, begin: float, end: float, points: tuple[float, float], outwards: bool, room: Batch
) -> float:
    """Return the integral of what a jump loses over the index of its wave."""
    inner, outer = points
    total = 0.0
    if inner > _WIDE * begin or end > _LONG * begin:
        middle = max(begin, min(_PART * max(inner, begin), math.sqrt(begin * end)))
        total += _part(table, curve, begin, middle, (inner, NO), outwards, room)
        begin = middle
    if end > _LONGEST * begin:
        total += _part(table, curve, begin, _FRACTION * end, (outer, YES), outwards, room)
        begin = _FRACTION * end
    return total + _part(table, curve, begin, end, (outer, YES), outwards, room)


@kernel()
def sum_of_waves(
    table: Table, curve: Cosine, first: float, last: float, outwards: bool, final: float, room: Batch
) -> float:
    """Return the sum of what the jumps from the waves `first` to `last` lose, in 2 pi l^2 dgamma.

    Outwards each goes from the end of a wave's branch to the next wave, inwards from its start to the one before.
    `final` is the last arch on which the curve can fold.
    """
    points = branch_points(table, curve, final, outwards)
    if last - first > _EVEN:
        return _integral(table, curve, first - 0.5, last + 0.5, points, outwards, room)
    total = 0.0
    if last - first < _DIRECT:
        while first <= last:
            jumps_in_a_row(table, curve, first, last, outwards, room)
            for i in range(min(BATCH, int(last - first) + 1)):
                total += room[LOSSES + i]
            first += BATCH
        return total
    jumps_in_a_row(table, curve, first, last, outwards, room)
    for i in range(_FIRST):
        total += room[LOSSES + i]
    total += limit_terms(room[LOSSES + _FIRST - _EDGE : LOSSES + BATCH])
    jumps_in_a_row(table, curve, last - (2 * _EDGE - 1), last, outwards, room)
    for i in range(_EDGE):
        total += room[LOSSES + _EDGE + i]
    total -= limit_terms(room[LOSSES : LOSSES + 2 * _EDGE])
    return total + _integral(table, curve, first + (_FIRST - 0.5), last - _EDGE + 0.5, points, outwards, room)
