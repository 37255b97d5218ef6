"""What a dataset promises of a scene: the value of every output from the twin, and how far from it a solver may be."""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Final

from flint import arb

from gradhesion.twin.envelope import amplitude, jump_in_radius, similarity_length, solve_envelope
from gradhesion.twin.scene import PullOff, Solution, solve, solve_pull_off, waves_to_follow
from gradhesion.twin.shape import PLAIN, Shape
from gradhesion.twin.turning import TURNS

FORCE: Final = 1e-12
"""Of the force, or of the sizes of its terms where that is more: on the rim of a small and very wavy punch."""
RADIUS: Final = 1e-9
"""Of the radius, which is where a function is stationary."""
RADIUS_OF_CONDITION: Final = 1e-13
"""Of the radius for each unit of its condition, where that is more."""
ENERGY: Final = 1e-12
"""Of the sizes of all jumps."""
DEPTH: Final = 1e-12
"""Of the sizes of the terms of a depth."""
NEAR: Final = 1e-10
"""Least margin of a number of jumps, and of the place of pull-off: nearer, those of a neighbouring double count."""
MOST_WAVES: Final = 1000.0
"""Waves, of two folds each, that the twin follows: 15 s, 300 MB. Of more, a digit less is promised for each decade."""
ROUNDED: Final = 1e-15
"""Of a value in SI units, besides the error of the same without a unit."""
CYCLE: Final = frozenset(
    (
        "dissipated_energy",
        "loading_energy",
        "unloading_energy",
        "loading_jumps",
        "unloading_jumps",
        "delta_max",
        "delta_jump_out",
        "turning_radius",
        "front_energy",
        "pinned_depth",
        "snap_in_force",
    )
)
"""Outputs for which the cycle must be followed."""
KNOWN: Final = CYCLE | {"pull_off_force", "pull_off_radius"}
"""Outputs that the twin solves."""
BY_STEPS: Final = frozenset(("loading_jumps", "unloading_jumps", "pull_off_radius"))
"""Outputs that are not continuous in the parameters."""
MADE: Final = 2e-14
"""Of a parameter that is made from others, times its condition where that is made of s - r."""
SOLVERS: Final = ("exact", "envelope")
"""Solvers of which the twin has an equal."""


@dataclass(frozen=True)
class Expected:
    """The value of an output, and the error that is stated for it; `near` where it is not promised, and why."""

    value: arb
    error: float
    near: str = ""

    def __str__(self) -> str:
        """Write the value with its 30 digits."""
        if not self.value.is_finite():
            return "inf" if self.value == arb("inf") else "none"
        return f"{float(self.value):.0f}" if self.value.is_integer() else str(self.value.str(30, radius=False))


def within_reach(parameters: Mapping[str, float], outputs: Collection[str], solver: str, shape: Shape = PLAIN) -> bool:
    """Tell whether a scene has no more waves than the twin follows."""
    if solver == "envelope":
        return True
    return waves_to_follow(parameters, shape, cycle=not CYCLE.isdisjoint(outputs)) <= MOST_WAVES


def expected(
    parameters: Mapping[str, float], outputs: Collection[str], solver: str, shape: Shape = PLAIN
) -> dict[str, Expected]:
    """Solve a scene for the outputs that the twin knows.

    Parameters
    ----------
    parameters
        The seven parameters of a scene; and lambda_over_L, chi and the like where one of the seven is made from them,
        to be checked as well; machine_stiffness under the control of a machine.
    outputs
        Names of outputs; those that are not in `KNOWN` are passed over.
    solver
        One of `SOLVERS`; "envelope" under displacement control alone.
    shape
        The profile and the control.

    Returns
    -------
    The values, in the units of a dataset, to 30 digits, with the errors that are stated for the solver, absolute.

    Raises
    ------
    ArithmeticError
        The scene lies where even 51 digits do not tell one fold from two, or too far out.

    Examples
    --------
    >>> scene = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, A=0.0, a_max_over_R=1.0)
    >>> force = expected(scene, ["pull_off_force"], "exact")["pull_off_force"]
    >>> float(force.value), force.error
    (1.0, 3e-12)
    """
    if solver == "envelope":
        found = _of_envelope(parameters, shape)
    elif CYCLE.isdisjoint(outputs) and not any(name in parameters for name in TURNS):
        found = _of_pull_off(solve_pull_off(parameters, shape))
    else:
        solution = solve(parameters, shape)
        found = _of_pull_off(solution) | _of_cycle(solution) | _of_turn(solution)
    made = _made(parameters)
    found |= made
    outputs = [*outputs, *made]
    if not all(_is_sure(one) for one in found.values()):
        raise ArithmeticError(f"too few digits are left: {dict(parameters)}")
    return {name: found[name] for name in outputs if name in found}


