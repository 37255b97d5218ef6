"""The sum over the waves of a profile, by the phase z = 2 pi a/lambda of the longest.

    W(z) = sum n [cos_n S0(n z) + sin_n T0(n z)],     U(z) = sum n [cos_n S1(n z) + sin_n T1(n z)]

with S1 = S0 + S0'' and T1 = T0 + T0''. The depth gains 2 pi A a W and the integral in P_H 2 pi A a^(2+k) U. Their
Taylor series about the multiples of 2 over the greatest n are made once, from those of each wave.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from flint import arb, arb_poly

from gradhesion.twin.integrals import Integral, taylor, taylor_at_zero
from gradhesion.twin.shape import Harmonic

WIDTH: Final = 2
"""Phase of the shortest wave from one series to the next."""
TERMS: Final = 48
"""Degree of a series: what follows is below 1e-55 for phases of the shortest wave up to 1.25."""


@lru_cache(maxsize=4)
def integral_of(k: float, *, sine: bool) -> Integral:
    """Return an integral of k, shared by the scenes that have it."""
    return Integral(arb(k), sine=sine)


@lru_cache(maxsize=2)
def series_of(k: float, harmonics: tuple[Harmonic, ...]) -> "Series":
    """Return the sum over waves, shared by the scenes that have it."""
    return Series(k, harmonics)


@dataclass(frozen=True)
class _Bin:
    """Taylor polynomials in z - centre."""

    centre: arb
    w: arb_poly
    first: arb_poly
    second: arb_poly
    u: arb_poly


class Series:
    """W, U and the slope V = (z W)' for one k; bins are filled as they are asked for."""

    def __init__(self, k: float, harmonics: Sequence[Harmonic]) -> None:
        """Start without a bin."""
        self.k = arb(k)
        self.harmonics = tuple(harmonics)
        self.shortest = max((n for n, _, _ in harmonics), default=1)
        self._sine, self._cosine = integral_of(k, sine=True), integral_of(k, sine=False)
        self.start = self._cosine.start
        self._bins: dict[int, _Bin] = {}

    def moment(self, power: int, *, sine: bool, sizes: bool = False) -> arb:
        """Return the sum of n^power sin_n or cos_n, or of their sizes."""
        waves = ((n, odd if sine else even) for n, even, odd in self.harmonics)
        return sum((arb(n) ** power * (abs(arb(size)) if sizes else arb(size)) for n, size in waves), arb(0))

    def _wave(self, n: int, even: float, odd: float, z: arb) -> list[arb]:
        """Return the Taylor coefficients in y = n z of n [cos_n S0 + sin_n T0]; the equation of both is linear."""
        y = n * z
        here = [one.at(y) if z > 0 else one.at_zero for one in (self._sine, self._cosine)]
        f, slope = (n * (even * here[0][i] + odd * here[1][i]) for i in range(2))
        return taylor(self.k, y, f, slope, arb(n) * even, TERMS) if z > 0 else taylor_at_zero(self.k, f, slope, TERMS)

    def _bin(self, z: arb) -> _Bin:
        index = round(self.shortest * float(z) / WIDTH)
        found = self._bins.get(index)
        if found is not None:
            return found
        centre = arb(index) * WIDTH / self.shortest
        w, u = arb_poly([]), arb_poly([])
        for n, even, odd in self.harmonics:
            terms = arb_poly(self._wave(n, even, odd, centre))
            scale = arb_poly([0, n])
            w += terms(scale)
            u += (terms + terms.derivative().derivative())(scale)
        first = w.derivative()
        made = _Bin(centre, w, first, first.derivative(), u)
        self._bins[index] = made
        return made

    def pair(self, z: arb) -> tuple[arb, arb]:
        """W and U."""
        here = self._bin(z)
        return here.w(z - here.centre), here.u(z - here.centre)

    def v(self, z: arb) -> tuple[arb, arb]:
        """V = W + z W' and V'; for a ball no wider than a bin an enclosure of all its values."""
        here = self._bin(z)
        t = z - here.centre
        first, second = here.first(t), here.second(t)
        return here.w(t) + z * first, 2 * first + z * second
