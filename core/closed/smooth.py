"""The smooth paraboloid (A = 0) under displacement control: everything in closed form.

With z = a/l and the length l for which the stretch s is 2 l^((3+k)/2)/(1+k), and with X = z^((3+k)/2),

    depth = z^2/2 - z^((1-k)/2) in units of 2 l^2/(1+k),   load = X [X/(3+k) - 1] in 2 pi R dgamma

so the first fold, the radius of the jump-in and that of the pull-off are constants of k: X = (1-k)/2, 2, (3+k)/2. The
pull-off force is (3+k)/3 in units of 1.5 pi R dgamma, for any stiffness. (2.2)-(4.8) of Jin, Guo & Wan (2013). Lengths
are in R, s is in R^((1+k)/2), energies in R^2 dgamma.
"""

import math
from typing import Final

from gradhesion.core.jit import kernel

ABSCISSA_OF_JUMP_IN: Final = 2.0
"""X where the depth is zero."""
FORCE_SCALE: Final = 4.0 / 3.0
"""2 pi R dgamma in units of 1.5 pi R dgamma."""


@kernel
def smooth_length(k: float, stretch: float) -> float:
    """Return the length l."""
    return (0.5 * (1.0 + k) * stretch) ** (2.0 / (3.0 + k))


@kernel
def smooth_depth(k: float, z: float) -> float:
    """Return the reduced depth."""
    return 0.5 * z * z - z ** (0.5 * (1.0 - k))


@kernel
def smooth_energy_from_zero(k: float, z: float, depth: float) -> float:
    """Return the energy of a jump from zero contact to z at a depth, in 2 pi l^2 dgamma."""
    front, square = z ** (1.0 + k), z * z
    quadratic = 0.25 * front * square * square / (5.0 + k)
    return 0.5 * square - quadratic + depth * front * (square / (3.0 + k) - depth / (1.0 + k))


@kernel
def smooth_places(k: float) -> tuple[float, float, float, float]:
    """Return the z of the pull-off, of the jump-in and of the jump-out, and the depth of that."""
    exponent = 2.0 / (3.0 + k)
    z_pull, z_in = (1.0 / exponent) ** exponent, 2.0**exponent
    if k == 1.0:  # the contact shrinks to a point at the depth -1
        return z_pull, z_in, 0.0, -1.0
    z_out = (0.5 * (1.0 - k)) ** exponent
    return z_pull, z_in, z_out, smooth_depth(k, z_out)


@kernel
def smooth_abscissa(k: float, stretch: float, radius: float) -> float:
    """Return X of a radius."""
    return 2.0 * radius ** (0.5 * (3.0 + k)) / ((1.0 + k) * stretch)


@kernel
def smooth_square(k: float, stretch: float, abscissa: float) -> float:
    """Return the square of the radius that has an X."""
    return (0.5 * abscissa * (1.0 + k) * stretch) ** (4.0 / (3.0 + k))


@kernel
def smooth_force(k: float, abscissa: float) -> float:
    """Return the pull-off force over 1.5 pi R dgamma, from X at the rim."""
    if abscissa >= 0.5 * (3.0 + k):
        return (3.0 + k) / 3.0
    return FORCE_SCALE * abscissa * (1.0 - abscissa / (3.0 + k))


@kernel
def smooth_loading(k: float, stretch: float, rim: float) -> float:
    """Return the energy of the jump-in: 2 pi a^2 [1/2 - X^2/(4 (5+k))] at the rim, or at X = 2 before it."""
    abscissa = smooth_abscissa(k, stretch, rim)
    if abscissa >= ABSCISSA_OF_JUMP_IN:
        return 2.0 * math.pi * smooth_square(k, stretch, ABSCISSA_OF_JUMP_IN) * (0.5 - 1.0 / (5.0 + k))
    return 2.0 * math.pi * rim * rim * (0.5 - 0.25 * abscissa * abscissa / (5.0 + k))


@kernel
def smooth_unloading(k: float, stretch: float, rim: float) -> float:
    """Return the energy of the jump-out, from X = (1-k)/2 or from the rim before it.

    It is 2 pi a^2/(1+k) {(1-k)/2 - 2 X/(3+k) [1 - X/(5+k)]}, in which no term is close to another.
    """
    last = 0.5 * (1.0 - k)
    place = min(last, smooth_abscissa(k, stretch, rim))
    square = smooth_square(k, stretch, last) if place == last else rim * rim
    return 2.0 * math.pi * square / (1.0 + k) * (last - 2.0 * place / (3.0 + k) * (1.0 - place / (5.0 + k)))


@kernel
def smooth_deepest(k: float, stretch: float, rim: float) -> float:
    """Return the depth at which contact is full, 0 at least: a^2 (1 - 2/X)/(1+k)."""
    abscissa = smooth_abscissa(k, stretch, rim)
    return rim * rim * (1.0 - 2.0 / abscissa) / (1.0 + k) if abscissa > ABSCISSA_OF_JUMP_IN else 0.0


@kernel
def smooth_last(k: float, stretch: float, rim: float) -> float:
    """Return the depth at which contact ends: that of the first fold, or of the rim before it."""
    radius = min(rim, math.sqrt(smooth_square(k, stretch, 0.5 * (1.0 - k))))
    return radius * radius / (1.0 + k) - stretch * radius ** (0.5 * (1.0 - k))
