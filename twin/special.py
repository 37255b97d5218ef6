"""The universal functions of the cosine waviness and the constants of the graded half-space, to 40 digits and more.

    S0(k, z) = int_0^1 (1-t^2)^((k-1)/2) sin(z t) dt = z/(1+k) 1F2(1; 3/2, (3+k)/2; -z^2/4)
    S1(k, z) = int_0^1 (1-t^2)^((k+1)/2) sin(z t) dt = z/(3+k) 1F2(1; 3/2, (5+k)/2; -z^2/4)

S0 is entire in z. `Sine` evaluates it once at each multiple of 1/2, by the hypergeometric series or, far out, by the
expansion of Struve's functions, and goes on from there by Taylor's series, whose coefficients follow from
z S0'' + (1+k) S0' + z S0 = 1;  then S1 = S0 + S0''.
"""

from dataclasses import dataclass
from typing import Final

import flint
from flint import arb, arb_poly

from gradhesion.twin import PRECISION

DEGREE: Final = 30
"""The n-th Taylor coefficient is below 1.6/n!: at |t| <= 1/4 the rest after degree 30 is below 1e-50, of S0'' 1e-46."""

FAR: Final = 200.0
"""z beyond which Struve's expansion has a term below 2^-240 (its least is about e^-z)."""


def s0_series(k: arb, z: arb) -> arb:
    """S0 by its hypergeometric series; the alternating terms grow as e^z, and so does the precision."""
    with flint.ctx.workprec(PRECISION + 40 + int(1.45 * float(abs(z)))):
        return z / (1 + k) * (-z * z / 4).hypgeom([arb(1)], [arb(3) / 2, (3 + k) / 2])


def s1_series(k: arb, z: arb) -> arb:
    """S1 by its hypergeometric series."""
    with flint.ctx.workprec(PRECISION + 40 + int(1.45 * float(abs(z)))):
        return z / (3 + k) * (-z * z / 4).hypgeom([arb(1)], [arb(3) / 2, (5 + k) / 2])


def struve_expansion(order: arb, z: arb) -> arb:
    """Return sqrt(pi)/2 G(v + 1/2) (z/2)^(-v) H_v(z) of the order v >= 0, for z > FAR.

    It is S0 for v = k/2 and S1 for v = 1 + k/2. H_v - Y_v is an alternating series whose rest is below the first term
    left out (DLMF 11.6.1); near an integer order Y_v cancels, up to twice the 53 bits of a k next to 0.
    """
    with flint.ctx.workprec(PRECISION + 160):
        total, term, m = arb(0), 1 / z, 0
        while not abs(term) < arb(2) ** -240:
            total += term
            term *= (m + arb(1) / 2) * (order - arb(1) / 2 - m) * 4 / (z * z)
            m += 1
        wave = arb.pi().sqrt() / 2 * (order + arb(1) / 2).gamma() * (z / 2) ** -order * z.bessel_y(order)
        return total + arb(0, abs(term).upper()) + wave


@dataclass(frozen=True)
class _Bin:
    """Taylor polynomials in z - centre."""

    centre: arb
    s0: arb_poly
    first: arb_poly
    second: arb_poly
    third: arb_poly


class Sine:
    """S0 and its derivatives for one k; the bins are filled as they are asked for."""

    def __init__(self, k: arb) -> None:
        """Start with no bin but the one at z = 0, where S0 is odd."""
        self.k = k
        self._bins: dict[int, _Bin] = {}
        s = [arb(0), 1 / (1 + k)]
        for n in range(2, DEGREE + 1):
            s.append(-s[n - 2] / (n * (n + k)))
        self._add(0, s)
        # V = (z S0)'/z is even and regular at 0
        self._v = arb_poly([(n + 1) * s[n] for n in range(1, DEGREE + 1)])
        self._v_first = self._v.derivative()

    def _add(self, index: int, s: list[arb]) -> _Bin:
        p = arb_poly(s)
        d1 = p.derivative()
        d2 = d1.derivative()
        self._bins[index] = made = _Bin(arb(index) / 2, p, d1, d2, d2.derivative())
        return made

    def _bin(self, z: arb) -> _Bin:
        index = round(2 * float(z))
        found = self._bins.get(index)
        if found is not None:
            return found
        k, centre = self.k, arb(index) / 2
        if centre > FAR:
            s0, s1 = struve_expansion(k / 2, centre), struve_expansion(1 + k / 2, centre)
        else:
            s0, s1 = s0_series(k, centre), s1_series(k, centre)
        s = [s0, (1 - centre * s1) / (1 + k)]
        for n in range(DEGREE - 1):
            rest = arb(1 if n == 0 else 0) - (n + 1) * (n + 1 + k) * s[n + 1] - centre * s[n]
            s.append((rest - s[n - 1] if n else rest) / (centre * ((n + 1) * (n + 2))))
        return self._add(index, s)

    def pair(self, z: arb) -> tuple[arb, arb]:
        """S0 and S1."""
        here = self._bin(z)
        t = z - here.centre
        s0 = here.s0(t)
        return s0, s0 + here.second(t)

    def s0(self, z: arb) -> arb:
        """S0 alone."""
        here = self._bin(z)
        return here.s0(z - here.centre)

    def slopes(self, z: arb) -> tuple[arb, arb]:
        """S0' and S1'."""
        here = self._bin(z)
        t = z - here.centre
        first = here.first(t)
        return first, first + here.third(t)

    def v(self, z: arb) -> tuple[arb, arb]:
        """V = (z S0)'/z and V'; for a ball that crosses no bin edge an enclosure of all its values."""
        here = self._bin(z)
        if here.centre == 0:
            return self._v(z), self._v_first(z)
        t = z - here.centre
        s0, first = here.s0(t), here.first(t)
        return s0 / z + first, first / z - s0 / (z * z) + here.second(t)


def theta(k: arb, nu: arb) -> arb:
    """Stiffness factor of the graded half-space; at k = 1, nu = 1/2 cos(k pi/2)/(beta sin(beta pi/2)) is 1/2."""
    pi = arb.pi()
    beta2 = (1 + k) * (1 - k * nu / (1 - nu))
    if k == 1 and nu == arb("0.5"):
        beta, ratio = arb(0), arb(1) / 2
    else:
        beta = beta2.sqrt()
        ratio = (k * pi / 2).cos() / (beta * (beta * pi / 2).sin())
    c = 2 ** (1 + k) * ((3 + k + beta) / 2).gamma() * ((3 + k - beta) / 2).gamma() / (pi * (2 + k).gamma())
    return 2 ** (1 + k) * (1 + k) * ratio * (1 + k / 2).gamma() / (pi.sqrt() * c * ((1 + k) / 2).gamma())
