"""The universal functions of the cosine waviness and the constants of the graded half-space, to 40 digits and more.

S0(k, z) = int_0^1 (1-t^2)^((k-1)/2) sin(z t) dt = z/(1+k) 1F2(1; 3/2, (3+k)/2; -z^2/4)
S1(k, z) = int_0^1 (1-t^2)^((k+1)/2) sin(z t) dt = z/(3+k) 1F2(1; 3/2, (5+k)/2; -z^2/4)
"""

from typing import Final

import flint
from flint import arb

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
