"""The two integrals of a wave, each with its slope, and their Taylor series about any point.

    S0(k, y) = int_0^1 (1-t^2)^((k-1)/2) sin(y t) dt,      T0(k, y) = int_0^1 (1-t^2)^((k-1)/2) cos(y t) dt

T0 = T0(0) 0F1(1 + k/2; -y^2/4) is a Bessel function where S0 is one of Struve. Both obey  y f'' + (1+k) f' + y f = e
with e = 1 for S0 and 0 for T0, so that one recursion gives every Taylor coefficient from f and f'.
"""

from collections.abc import Callable

from flint import arb, arb_poly

from gradhesion.twin.special import DEGREE, FAR, s0_series, s1_series, struve_expansion


def taylor(k: arb, y: arb, f: arb, slope: arb, forcing: arb, degree: int) -> list[arb]:
    """Return the Taylor coefficients about y > 0 of the solution that has f and its slope there."""
    made = [f, slope]
    for n in range(degree - 1):
        rest = (forcing if n == 0 else 0) - (n + 1) * (n + 1 + k) * made[n + 1] - y * made[n]
        made.append((rest - made[n - 1] if n else rest) / (y * ((n + 1) * (n + 2))))
    return made


def taylor_at_zero(k: arb, f: arb, slope: arb, degree: int) -> list[arb]:
    """Return those about y = 0, where the slope is e/(1+k): S0 is odd, T0 even."""
    made = [f, slope]
    for n in range(2, degree + 1):
        made.append(-made[n - 2] / (n * (n + k)))
    return made


class Integral:
    """S0 or T0 of one k, evaluated once at each multiple of 1/2 and from there by Taylor's series."""

    def __init__(self, k: arb, *, sine: bool) -> None:
        """Choose S0 (`sine`) or T0."""
        self.k, self.forcing = k, arb(1 if sine else 0)
        self.start = arb.pi().sqrt() / 2 * ((1 + k) / 2).gamma() / (1 + k / 2).gamma()
        """T0(0), the greatest value of either."""
        self._values: Callable[[arb], tuple[arb, arb]] = self._sine if sine else self._cosine
        self.at_zero = (arb(0), 1 / (1 + k)) if sine else (self.start, arb(0))
        self._bins: dict[int, tuple[arb_poly, arb_poly]] = {}
        self._keep(0, taylor_at_zero(k, *self.at_zero, DEGREE))

    def _keep(self, index: int, coefficients: list[arb]) -> tuple[arb_poly, arb_poly]:
        series = arb_poly(coefficients)
        self._bins[index] = series, series.derivative()
        return self._bins[index]

    def _sine(self, y: arb) -> tuple[arb, arb]:
        """S0 and its slope from the hypergeometric series, or from the expansion of Struve's functions."""
        k = self.k
        if y > FAR:
            return struve_expansion(k / 2, y), (1 - y * struve_expansion(1 + k / 2, y)) / (1 + k)
        return s0_series(k, y), (1 - y * s1_series(k, y)) / (1 + k)

    def _cosine(self, y: arb) -> tuple[arb, arb]:
        """T0 and its slope -y T1/(1+k), T1 the same of the order 1 + k/2."""
        order = self.k / 2
        front = arb.pi().sqrt() / 2 * ((1 + self.k) / 2).gamma() * (y / 2) ** -order
        return front * y.bessel_j(order), -front * y.bessel_j(1 + order)

    def at(self, y: arb) -> tuple[arb, arb]:
        """Return f and f' at y >= 0."""
        index = round(2 * float(y))
        centre = arb(index) / 2
        found = self._bins.get(index)
        if found is None:
            found = self._keep(index, taylor(self.k, centre, *self._values(centre), self.forcing, DEGREE))
        return found[0](y - centre), found[1](y - centre)
