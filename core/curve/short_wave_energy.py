"""The energy lost in a jump at fixed depth in the asymptotic form (curve/cosine_energy.py has the exact one).

At the depth d from one contact radius to another it is, in units of 2 pi l^2 dgamma and with D = d - g and
rho = (b z^2/2 - D)/z^c + chi sin(z - phi),

    e = int z [1 - rho^2] dz = z^2/2 - b^2 z^(5+k)/(4 (5+k)) + b D z^(3+k)/(3+k) - D^2 z^(1+k)/(1+k)
                               - 2 chi int z^n (b z^2/2 - D) sin(z - phi) dz - chi^2 int z sin^2(z - phi) dz

Against quadrature it is right to 1e-8 of the size of its terms where the jump begins or ends below z = 4, to 1e-12
elsewhere: far within the error lambda/a of the form itself.
"""

import math

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.short_wave import ShortWave

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_PANEL = 7.8
"""The longest panel, 1.25 waves (curve/cosine_energy.py)."""
_SMALL = 4.0
"""z below which the powers of z are felt by Gauss's rule: the variable is z^(1/4) there."""
_LARGE = 40.0
"""z from which the integral of a power times a sine is its asymptotic series."""
_MANY = 512.0
"""Length of a jump from which the antiderivative is taken."""


@kernel()
def _integrand(wave: ShortWave, target: float, z: float) -> float:
    """Return z (1 - rho^2)."""
    k, b, chi, g, phi = wave
    rho = (0.5 * b * z * z + g - target) / z ** (0.5 * (1.0 - k)) + chi * math.sin(z - phi)
    return z * (1.0 - rho) * (1.0 + rho)


@kernel()
def _by_panels(wave: ShortWave, target: float, low: float, high: float) -> float:
    """Integrate by Gauss's rule."""
    panels = int((high - low) / _PANEL) + 1
    half = 0.5 * (high - low) / panels
    total = 0.0
    for panel in range(panels):
        centre = low + (2.0 * panel + 1.0) * half
        for node, weight in zip(_NODES, _WEIGHTS):  # noqa: B905 (numba has no strict)
            total += weight * _integrand(wave, target, centre + half * node)
    return total * half


@kernel()
def _near_zero(wave: ShortWave, target: float, low: float, high: float) -> float:
    """Integrate by Gauss's rule in t = z^(1/4)."""
    start, end = low**0.25, high**0.25
    total = 0.0
    for node, weight in zip(_NODES, _WEIGHTS):  # noqa: B905
        t = 0.5 * (start + end + (end - start) * node)
        total += weight * 4.0 * t**3 * _integrand(wave, target, t**4)
    return total * 0.5 * (end - start)


@kernel()
def _power_times_sine(power: float, phi: float, z: float) -> float:
    """Return int z^power sin(z - phi) dz for z >= 40 (by parts; what is left is below 1e-12)."""
    real, imaginary = 0.0, 1.0  # of the factor of e^(i (z - phi)): the sum of -i (i d/dz)^j
    term = z**power
    total = 0.0
    sine, cosine = math.sin(z - phi), math.cos(z - phi)
    for j in range(10):
        total += term * (real * sine - imaginary * cosine)
        real, imaginary = imaginary, -real
        term *= (power - j) / z
    return total


@kernel()
def _antiderivative(wave: ShortWave, target: float, z: float) -> float:
    """Return the integral in closed form for z >= 40."""
    k, b, chi, g, phi = wave
    n = 0.5 * (1.0 + k)
    drop = target - g
    square = z * z
    quartic = 0.25 * b * b * square * square / (5.0 + k) - b * drop * square / (3.0 + k) + drop * drop / (1.0 + k)
    linear = 0.5 * b * _power_times_sine(n + 2.0, phi, z) - drop * _power_times_sine(n, phi, z)
    double = 2.0 * (z - phi)
    quadratic = 0.25 * square - 0.25 * z * math.sin(double) - 0.125 * math.cos(double)
    return 0.5 * square - z ** (1.0 + k) * quartic - 2.0 * chi * linear - chi * chi * quadratic


@kernel()
def loss_of_jump(wave: ShortWave, target: float, start: float, end: float) -> float:
    """Return e for a jump at the depth `target` from z = start to z = end, either of which may be 0."""
    low, high = min(start, end), max(start, end)
    total = 0.0
    if low < _SMALL:
        edge = min(_SMALL, high)
        total += _near_zero(wave, target, low, edge)
        low = edge
    if high - low > _MANY:
        if low < _LARGE:
            total += _by_panels(wave, target, low, _LARGE)
            low = _LARGE
        total += _antiderivative(wave, target, high) - _antiderivative(wave, target, low)
    elif high > low:
        total += _by_panels(wave, target, low, high)
    return total if end > start else -total