def _made(parameters: Mapping[str, float]) -> dict[str, Expected]:
    """Make the parameters that are not given but follow from reduced ones."""
    made: dict[str, tuple[arb, float]] = {}
    if "lambda_over_L" in parameters:
        made["lambda_over_R"] = parameters["lambda_over_L"] * similarity_length(parameters), 1.0
    if "chi" in parameters:
        made["A"] = amplitude(parameters, parameters["chi"]), 1.0
    if "a_max_over_L" in parameters:
        made["a_max_over_R"] = parameters["a_max_over_L"] * similarity_length(parameters), 1.0
    if "a_max_over_a2" in parameters:
        closing = parameters["modulus"] / parameters.get("closing_ratio", 1.0)  # of loading
        radius, condition = jump_in_radius({**parameters, "modulus": closing})
        made["a_max_over_R"] = parameters["a_max_over_a2"] * radius, condition
    if "R" in parameters:
        made |= {name: (value, 1.0) for name, value in _ratios(parameters).items()}
    return {
        name: Expected(value, _share(MADE * condition, value) if value.is_finite() else 0.0)
        for name, (value, condition) in made.items()
    }


def _ratios(parameters: Mapping[str, float]) -> dict[str, arb]:
    """Make the parameters that follow from quantities in SI units."""
    radius = arb(parameters["R"])
    stiffness = _reduced_modulus(parameters)
    ratios = {"modulus": stiffness * radius / arb(parameters["work_of_adhesion"])}
    lengths = {"c0": "c0_over_R", "wavelength": "lambda_over_R", "a_max": "a_max_over_R"}
    lengths["indentation_max"] = "indentation_max_over_R"
    for length, name in lengths.items():
        if length in parameters:
            ratios[name] = parameters[length] / radius
    if "work_of_adhesion_closing" in parameters:
        ratios["closing_ratio"] = parameters["work_of_adhesion_closing"] / arb(parameters["work_of_adhesion"])
    if "preload" in parameters:
        unit = 3 * arb.pi() / 2 * radius * arb(parameters["work_of_adhesion"])
        ratios["load_max"] = parameters["preload"] / unit
    if "spring_constant" in parameters:
        ratios["machine_stiffness"] = parameters["spring_constant"] / (stiffness * radius)
    if "amplitude" in parameters:
        ratios["A"] = parameters["amplitude"] / radius / parameters["lambda_over_R"]
    return ratios


def _reduced_modulus(parameters: Mapping[str, float]) -> arb:
    """Give E* = E/(1 - nu^2), whichever of the two is given."""
    if "E_star" in parameters:
        return arb(parameters["E_star"])
    return parameters["E"] / (1 - arb(parameters["nu"]) ** 2)


def in_si(found: Mapping[str, Expected], parameters: Mapping[str, float]) -> dict[str, Expected]:
    """Give expected values in SI units, by the name of the output with `_si` after it.

    >>> depth = {"delta_max": Expected(arb(0.25), 1e-14)}
    >>> float(in_si(depth, {"R": 2.0, "work_of_adhesion": 0.5})["delta_max_si"].value)
    0.5
    """
    radius, work = arb(parameters["R"]), arb(parameters["work_of_adhesion"])
    scales = {
        "pull_off_force": 1.5 * arb.pi() * radius * work,
        "pull_off_radius": radius,
        "dissipated_energy": radius * radius * work,
        "loading_energy": radius * radius * work,
        "unloading_energy": radius * radius * work,
        "delta_max": radius,
        "delta_jump_out": radius,
        "turning_radius": radius,
        "front_energy": radius * radius * work,
        "pinned_depth": radius,
        "snap_in_force": 1.5 * arb.pi() * radius * work,
    }
    return {
        f"{name}_si": Expected(
            one.value * scales[name],
            one.error * float(scales[name])
            + (_share(ROUNDED, one.value * scales[name]) if one.value.is_finite() else 0.0),
            one.near,
        )
        for name, one in found.items()
        if name in scales
    }


def _is_sure(one: Expected) -> bool:
    """Tell whether the ball of a value is much smaller than the error that it has to show."""
    return bool(one.value.rad() <= 1e-3 * one.error) if one.value.is_finite() else one.error == 0.0


