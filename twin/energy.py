"""Energy of the cycle: the drop of potential in every jump, and as a check the loop integral.

    e_j = int 2 pi a [1 - rho^2] da  from start to end of the jump,   rho = (delta_H - delta_j)/Delta

keeps its sign: where adhesion is weak (r > s, or nearly) the one-disc state can climb in a loading jump, e_j < 0, and
only the signed sum is the loop integral of P d(delta). Where it is not the depth that is held rho = x/Delta with
x = (alpha delta_H + beta P_H/K - Y_j)/(alpha + beta a^(1+k)). The integrand has an a^k branch point at a = 0: a jump
from or to a = 0 has its first piece done by the rule  a = b u, u = (1 + tanh(pi/2 sinh t))/2,  which no branch point at
the ends can slow; all other pieces, at most half a wave long, by Gauss and Legendre.
"""

from collections.abc import Callable
from functools import cache
from typing import Final

from flint import arb

from gradhesion.twin.curve import Curve
from gradhesion.twin.path import Jump, Path

NODES: Final = 28
"""Gauss-Legendre nodes a piece: 30 digits for half a wave, or for a piece as long as its distance from 0."""

PANEL: Final = 3.0
"""Phase of the shortest wave in a piece."""

STEP: Final = arb(1) / 16
"""Step of the double exponential rule; with 16 it has 30 digits for a^k, k >= 0, on a quarter wave."""


@cache
def legendre() -> list[tuple[arb, arb]]:
    """Nodes and weights on (0, 1)."""
    rule = [arb.legendre_p_root(NODES, i, weight=True) for i in range(NODES)]
    return [((1 + x) / 2, w / 2) for x, w in rule]


@cache
def double_exponential() -> list[tuple[arb, arb]]:
    """Nodes and weights on (0, 1); the nodes nearest to 0 are about 1e-40."""
    rule: list[tuple[arb, arb]] = []
    for i in range(-66, 67):
        t = STEP * i
        q = (-arb.pi() * t.sinh()).exp()
        rule.append((1 / (1 + q), STEP * arb.pi() * t.cosh() * q / (1 + q) ** 2))
    return rule


def integral(curve: Curve, f: Callable[[arb], arb], lo: arb, hi: arb) -> arb:
    """Return the integral of f, a function on the curve, over phases from lo to hi."""
    total = arb(0)
    if lo == 0:
        width = min(float(hi), curve.innermost)
        end = hi if width == float(hi) else arb(width)
        total += end * sum((w * f(end * u) for u, w in double_exponential()), arb(0))
        lo = end
    while lo < hi:
        end = lo + min(float(lo), PANEL / curve.shortest)
        end = hi if not end < hi else end.mid()
        total += (end - lo) * sum((w * f(lo + (end - lo) * u) for u, w in legendre()), arb(0))
        lo = end
    return total


def dissipated(curve: Curve, jump: Jump) -> arb:
    """Drop of potential energy in a jump, negative where the potential rises."""
    scale = curve.wavelength / (2 * arb.pi())

    def density(z: arb) -> arb:
        ratio = curve.ratio(z, jump.level)
        return curve.radius(z) * (curve.release(z) - ratio * ratio)

    lo, hi = (jump.start, jump.end) if jump.start < jump.end else (jump.end, jump.start)
    drop = 2 * arb.pi() * scale * integral(curve, density, lo, hi)
    return drop if jump.start < jump.end else -drop


def loop(curve: Curve, path: Path) -> arb:
    """Return the same energy as the loop integral of P dY along branches and the line at the rim; not for a load."""
    assert curve.rim is not None

    def work(lo: arb, hi: arb) -> arb:
        return integral(curve, lambda z: curve.force(z) * curve.slope(z), lo, hi)

    result = arb(0)
    at = arb(0)
    for jump in path.loading:
        if at > 0:
            result += work(at, jump.start)
        at = jump.end
    if at < curve.rim:
        result += work(at, curve.rim)
    result -= curve.work_at_rim(path.largest)
    at = curve.rim
    for jump in path.unloading:
        if jump.start < at:
            result -= work(jump.start, at)
        at = jump.end
    return result - work(arb(0), at) if at > 0 else result


def area(curve: Curve) -> arb:
    """Return the area within the rim, each part by its work of adhesion over dgamma; inf without a rim."""
    if curve.rim is None:
        return arb("inf")
    scale = curve.wavelength / (2 * arb.pi())
    return (
        2
        * arb.pi()
        * scale
        * integral(curve, lambda z: curve.radius(z) * curve.release(z) / curve.work, arb(0), curve.rim)
    )
