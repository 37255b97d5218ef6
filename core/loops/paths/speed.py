"""Loops whose edge opens, or closes too, at a work that grows with its speed: paths by time.

Loading at rest is that of any loop (path.py). A moving edge is integrated by core/rate/, and derivatives of its path
are differences.
"""

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from gradhesion.core.closed.reduced import parameters_from
from gradhesion.core.draw.draw import draw_curves
from gradhesion.core.loops.paths.model import EXPONENT
from gradhesion.core.loops.paths.path import LoopModel, LoopPath
from gradhesion.core.problem.names import CLOSING, PARAMETERS, SPEED
from gradhesion.core.problem.toughness import EXPONENTS, Rate
from gradhesion.core.types import Floats


@dataclass(eq=False, kw_only=True)
class SpeedModel(LoopModel):
    """The path of a loop whose edge has a speed, as a function of the numbers that are searched.

    `rate` is the law; its exponent is that of the numbers that are searched, if it is one of them. All else is as of
    `LoopModel`.
    """

    rate: Rate
    by_differences: ClassVar[bool] = True

    def path(self, vector: Floats) -> LoopPath | None:
        """Draw the path; None where the scene has none. It turns where that of an edge at rest does."""
        rest, own = super().path(vector), self.values(vector)
        exponent = float(own.pop(EXPONENT, self.rate.exponent))
        if rest is None or rest.radius[rest.turn] == 0.0 or not EXPONENTS[0] <= exponent <= EXPONENTS[1]:
            return rest
        scene, turn, (depth, load, tilt) = rest.scene, rest.turn, self.shift(vector)
        given = self.given(own)
        made = {name: float(value) for name, value in parameters_from(given).items()}
        kept = (*PARAMETERS, SPEED, CLOSING, "machine_stiffness")
        x, y = rest.places[turn]
        pressed = float(x - depth - scene.compliance * (y - load - tilt * x)) / scene.R
        wanted = {name: made[name] for name in kept if name in made} | {"indentation_max_over_R": pressed}
        law = replace(self.rate, exponent=exponent)
        drawn, _ = draw_curves(wanted, ["path"], self.profile, self.loading, None, law)
        back = drawn["path_unloading"] == 1
        y = 1.5 * math.pi * scene.R * float(given["work_of_adhesion"]) * drawn["path_load"]
        x = scene.R * drawn["path_indentation"] + scene.compliance * y + depth
        places, radius = np.column_stack([x, y + load + tilt * x]), scene.R * drawn["path_contact_radius"]
        if not np.isfinite(places).all() or not back.any():
            return None
        up, inside = rest.places[: turn + 1], rest.radius[: turn + 1]
        bent, tangents = rest.curved[: turn + 1], rest.tangents[: turn + 1]
        if law.closing != "quasi-static":
            up, inside = np.concatenate([up[:1], places[~back]]), np.append(0.0, radius[~back])
            bent, tangents = np.arange(len(up)) > 1, _along(up)
        end = [[min(up[0, 0], places[-1, 0]), rest.places[-1, 1]]]
        return LoopPath(
            np.concatenate([up, places[back], end]),
            np.concatenate([tangents, _along(places[back]), np.zeros((1, 2))]),
            np.concatenate([inside, radius[back], [0.0]]),
            np.zeros(len(up) + np.count_nonzero(back) + 1, bool),
            np.concatenate([bent, np.arange(np.count_nonzero(back)) > 0, [False]]),
            len(up) - 1,
            scene,
        )


def _along(places: Floats) -> Floats:
    """Return directions of a curve at its points (n, 2), those of parabolas through their neighbours."""
    steps = np.hypot(*(np.diff(places, axis=0) / np.maximum(np.ptp(places, axis=0), np.finfo(float).tiny)).T)
    way = np.append(0.0, np.cumsum(np.maximum(steps, 1e-12)))
    return np.asarray(np.gradient(places, way, axis=0) if len(places) > 1 else places)
