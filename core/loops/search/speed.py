"""Loops whose edge opens, or closes too, at a work that grows with its speed: paths by time, and where to start.

Loading at rest is that of any loop (path.py). A moving edge is integrated by core/rate/, and derivatives of its path
are differences.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

import numpy as np

from gradhesion.core.closed.reduced import parameters_from
from gradhesion.core.draw.draw import draw_curves
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.path import LoopModel, LoopPath
from gradhesion.core.loops.search.starts import best_of, carried, coarse, roughly, shares_of
from gradhesion.core.problem.names import CLOSING, PARAMETERS, SPEED
from gradhesion.core.problem.rate import EXPONENTS, Rate
from gradhesion.core.types import Floats

EXPONENT: Final = "exponent"
"""The name of the power of the speed, where it is searched."""
NAMES_OF_SPEED: Final = ("speed", "reference_speed", SPEED, EXPONENT)
_TRIED: Final = 4
"""Speeds that are tried."""
_KEPT: Final = 3
"""Starts that are refined by more points."""


class SpeedModel(LoopModel):
    """The path of a loop whose edge has a speed, as a function of the numbers that are searched.

    Parameters
    ----------
    rate
        The law; its exponent is that of the numbers that are searched, if it is one of them.
    others
        As of `LoopModel`.
    """

    by_differences = True

    def __init__(self, fixed: Mapping[str, float], names: tuple[str, ...], *, rate: Rate, **others: Any) -> None:
        super().__init__(fixed, names, **others)
        self.rate = rate

    def path(self, vector: Floats) -> LoopPath | None:
        """Draw the path; None where the scene has none. It turns where that of an edge at rest does."""
        rest = super().path(vector)
        own = self.values(vector)
        exponent = float(own.pop(EXPONENT, self.rate.exponent))
        if rest is None or rest.radius[rest.turn] == 0.0 or not EXPONENTS[0] <= exponent <= EXPONENTS[1]:
            return rest
        made = {name: float(value) for name, value in parameters_from(self.given(own)).items()}
        depth, load, tilt = self.shift(vector)
        scene, unit = rest.scene, 1.5 * math.pi * rest.scene.R * float(self.given(own)["work_of_adhesion"])
        x, y = rest.places[rest.turn]
        pressed = float(x - depth - scene.compliance * (y - load - tilt * x))
        kept = (*PARAMETERS, SPEED, CLOSING, "machine_stiffness")
        wanted = {name: made[name] for name in kept if name in made} | {"indentation_max_over_R": pressed / scene.R}
        law = replace(self.rate, exponent=exponent)
        drawn, _ = draw_curves(wanted, ["path"], self.profile, self.loading, None, law)
        radius = scene.R * drawn["path_contact_radius"]
        y = unit * drawn["path_load"]
        x = scene.R * drawn["path_indentation"] + scene.compliance * y
        places = np.column_stack([x + depth, y + load + tilt * (x + depth)])
        back = drawn["path_unloading"] == 1
        if not np.isfinite(places).all() or not back.any():
            return None
        up, inside, bent = (row[: rest.turn + 1] for row in (rest.places, rest.radius, rest.curved))
        if law.closing != "quasi-static":
            up, inside = np.concatenate([up[:1], places[~back]]), np.append(0.0, radius[~back])
            bent = np.arange(len(up)) > 1
        end = [min(rest.places[0, 0], places[-1, 0]), rest.places[-1, 1]]
        curved = np.concatenate([bent, np.arange(np.count_nonzero(back)) > 0, [False]])
        return LoopPath(
            np.concatenate([up, places[back], [end]]),
            np.concatenate([inside, radius[back], [0.0]]),
            np.zeros(curved.size, bool),
            curved,
            len(up) - 1,
            scene,
        )


def fast_starts(misfit: Misfit, rest: Misfit, begun: Floats) -> list[Floats]:
    """Return starts of some speeds from the minimum of an edge at rest, refined by a few points, the best first."""
    few, start = coarse(misfit, 100), carried(misfit, rest, begun)
    free = [i for i, name in enumerate(misfit.names) if name in NAMES_OF_SPEED]
    vectors = np.tile(start, (_TRIED if free else 1, 1))
    for i in free:
        vectors[:, i] = shares_of(misfit, i, _TRIED)
    return best_of(misfit, roughly(misfit, list(vectors), few, most=12), few, _KEPT)
