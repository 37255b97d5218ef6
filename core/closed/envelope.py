"""The envelopes of a short wave: closed forms for lambda << a.

With z = a/l and the length l of closed/smooth.py, depths in s l^c, loads in K l^(1+k) s l^c, c = (1-k)/2, X =
z^((3+k)/2) and chi = r/s = pi^c G((1+k)/2) A lambda^((1+k)/2)/s, the waves lie between (5.26), (5.27) of Jin, Guo & Wan
(2013)

    depth = z^2/2 - (1 -+ chi) z^c,   load = X [X/(3+k) - (1 -+ chi)]

Loading follows the upper signs, unloading the lower ones: each is a smooth punch of another work of adhesion. With
rho = (depth_H - depth)/z^c, depth_H = z^2/2, the path is

    loading    depth 0 and rho = z^((3+k)/2)/2 up to z_2 = [2 (1-chi)]^(2/(3+k)), then rho = 1 - chi; z_2 = 0 if chi > 1
    unloading  rho = 1 + chi down to z_4 = [c (1+chi)]^(2/(3+k)), then the last depth; z_4 is at most the rim

and the energy int z [rho_unloading^2 - rho_loading^2] dz, a sum of powers, is that of (5.36)-(5.43) for any rim; the
fits of (5.43) are not needed. It grows by 2 chi z_rim^2 without bound: the envelopes do not include the radius at which
the folds end and hysteresis saturates, so that the energy of an unbounded punch is inf.

The printed formulae leave out the mean height lambda A of the wave. It is added to delta_max and delta_jump_out. The
energy leaves it out, as printed: its jump-in is at the mean surface, the depth lambda A, and not at the depth 0 where
contact begins, which makes an error of the order (lambda/a)^((1-k)/2) beside the lambda/a of all else. The force has an
error of the order (lambda/a)^2, one wave not being at its lowest point.
"""

import math

from gradhesion.core.closed.smooth import FORCE_SCALE, smooth_length
from gradhesion.core.compiler.jit import kernel
from gradhesion.core.numbers.circle import TWO_PI
from gradhesion.core.problem.results import OUTERMOST, Results, put, put_all
from gradhesion.core.types import Floats, Table


@kernel()
def envelope_force(k: float, chi: float, z_rim: float) -> tuple[float, float]:
    """Return the pull-off force over 1.5 pi R dgamma and the z where it is met: (3+k)/3 (1+chi)^2 within the rim."""
    power = 0.5 * (3.0 + k)
    z = (power * (1.0 + chi)) ** (1.0 / power)
    if z_rim >= z:
        return (3.0 + k) / 3.0 * (1.0 + chi) ** 2, z
    abscissa = z_rim**power
    return FORCE_SCALE * abscissa * (1.0 + chi - abscissa / (3.0 + k)), z_rim


@kernel()
def envelope_depth(k: float, pull: float, z: float) -> float:
    """Return the depth on the envelope of pull = 1 - chi or 1 + chi."""
    return 0.5 * z * z - pull * z ** (0.5 * (1.0 - k)) if z < math.inf else math.inf


@kernel()
def _loss_of_jump_in(k: float, chi: float, z: float) -> float:
    """Return int_0^z y [(1-chi)^2 - (y^((3+k)/2)/2)^2] dy."""
    return 0.5 * ((1.0 - chi) * z) ** 2 - 0.25 * z ** (5.0 + k) / (5.0 + k)


@kernel()
def _loss_of_jump_out(k: float, chi: float, z: float, depth: float) -> float:
    """Return int_0^z y [((y^2/2 - depth)/y^c)^2 - (1+chi)^2] dy."""
    square = z * z
    powers = z ** (1.0 + k) * (0.25 * square * square / (5.0 + k) - depth * square / (3.0 + k) + depth**2 / (1.0 + k))
    return powers - 0.5 * ((1.0 + chi) * z) ** 2


@kernel()
def envelope_cycle(k: float, chi: float, z_rim: float) -> tuple[float, float, float, float, float, float]:
    """Return the losses of loading and unloading, their jumps, the depth of loading at the rim and the last depth.

    The square of the wave, chi^2/2 in the mean, is a part of both and cancels in their sum.
    """
    power = 2.0 / (3.0 + k)
    z_in = min(z_rim, (2.0 * max(0.0, 1.0 - chi)) ** power)
    z_out = min(z_rim, (0.5 * (1.0 - k) * (1.0 + chi)) ** power)  # 0 at k = 1: the contact shrinks to a point
    last_depth = envelope_depth(k, 1.0 + chi, z_out)
    loaded, unloaded = _loss_of_jump_in(k, chi, z_in), _loss_of_jump_out(k, chi, z_out, last_depth)
    if chi > 0.0 and z_rim < math.inf:
        loaded += (1.0 - 0.75 * chi) * chi * z_rim * z_rim
        unloaded += (1.0 + 0.75 * chi) * chi * z_rim * z_rim
    elif chi > 0.0:
        loaded = unloaded = math.inf
    jumps_in, jumps_out = 1.0 if z_in > 0.0 else 0.0, 1.0 if z_out > 0.0 else 0.0
    return loaded, unloaded, jumps_in, jumps_out, envelope_depth(k, 1.0 - chi, z_rim), last_depth


@kernel()
def solve_rim(
    k: float, stretch: float, chi: float, mean_height: float, rim: float
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Return the results of one rim, in the order of problem/results.py; chi = 0 is the smooth punch."""
    length = smooth_length(k, stretch)
    z_rim = rim / length
    force, z = envelope_force(k, chi, z_rim)
    loaded, unloaded, jumps_in, jumps_out, rim_depth, last_depth = envelope_cycle(k, chi, z_rim)
    energy_scale = TWO_PI * length * length
    depth_scale = 2.0 * length * length / (1.0 + k)
    return (
        force,
        z * length if z < z_rim else rim,
        energy_scale * (loaded + unloaded),
        jumps_in,
        jumps_out,
        max(0.0, mean_height + depth_scale * rim_depth),
        mean_height + depth_scale * last_depth,
        energy_scale * loaded,
        energy_scale * unloaded,
    )


@kernel(inline=True)
def solve_curve(
    table: Table, stretch: float, wavelength: float, amplitude: float, rims: Floats, results: Results
) -> None:
    """Solve one curve (s, lambda/R, A) for all its rims a_max/R, of shape (rims,)."""
    mean_height = amplitude * wavelength
    # A lambda/(s l^c) with l = lambda/2 pi is the gain of curve/cosine.py
    gain = mean_height / (stretch * (wavelength / TWO_PI) ** (0.5 * (1.0 - table.k)))
    for rim in range(rims.size):
        values = solve_rim(table.k, stretch, table.amplitude * gain, mean_height, rims[rim])
        put_all(results, rim, values)
        chi = table.amplitude * gain
        z_in = 2.0 ** (2.0 / (3.0 + table.k)) if chi == 0.0 else math.inf  # with waves hysteresis has no end
        put(results, OUTERMOST, rim, z_in * smooth_length(table.k, stretch))
