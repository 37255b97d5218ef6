"""One scene solved: the expected values of a study's outputs, and how far it is from where they jump."""

from collections.abc import Mapping
from dataclasses import dataclass

from flint import arb

from . import energy
from .curve import Curve
from .path import Branch, Path, cycle, pull_off
from .roots import extrema

PARAMETERS = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")


@dataclass(frozen=True)
class Solution:
    """Outputs in the units of a study; `None` for the unbounded delta_max of an unbounded punch.

    `margin_jumps` is the least relative distance at which a number of jumps changes, `margin_radius` that at which the
    lowest P moves to another place; force and energy are continuous there. `energy_condition` is the sum of |e_j| over
    the energy, `radius_condition` the relative change of the radius for a relative change of the terms of dP/da.
    """

    pull_off_force: arb
    pull_off_radius: arb
    dissipated_energy: arb
    loading_jumps: int
    unloading_jumps: int
    delta_max: arb | None
    delta_jump_out: arb
    margin_jumps: float
    margin_radius: float
    energy_condition: float
    radius_condition: float


def solve(parameters: Mapping[str, float]) -> Solution:
    """Solve one scene."""
    curve = Curve(parameters)
    path, made = cycle(curve)
    force, at, forces = pull_off(curve)
    drops = [energy.dissipated(curve, jump) for jump in path.loading + path.unloading]
    lost = sum(drops, arb(0))
    return Solution(
        pull_off_force=force / (3 * arb.pi() / 2),
        pull_off_radius=curve.radius(at),
        dissipated_energy=lost,
        loading_jumps=len(path.loading),
        unloading_jumps=len(path.unloading),
        delta_max=None if curve.rim is None else path.delta_max,
        delta_jump_out=path.delta_jump_out,
        margin_jumps=_margin_jumps(curve, path, made),
        margin_radius=_margin_radius(force, forces),
        energy_condition=float(sum((abs(drop) for drop in drops), arb(0)) / abs(lost)) if drops else 1.0,
        radius_condition=_radius_condition(curve, at),
    )


def _margin_radius(force: arb, forces: list[arb]) -> float:
    others = sorted(float((force - f) / force) for f in forces)
    return min(1.0, others[1]) if len(others) > 1 else 1.0


def _radius_condition(curve: Curve, z: arb) -> float:
    if curve.rim is not None and z == curve.rim:
        return 1.0
    terms = 2 / (1 + curve.k) + curve.trough * z ** (-(3 + curve.k) / 2)
    return float(terms / (z * abs(curve.tilt(z, curve.trough)[1])))


def _margin_jumps(curve: Curve, path: Path, made: list[Branch]) -> float:
    """Least of: fold depths against the levels of jumps; the tilt at its extrema and at the rim (folds about to be)."""
    margins = [1.0]

    def compare(level: arb, value: arb, z: arb) -> None:
        a = curve.radius(z)
        scale = abs(level) + a * a / (1 + curve.k) + curve.gap(z)
        margins.append(float(abs(level - value) / scale))

    tops = [(b.top, b.hi) for b in made if b.top is not None and b.hi is not None and b.hi is not curve.rim]
    for jump in path.loading:
        for top, hi in tops:
            if hi > jump.start:
                compare(jump.level, top, hi)
    for jump in path.unloading:
        for branch in made:
            if 0 < branch.lo < jump.start:
                compare(jump.level, branch.bottom, branch.lo)
    points = extrema(curve, curve.fold, curve.rim)
    if curve.rim is not None:
        points.append(curve.rim)
    for z in points:
        tilt = curve.tilt(z, curve.fold)[0]
        p = (3 + curve.k) / 2
        size = 2 / (1 + curve.k) + (curve.fold * z**-p if curve.fold > 0 else 0)
        margins.append(float(abs(tilt) / (abs(tilt) + size)))
    return min(margins)
