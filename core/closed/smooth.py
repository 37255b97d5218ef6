"""The smooth punch (A = 0): everything in closed form.

With z = a/l and the length l chosen so that the bend b of curve/cosine.py is 1, and with X = z^((3+k)/2),

    depth = z^2/2 - z^((1-k)/2),   load = X [X/(3+k) - 1]

so the first fold, the radius of the jump-in and that of the pull-off are constants of k: X = (1-k)/2, 2, (3+k)/2. The
pull-off force is (3+k)/3 in units of 1.5 pi R dgamma, for any stiffness. (2.2)-(4.8) of Jin, Guo & Wan (2013).

Over R instead of l, with the stretch s,

    X = 2 a^((3+k)/2)/((1+k) s),   depth = a^2/(1+k) - s a^((1-k)/2)

and all results follow from k, the rim, X there, and the a_2 and a_4 of docs/theory.md, section 11, in a power each.
"""

import math
from typing import Final

from gradhesion.core.closed.power import power
from gradhesion.core.compiler.jit import kernel

ABSCISSA_OF_JUMP_IN: Final = 2.0
"""X where the depth is zero."""
FORCE_SCALE: Final = 4.0 / 3.0
"""Reduced load at b = 1 to units of 1.5 pi R dgamma, for every k."""


@kernel()
def smooth_length(k: float, stretch: float) -> float:
    """Return the length l over R at which b = 1, from s R^(-(1+k)/2)."""
    return (0.5 * (1.0 + k) * stretch) ** (2.0 / (3.0 + k))


@kernel()
def smooth_depth(k: float, z: float) -> float:
    """Return the reduced depth."""
    return 0.5 * z * z - z ** (0.5 * (1.0 - k))


@kernel()
def smooth_energy_from_zero(k: float, z: float, depth: float) -> float:
    """Return the energy of a jump from zero contact to z (curve/cosine_energy.py with g = 0)."""
    front = z ** (1.0 + k)
    square = z * z
    quadratic = 0.25 * front * square * square / (5.0 + k)
    return 0.5 * square - quadratic + depth * front * (square / (3.0 + k) - depth / (1.0 + k))


@kernel()
def smooth_places(k: float) -> tuple[float, float, float, float]:
    """Return the z of the pull-off, of the jump-in and of the jump-out, and the depth of that."""
    exponent = 2.0 / (3.0 + k)
    z_pull, z_in = (1.0 / exponent) ** exponent, 2.0**exponent
    if k == 1.0:  # the contact shrinks to a point at the depth -1
        return z_pull, z_in, 0.0, -1.0
    z_out = (0.5 * (1.0 - k)) ** exponent
    return z_pull, z_in, z_out, smooth_depth(k, z_out)


@kernel()
def abscissa_of(k: float, stretch: float, raised: float) -> float:
    """Return X of a radius a over R from a^((3+k)/2), and from s R^(-(1+k)/2)."""
    return 2.0 * raised / ((1.0 + k) * stretch)


@kernel()
def raised_of(k: float, stretch: float, abscissa: float) -> float:
    """Return a^((3+k)/2) of the radius a over R that has an X."""
    return 0.5 * abscissa * (1.0 + k) * stretch


@kernel()
def smooth_abscissa(k: float, stretch: float, radius: float) -> float:
    """Return X of a radius over R."""
    return abscissa_of(k, stretch, power(radius, 0.5 * (3.0 + k)))


@kernel()
def smooth_square(k: float, stretch: float, abscissa: float) -> float:
    """Return the square of the radius over R that has an X."""
    return power(raised_of(k, stretch, abscissa), 4.0 / (3.0 + k))


@kernel()
def abscissa_of_pull_off(k: float) -> float:
    """Return X where the load is lowest."""
    return 0.5 * (3.0 + k)


@kernel()
def abscissa_of_jump_out(k: float) -> float:
    """Return X where the depth is lowest."""
    return 0.5 * (1.0 - k)


@kernel()
def smooth_force(k: float, abscissa: float) -> float:
    """Return the pull-off force over 1.5 pi R dgamma, from X at the rim."""
    if abscissa >= abscissa_of_pull_off(k):
        return (3.0 + k) / 3.0
    return FORCE_SCALE * abscissa * (1.0 - abscissa / (3.0 + k))


@kernel()
def is_pulled_off_at_rim(k: float, abscissa: float) -> bool:
    """Return whether the pull-off is at the rim, from X there."""
    return abscissa <= abscissa_of_pull_off(k)


@kernel()
def jumps_in_to_rim(abscissa: float) -> bool:
    """Return whether the jump-in meets no stable contact within the rim, from X there."""
    return abscissa < ABSCISSA_OF_JUMP_IN


@kernel()
def smooth_jumps_out(k: float) -> float:
    """Return the number of jumps of unloading: at k = 1 the contact shrinks to a point."""
    return 1.0 if k < 1.0 else 0.0


@kernel()
def smooth_loading(k: float, abscissa: float, rim: float, jump_in: float) -> float:
    """Return the energy of the jump-in over R^2 dgamma, from X at the rim and a_2^2: 2 pi a^2 [1/2 - X^2/(4 (5+k))]."""
    if abscissa >= ABSCISSA_OF_JUMP_IN:
        return 2.0 * math.pi * jump_in * (0.5 - 1.0 / (5.0 + k))
    return 2.0 * math.pi * rim * rim * (0.5 - 0.25 * abscissa * abscissa / (5.0 + k))


@kernel()
def smooth_unloading(k: float, abscissa: float, rim: float, jump_out: float) -> float:
    """Return the energy of the jump-out over R^2 dgamma, from X at the rim and a_4^2.

    It is 2 pi a^2/(1+k) {(1-k)/2 - 2 X/(3+k) [1 - X/(5+k)]}, in which no term is close to another.
    """
    last = abscissa_of_jump_out(k)
    whole = abscissa >= last
    square = jump_out if whole else rim * rim
    place = last if whole else abscissa
    return 2.0 * math.pi * square / (1.0 + k) * (last - 2.0 * place / (3.0 + k) * (1.0 - place / (5.0 + k)))


@kernel()
def smooth_deepest(k: float, abscissa: float, rim: float) -> float:
    """Return the depth over R at which contact is full, 0 at least, from X at the rim: a^2 (1 - 2/X)/(1+k)."""
    return rim * rim * (1.0 - 2.0 / abscissa) / (1.0 + k) if abscissa > ABSCISSA_OF_JUMP_IN else 0.0


@kernel()
def smooth_last(k: float, stretch: float, square: float, root: float) -> float:
    """Return the depth over R at which contact ends, from a^2 and a^((1-k)/2) of the radius a there and s."""
    return square / (1.0 + k) - stretch * root