def _of_pull_off(solution: PullOff | Solution) -> dict[str, Expected]:
    force = FORCE * max(1.0, solution.force_condition)
    radius = max(RADIUS, RADIUS_OF_CONDITION * solution.radius_condition)
    return {
        "pull_off_force": Expected(solution.pull_off_force, _share(force, solution.pull_off_force)),
        "pull_off_radius": Expected(
            solution.pull_off_radius,
            _share(radius, solution.pull_off_radius),
            "two troughs tie" if solution.margin_radius < NEAR else "",
        ),
    }


def _of_cycle(solution: Solution) -> dict[str, Expected]:
    near = "a fold is about to be passed" if solution.margin_jumps < NEAR else ""
    error = _share(ENERGY * solution.energy_condition, solution.dissipated_energy)  # of the sizes of all jumps
    moved = ROUNDED + DEPTH * solution.turning_condition  # of the radius at which the edge turns
    edge = _share(2 * moved, solution.front_energy)
    pinned = _share(DEPTH + 3 * moved, solution.pinned_depth)
    if solution.delta_max is not None:  # at a ratio next to 1 a small difference of two depths
        pinned += ROUNDED * solution.delta_max_size
    snaps = solution.snap_in_force.is_finite()
    return {
        "dissipated_energy": Expected(solution.dissipated_energy, error + edge),
        "loading_energy": Expected(solution.loading_energy, error),
        "unloading_energy": Expected(solution.unloading_energy, error + edge),
        "front_energy": Expected(solution.front_energy, edge, near),
        "pinned_depth": Expected(solution.pinned_depth, pinned, near),
        "snap_in_force": Expected(solution.snap_in_force, DEPTH * solution.snap_in_size if snaps else 0.0),
        "loading_jumps": Expected(arb(solution.loading_jumps), 0.0, near),
        "unloading_jumps": Expected(arb(solution.unloading_jumps), 0.0, near),
        "delta_max": _depth(solution.delta_max, solution.delta_max_size),
        "delta_jump_out": _depth(solution.delta_jump_out, solution.delta_jump_out_size),
    }


def _of_turn(solution: Solution) -> dict[str, Expected]:
    near = "a fold is about to be passed" if solution.margin_jumps < NEAR else ""
    if solution.turning_radius is None:
        return {"turning_radius": Expected(arb("inf"), 0.0)}
    share = ROUNDED + DEPTH * solution.turning_condition
    found = {"turning_radius": Expected(solution.turning_radius, _share(share, solution.turning_radius), near)}
    if solution.turning_slope > 0.0:  # the pull-off is where the cycle turns
        force = _share(FORCE + share * solution.turning_slope, solution.pull_off_force)
        found["pull_off_force"] = Expected(solution.pull_off_force, force, near)
        found["pull_off_radius"] = Expected(solution.pull_off_radius, _share(RADIUS + share, solution.pull_off_radius))
    return found


def _of_envelope(parameters: Mapping[str, float], shape: Shape) -> dict[str, Expected]:
    solution = solve_envelope(parameters, shape)
    near = "r = s, where jumps into contact end" if solution.margin_jumps < NEAR else ""
    return {
        "pull_off_force": Expected(solution.pull_off_force, _share(FORCE, solution.pull_off_force)),
        "pull_off_radius": Expected(solution.pull_off_radius, _share(RADIUS, solution.pull_off_radius)),
        "dissipated_energy": _energy(solution.dissipated_energy, solution.energy_size),
        "loading_energy": _energy(solution.loading_energy, solution.energy_size),
        "unloading_energy": _energy(solution.unloading_energy, solution.energy_size),
        "loading_jumps": Expected(arb(solution.loading_jumps), 0.0, near),
        "unloading_jumps": Expected(arb(solution.unloading_jumps), 0.0),
        "delta_max": _depth(solution.delta_max, solution.delta_max_size),
        "delta_jump_out": _depth(solution.delta_jump_out, solution.delta_jump_out_size),
    }


def _energy(value: arb | None, size: float) -> Expected:
    return Expected(arb("inf"), 0.0) if value is None else Expected(value, ENERGY * size)


def _depth(value: arb | None, size: float) -> Expected:
    return Expected(arb("inf"), 0.0) if value is None else Expected(value, DEPTH * size)


def _share(share: float, value: arb) -> float:
    if not value.is_finite():  # there is no value, and none may be
        return 0.0
    return share * abs(float(value)) if math.isfinite(share) else math.inf


def deviation(value: float, of: Expected) -> float:
    """Return how far a double is from what is expected of it, rounded once; inf if only one of them is a number."""
    if of.value == arb("inf"):
        return 0.0 if value == math.inf else math.inf
    if math.isfinite(value) and of.value.is_finite():
        return float(abs(arb(value) - of.value))
    return 0.0 if math.isnan(value) and str(of.value) == "nan" else math.inf
