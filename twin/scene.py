"""One scene solved: the expected values of a study's outputs, and how far it is from where they jump."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from flint import arb

from gradhesion.twin import energy
from gradhesion.twin.bounds import waves_within
from gradhesion.twin.curve import Curve
from gradhesion.twin.path import Branch, Jump, Path, cycle, pull_off
from gradhesion.twin.roots import extrema
from gradhesion.twin.shape import PLAIN, Shape
from gradhesion.twin.turning import TURNS, turning

ZERO: Final = arb(0)
PARAMETERS = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")


@dataclass(frozen=True)
class PullOff:
    """The part of a `Solution` that needs no cycle."""

    pull_off_force: arb
    pull_off_radius: arb
    margin_radius: float
    radius_condition: float
    force_condition: float


@dataclass(frozen=True)
class Solution:
    """Outputs in the units of a study; `None` for the unbounded delta_max of an unbounded punch.

    `margin_jumps` is the least relative distance at which a number of jumps changes, `margin_radius` that at which the
    lowest P moves to another place; force and energy are continuous there. `energy_condition` is the sum of |e_j| over
    the energy, `radius_condition` the relative change of the radius for a relative change of the terms of dP/da,
    `force_condition` the sum of the sizes of the terms of P over P. `delta_max_size` and `delta_jump_out_size` are the
    sizes of the terms of the two depths; `folded_waves` is how many waves, the shortest, the folds within the rim
    span.
    """

    pull_off_force: arb
    pull_off_radius: arb
    dissipated_energy: arb
    loading_jumps: int
    unloading_jumps: int
    delta_max: arb | None
    delta_jump_out: arb
    loading_energy: arb
    unloading_energy: arb
    margin_jumps: float
    margin_radius: float
    energy_condition: float
    radius_condition: float
    force_condition: float
    delta_max_size: float
    delta_jump_out_size: float
    folded_waves: float
    turning_radius: arb | None = None
    """None for an unbounded punch that does not turn before."""
    turning_condition: float = 0.0
    """The relative change of the turning radius for one of the terms of the depth or load at which it turns."""
    front_energy: arb = field(default_factory=lambda: ZERO)
    pinned_depth: arb = field(default_factory=lambda: ZERO)
    snap_in_force: arb = field(default_factory=lambda: ZERO)
    """NaN where there is no jump into contact."""
    snap_in_size: float = 0.0
    """The size of its terms."""
    turning_slope: float = 0.0
    """The relative change of the force for one of the turning radius; 0 where the pull-off is not there."""


def waves_to_follow(parameters: Mapping[str, float], shape: Shape = PLAIN, *, cycle: bool) -> float:
    """Estimate the waves that `solve` goes through (`solve_pull_off` if not `cycle`): the time is 15 ms for each."""
    return waves_within(Curve(parameters, shape), cycle=cycle)


def solve(parameters: Mapping[str, float], shape: Shape = PLAIN) -> Solution:
    """Solve one scene; under a dead load its energy is without the jump-out, which has no bound.

    Its edge closes at `closing_ratio` dgamma, dgamma if that is not given, and opens at dgamma: loading goes along one
    curve, unloading along another one.
    """
    ratio = parameters.get("closing_ratio", 1.0)
    curve, closing = Curve(parameters, shape), Curve(parameters, shape, ratio)
    turn = next((turning(closing, name, parameters[name]) for name in TURNS if name in parameters), None)
    if turn is not None and turn.place is not None and not turn.place > 0:
        return _without_contact(parameters["indentation_max_over_R"], turn.margin)
    if turn is not None and turn.place is not None:
        curve.rim = closing.rim = turn.place.mid()
    held = _pull_off(curve)
    path, made = cycle(curve)
    up, made_up = (path, made) if ratio == 1.0 else cycle(closing)
    turned = turn is not None and turn.place is not None
    turns_at = None if curve.rim is None else curve.radius(curve.rim)
    leaving = [jump for jump in path.unloading if jump.end > 0 or shape.control != "load"]
    gained = [energy.dissipated(closing, jump) for jump in up.loading]
    drops = [energy.dissipated(curve, jump) for jump in leaving]
    front = ZERO if ratio == 1.0 else (1 - closing.work) * energy.area(curve)
    terms = [*gained, *drops, front]
    lost = sum(terms, arb(0))
    margins = [_margin_jumps(closing, up, made_up, turned=turned)]
    if ratio < 1.0:
        margins.append(_margin_jumps(curve, path, made, turned=True))
    return Solution(
        pull_off_force=held.pull_off_force,
        pull_off_radius=held.pull_off_radius,
        dissipated_energy=lost,
        loading_jumps=len(up.loading),
        unloading_jumps=len(path.unloading),
        delta_max=None if curve.rim is None else closing.depth_at_full_contact(up.largest),
        delta_jump_out=curve.delta(path.last),
        loading_energy=sum(gained, arb(0)),
        unloading_energy=sum(drops, arb(0)),
        margin_jumps=min(turn.margin if turn else 1.0, *margins),
        margin_radius=held.margin_radius,
        energy_condition=_condition(terms, lost),
        radius_condition=held.radius_condition,
        force_condition=held.force_condition,
        delta_max_size=closing.full_depth_size(up.deepest) if curve.rim is not None else math.inf,
        delta_jump_out_size=curve.depth_size(path.last),
        folded_waves=curve.shortest * _folded_waves(made),
        turning_radius=turns_at,
        turning_condition=turn.condition if turn else 0.0,
        turning_slope=_turning_slope(curve) if turned and held.pull_off_radius == turns_at else 0.0,
        front_energy=front,
        pinned_depth=_pinned(closing),
        snap_in_force=_snap_in_force(closing, up, shape),
        snap_in_size=float(closing.force_size(up.loading[0].end)) if up.loading else 0.0,
    )


def _without_contact(depth: float, margin: float) -> Solution:
    """Return the cycle that turns before it makes contact."""
    nothing, nowhere = arb(0), arb("nan")
    return Solution(
        pull_off_force=nothing,
        pull_off_radius=nowhere,
        dissipated_energy=nothing,
        loading_jumps=0,
        unloading_jumps=0,
        delta_max=arb(depth),
        delta_jump_out=nowhere,
        loading_energy=nothing,
        unloading_energy=nothing,
        margin_jumps=margin,
        margin_radius=1.0,
        energy_condition=0.0,
        radius_condition=0.0,
        force_condition=0.0,
        delta_max_size=0.0,
        delta_jump_out_size=0.0,
        folded_waves=0.0,
        turning_radius=nothing,
        snap_in_force=nowhere,
    )


def _pinned(closing: Curve) -> arb:
    """Return how far the curve of closing is above that of dgamma where the edge turns."""
    if closing.work == 1:
        return ZERO
    return arb("inf") if closing.rim is None else closing.pinned(closing.rim)


def _condition(terms: list[arb], total: arb) -> float:
    """Return the sum of the sizes of some terms over that of their sum."""
    return float(sum((abs(term) for term in terms), arb(0)) / abs(total)) if total.is_finite() and total != 0 else 1.0


def _snap_in_force(closing: Curve, path: Path, shape: Shape) -> arb:
    """Return the pull just after the jump into contact, in 1.5 pi; a dead load holds none."""
    first = path.loading[0] if path.loading else None
    if first is None or first.start != 0 or not closing.work > 0:
        return arb("nan")
    pull = -closing.force_at_zero(first.end) / (3 * arb.pi() / 2)
    if shape.control == "machine" and pull < 0:  # it presses
        return arb("nan")
    return ZERO if shape.control == "load" else pull


def _turning_slope(curve: Curve) -> float:
    """Return the relative change of the load for one of the radius, at the place where it turns."""
    z = curve.rim
    assert z is not None
    step = z * arb(2) ** -60
    rate = (curve.force(z + step) - curve.force(z - step)) / (2 * step)
    return float(abs(z * rate / curve.force(z)))


def solve_pull_off(parameters: Mapping[str, float], shape: Shape = PLAIN) -> PullOff:
    """Solve the pull-off of one scene, for which its cycle need not be followed."""
    return _pull_off(Curve(parameters, shape))


def _pull_off(curve: Curve) -> PullOff:
    force, at, forces = pull_off(curve)
    return PullOff(
        pull_off_force=force / (3 * arb.pi() / 2),
        pull_off_radius=curve.radius(at),
        margin_radius=_margin_radius(force, forces),
        radius_condition=_radius_condition(curve, at),
        force_condition=float(curve.force_size(at) / abs(force)),
    )


def _folded_waves(made: list[Branch]) -> float:
    """Give the distance between the first fold and the last one, or the rim, in waves."""
    folds = [z for branch in made for z in (branch.lo, branch.hi) if z is not None]
    return float(folds[-1] - folds[0]) / (2 * math.pi) if len(folds) > 1 else 0.0


def _margin_radius(force: arb, forces: list[arb]) -> float:
    others = sorted(float((force - f) / force) for f in forces)
    return min(1.0, others[1]) if len(others) > 1 else 1.0


def _radius_condition(curve: Curve, z: arb) -> float:
    if curve.rim is not None and z == curve.rim:
        return 1.0
    return float(curve.tilt_size(z, curve.trough) / (z * abs(curve.tilt(z, curve.trough)[1])))


class _Fold:
    """The coordinate of a fold, to be compared with the levels of jumps."""

    def __init__(self, curve: Curve, depth: arb, z: arb) -> None:
        self.z, self.depth = z, depth
        self.rough, self.size = float(depth), curve.coordinate_size(z)

    def margin(self, jump: Jump) -> float:
        """Give the distance of a level from the fold over the sizes of both; precise where it is small."""
        level = float(jump.level)
        scale = abs(level) + self.size
        rough = abs(level - self.rough) / scale
        return rough if rough > 1e-9 else float(abs(jump.level - self.depth)) / scale


def _margin_jumps(curve: Curve, path: Path, made: list[Branch], *, turned: bool) -> float:
    """Least of: fold depths against the levels of jumps; the tilt at its extrema and at the rim (folds about to be)."""
    margins = [1.0]
    tops = [(b.top, b.hi) for b in made if b.top is not None and b.hi is not None and b.hi is not curve.rim]
    outer = [_Fold(curve, top, z) for top, z in tops]
    inner = [_Fold(curve, b.bottom, b.lo) for b in made if b.lo > 0]
    margins += [min((fold.margin(jump) for fold in outer if fold.z > jump.start), default=1.0) for jump in path.loading]
    margins += [
        min((fold.margin(jump) for fold in inner if fold.z < jump.start), default=1.0) for jump in path.unloading
    ]
    start = curve.coordinate(arb(0))
    if inner and start != 0:  # k = 1: a fold at next to no contact, which a jump leaves or a branch ends in
        margins.append(float(abs(inner[0].depth - start)) / (abs(inner[0].rough) + inner[0].size))
    points = extrema(curve, curve.fold, curve.rim)
    if curve.rim is not None and not turned:
        points.append(curve.rim)
    for z in points:
        tilt = curve.tilt(z, curve.fold)[0]
        margins.append(float(abs(tilt) / (abs(tilt) + curve.tilt_size(z, curve.fold))))
    return min(margins)
