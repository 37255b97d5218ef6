"""The smooth punch (A = 0): everything in closed form.

With z = a/l and the length l chosen so that the bend b of curve/cosine.py is 1, and with X = z^((3+k)/2),

    depth = z^2/2 - z^((1-k)/2),   load = X [X/(3+k) - 1]

so the first fold, the radius of the jump-in and that of the pull-off are constants of k: z^((3+k)/2) = (1-k)/2, 2,
(3+k)/2. The pull-off force is (3+k)/3 in units of 1.5 pi R dgamma, whatever the stiffness. (2.2)-(4.8) of Jin, Guo &
Wan (2013).
"""

from typing import Final

from gradhesion.core._jit import kernel

FORCE_SCALE: Final = 4.0 / 3.0
"""Reduced load at b = 1 to units of 1.5 pi R dgamma, for every k."""


@kernel()
def smooth_length(k: float, stretch: float) -> float:
    """Return the length l over R at which b = 1, from s R^(-(1+k)/2)."""
    return (0.5 * (1.0 + k) * stretch) ** (2.0 / (3.0 + k))


@kernel()
def smooth_force(k: float, z_pull: float, z_rim: float) -> tuple[float, float]:
    """Return the pull-off force over 1.5 pi R dgamma and the z where it is met: z_pull, or the rim before that."""
    if z_rim >= z_pull:
        return (3.0 + k) / 3.0, z_pull
    abscissa = z_rim ** (0.5 * (3.0 + k))
    return FORCE_SCALE * abscissa * (1.0 - abscissa / (3.0 + k)), z_rim


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
def smooth_constants(k: float) -> tuple[float, float, float, float, float, float]:
    """Return the z of the pull-off, then z and loss of the jump-in, and z, depth and loss of the jump-out.

    They are those of a punch that reaches beyond all three places.
    """
    power = 2.0 / (3.0 + k)
    z_pull, z_in = (1.0 / power) ** power, 2.0**power
    loss_in = smooth_energy_from_zero(k, z_in, 0.0)
    if k == 1.0:  # the contact shrinks to a point at the depth -1
        return z_pull, z_in, loss_in, 0.0, -1.0, 0.0
    z_out = (0.5 * (1.0 - k)) ** power
    depth = smooth_depth(k, z_out)
    return z_pull, z_in, loss_in, z_out, depth, -smooth_energy_from_zero(k, z_out, depth)


@kernel()
def smooth_places(k: float) -> tuple[float, float, float, float, float, float]:
    """Return the first two of `smooth_constants`, where nothing else is read: a third of their powers."""
    power = 2.0 / (3.0 + k)
    return (1.0 / power) ** power, 2.0**power, 0.0, 0.0, 0.0, 0.0


@kernel()
def smooth_cycle(
    k: float, constants: tuple[float, float, float, float, float, float], z_rim: float
) -> tuple[float, float, float, float]:
    """Return what loading and unloading lose, the jumps of unloading, and the depth at which contact ends."""
    _, z_in, loss, z_out, last_depth, loss_out = constants
    if z_rim < z_in:
        loss = smooth_energy_from_zero(k, z_rim, 0.0)
    if z_rim < z_out:
        last_depth = smooth_depth(k, z_rim)
        loss_out = -smooth_energy_from_zero(k, z_rim, last_depth)
    return loss, loss_out, 1.0 if z_out > 0.0 else 0.0, last_depth
