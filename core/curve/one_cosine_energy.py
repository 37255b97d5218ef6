"""Energies of jumps of one cosine on a paraboloid under any control: those at a fixed depth, and the machine's part.

At a fixed radius the load is linear in the depth, so that the energy of punch and machine is a parabola in the depth,
lowest where the coordinate has its value. A jump from z1 to z2 at a fixed coordinate therefore loses the energy of a
jump at its initial depth, and the work as the depth then follows the load: with the load P(z; d) at the depth d,

    e = e_depth(z1 -> z2) + beta F^2/((1+k) (alpha + beta z2^(1+k))),    F = P(z1; d) - P(z2; d)

in the units of curve/general.py; and from zero contact, where the machine is slack, at the depth and the load P that
belong to the coordinate at z,

    e = e_depth(0 -> z) - beta P^2/((1+k) alpha)

A soft machine has so small an alpha that P must be exact to its root: there it follows from the coordinate, which is
nearly the load.
"""

from typing import Final

from gradhesion.core.compiler.jit import NO, kernel
from gradhesion.core.curve.arches import one_cosine
from gradhesion.core.curve.cosine import wave
from gradhesion.core.curve.cosine_energy import energy_from_zero
from gradhesion.core.curve.cosine_jump import ENOUGH, energy_between
from gradhesion.core.curve.general import Basis, Series

_SOFT: Final = 1e-9
"""The depth's share of the coordinate over that of the load below which the load comes from the coordinate."""


@kernel(contract=True)
def jump_of_one_cosine(basis: Basis, curve: Series, start: float, end: float) -> tuple[bool, float]:
    """Return whether the formula applies, and e of a jump from x = start > 0 on the curve to x = end > 0."""
    table, _, series = basis
    _, _, _, alpha, beta = curve
    k = table.k
    own = one_cosine(series, curve)
    energy, size = energy_between(table, own, start, end)
    if beta > 0.0:
        b, g, _ = own
        z1, power1, s0, s1, _, _, _ = wave(table, 0.0, start)
        z2, power2, _, other, _, _, _ = wave(table, 0.0, end)
        front1, front2 = 1.0 / (power1 * power1), 1.0 / (power2 * power2)
        load_over_front = b * z1 * z1 / (3.0 + k) + g * z1 * (s0 - s1) - z1 * power1
        fall = 0.5 * b * (1.0 + k) / (3.0 + k) * (z2 - z1) * (z2 + z1) + g * (z2 * other - z1 * s1)
        excess = (front1 - front2) * load_over_front + front2 * fall
        given = beta * excess * excess / ((1.0 + k) * (alpha + beta * front2))
        energy, size = energy + given, size + given
    return abs(energy) >= ENOUGH * size, energy


@kernel(contract=True)
def jump_of_one_cosine_from_zero(basis: Basis, curve: Series, x: float, level: float) -> tuple[bool, float]:
    """Return whether the formula applies, and e of a jump at Y = level from zero contact to x > 0."""
    table, _, series = basis
    _, _, _, alpha, beta = curve
    k = table.k
    own = one_cosine(series, curve)
    b, g, _ = own
    z, power, s0, s1, _, _, _ = wave(table, 0.0, x)
    front = 1.0 / (power * power)
    depth = 0.5 * b * z * z + g * z * s0 - z * power
    load = front * (b * z * z / (3.0 + k) + g * z * (s0 - s1) - z * power)
    shift = (level - (alpha * depth + beta * load)) / (alpha + beta * front)
    energy, kept = energy_from_zero(table, own, x, depth + shift), 0.0
    if alpha > 0.0:
        load += front * shift
        if alpha < _SOFT * beta * front:
            load = (level - alpha * (depth + shift)) / beta
        kept = beta * load * load / ((1.0 + k) * alpha)
    elif level != 0.0:
        return NO, energy
    return abs(energy - kept) >= ENOUGH * (0.5 * z * z + kept), energy - kept
