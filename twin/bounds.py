"""Where folds and troughs can stand at all, from bounds of the waves that hold for every k in [0, 1].

The integrals taken up the imaginary axis from t = 0 and t = 1 leave, with e = (k-1)/2 and C = 2^e G(1+e),

    |S0|, |T0| <= min(T0(0), 1/y + C y^(-1-e))
    |V_S|, |V_T| <= min(T0(0)(1 + y), 2/y + C y^(-e) (1 + (2+e)/y))
    |S0 - S1|, |T0 - T1| <= 2/y^3 + C y^(-1-e) (1 + (1+e)(2+e)/y^2)

so that the tilt is positive, or P, wherever the powers of a outweigh them. Next to a = 0 the tilt is a sum of powers of
z and a rest that is smaller; it has one sign as far as the lowest of the powers outweighs all others.
"""

import math
from typing import TYPE_CHECKING, Final

from flint import arb

if TYPE_CHECKING:
    from gradhesion.twin.curve import Control, Curve

SMALLEST: Final = 1e-280
"""Phase at which the search for a sign next to a = 0 is given up."""
LARGEST: Final = 1e9
"""Phase from which on no end of the folds is looked for."""
GROWTH: Final = 1.03
FACTOR: Final = 1.25
"""From one phase of a grid to the next, where the waves are longer."""


def _osculating(curve: "Curve") -> tuple[float, float]:
    """C and e."""
    e = 0.5 * (float(curve.k) - 1)
    return 2.0**e * math.gamma(1 + e), e


def greatest(curve: "Curve", y: arb) -> arb:
    """Return the bound of |S0| and |T0|."""
    if not y > 0:
        return curve.series.start
    front, e = _osculating(curve)
    far = 1 / y + front * y ** (-1 - e)
    return min(curve.series.start, far)


def _powers_at_zero(curve: "Curve", control: "Control") -> tuple[dict[float, arb], dict[float, arb]]:
    """Return the coefficients of the powers of z in the tilt next to 0, and those of bounds of the rest."""
    k, m, c, series = float(curve.k), float(curve.m), float(curve.c), curve.series
    alpha, beta, _ = control
    length = curve.wavelength / (2 * arb.pi())
    wave = 2 * arb.pi() * curve.amplitude
    powers: dict[float, arb] = {}
    rest: dict[float, arb] = {}

    def add(to: dict[float, arb], power: float, size: arb) -> None:
        to[power] = to.get(power, arb(0)) + size

    add(powers, m - 1, curve.m * curve.front * length ** (curve.m - 1))
    if curve.amplitude > 0:
        add(powers, 0.0, wave * series.start * series.moment(1, sine=True))
        add(powers, 1.0, wave * 2 / (1 + curve.k) * series.moment(2, sine=False))
        add(rest, 2.0, wave * arb(3) / 2 * series.start * series.moment(3, sine=True, sizes=True))
        add(rest, 3.0, wave * arb(2) / 3 / (1 + curve.k) * series.moment(4, sine=False, sizes=True))
    kappa, steepest = curve.pattern.at(arb(0))[0], arb(curve.pattern.steepest)
    if steepest > 0 and (k == 1.0 or not kappa > 0):
        message = "the tilt next to zero contact has no certain sign over this pattern of toughness"
        raise ArithmeticError(message)
    pull = curve.adhesion * length ** (curve.c - 1)
    if k < 1.0 or alpha == 0:
        level = curve.c if alpha > 0 else (3 + curve.k) / 2  # the least
        add(powers, c - 1, -level * kappa * pull)
        if steepest > 0:
            add(rest, c, ((3 + curve.k) / 2 + 1) * steepest * length * pull)
    elif beta > 0:  # 2 tau/(alpha + tau) with tau = beta a^2
        add(powers, 1.0, -2 * beta / alpha * length**2 * pull)
        add(rest, 3.0, 2 * (beta / alpha) ** 2 * length**4 * pull)
    return {power: size for power, size in powers.items() if size != 0}, {
        power: size for power, size in rest.items() if size != 0
    }


