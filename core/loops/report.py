"""The status that the solver gives the fitted cycle."""

import math
from typing import Any, Final

from gradhesion.core.closed.reduced import parameters_from
from gradhesion.core.loops.paths.model import Model
from gradhesion.core.problem.names import CLOSING, PARAMETERS, PATTERN
from gradhesion.core.problem.status import JUMP_IN_TO_RIM
from gradhesion.core.sweep import solve
from gradhesion.core.types import Floats

_ROUNDING: Final = 1e-12
"""Relative difference of radii that is rounding."""


def status_of(model: Model, vector: Floats, radius: float) -> int:
    """Return the status of the cycle of a vector that turns at a radius, over R."""
    if radius == 0.0:
        return 0
    made = {name: float(value) for name, value in parameters_from(model.given(model.values(vector))).items()}
    more = ("machine_stiffness", CLOSING, *(PATTERN if model.toughness is not None else ()))
    scene = {name: made[name] for name in (*PARAMETERS, *more) if name in made}
    scene["a_max_over_R"] = min(scene["a_max_over_R"], radius)
    if CLOSING in scene:  # where the works are equal, two fitted ones are in either order, by noise
        scene[CLOSING] = min(scene[CLOSING], 1.0)
    own: dict[str, Any] = {"profile": model.profile, "loading": model.loading, "toughness": model.toughness}
    wanted = ["pull_off_force", "loading_jumps"] if model.loading.control == "load" else [
        "dissipated_energy", "loading_jumps", "unloading_jumps"]  # fmt: skip
    found = int(solve(scene, wanted, threads=1, **own)["status"])
    turns_before = radius < (1.0 - _ROUNDING) * made.get("a_max_over_R", math.inf)
    return found & ~(JUMP_IN_TO_RIM if turns_before else 0)