def first(curve: "Curve", control: "Control") -> arb:
    """Return a phase up to which the tilt has one sign."""
    powers, rest = _powers_at_zero(curve, control)
    lowest = min(powers)
    others = [(power - lowest, abs(size)) for power, size in powers.items() if power != lowest]
    others += [(power - lowest, size) for power, size in rest.items()]
    z = 1.0 / curve.shortest
    while z > SMALLEST:
        if abs(powers[lowest]) > sum((size * arb(z) ** power for power, size in others), arb(0)):
            return arb(z)
        z *= 0.5
    message = "the tilt next to zero contact has no certain sign"
    raise ArithmeticError(message)


def _rises(curve: "Curve", control: "Control", z: float) -> bool:
    """Tell whether the tilt is positive at z and, as m - 1 >= (1-k)/2, beyond."""
    front, e = _osculating(curve)
    waves = 0.0
    for n, even, odd in curve.series.harmonics:
        y = n * z
        waves += n * math.hypot(even, odd) * (2 / y + front * y**-e * (1 + (2 + e) / y))
    a = curve.radius(arb(z))
    level = curve.c if control.beta == 0 else (3 + curve.k) / 2
    bend = curve.m * curve.front * a ** (curve.m - 1)
    level = level * curve.pattern.greatest + a * curve.pattern.steepest
    return bool(bend > 1.001 * (2 * arb.pi() * curve.amplitude * waves + level * curve.adhesion * a ** (curve.c - 1)))


def _presses(curve: "Curve", z: float) -> bool:
    """Tell whether P is positive at z and beyond."""
    front, e = _osculating(curve)
    waves = 0.0
    for n, even, odd in curve.series.harmonics:
        y = n * z
        waves += n * math.hypot(even, odd) * (2 / y**3 + front * y ** (-1 - e) * (1 + (1 + e) * (2 + e) / (y * y)))
    a = curve.radius(arb(z))
    bend = curve.m / (1 + curve.k + curve.m) * curve.front * a**curve.m
    pull = curve.pattern.greatest * curve.adhesion * a**curve.c + 2 * arb.pi() * curve.amplitude * a * waves
    return bool(bend > 1.001 * pull)


def last(curve: "Curve", control: "Control") -> float:
    """Return a phase beyond which Y rises, or the load is positive where it has to pull; inf if there is none."""
    ends = bool(curve.m - 1 >= curve.c) or not curve.amplitude > 0
    z = 1.0
    while z < LARGEST:
        if (ends and _rises(curve, control, z)) or (control.pulling and _presses(curve, z)):
            return z
        z *= GROWTH
    return math.inf


def grid(curve: "Curve", control: "Control", end: arb | None) -> list[arb]:
    """Return the edges of pieces, half a radian of the shortest wave at most, that cover all zeros of the tilt."""
    low, high = float(first(curve, control)), last(curve, control)
    if end is not None and end < high:
        high = math.inf
    elif high == math.inf:
        message = "the folds have no end"
        raise ArithmeticError(message)
    stop = arb(high) if high < math.inf else end
    assert stop is not None
    widest = 0.5 / curve.shortest
    edges, z = [arb(low)], low
    while True:
        z += min(widest, (FACTOR - 1) * z)
        if not z < stop:
            break
        edges.append(arb(z))
    return [*edges, stop] if low < stop else []


def waves_within(curve: "Curve", *, cycle: bool) -> float:
    """Estimate how many waves of the shortest are gone through, weighed by what each costs against one cosine wave."""
    furthest = last(curve, curve.trough)
    if cycle:
        share = curve.m / (1 + curve.k + curve.m) if curve.fold.alpha == 0 else 1
        held = (curve.adhesion / (share * curve.front)) ** (1 / (curve.m - curve.c))
        furthest = max(furthest, last(curve, curve.fold), float(curve.phase(held)))
    if curve.rim is not None:
        furthest = min(furthest, float(curve.rim))
    return furthest / (2 * math.pi) * curve.shortest * (1 + len(curve.series.harmonics) / 16)
