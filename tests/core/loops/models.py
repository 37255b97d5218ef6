"""Loops of every kind, as what draws their paths and as what `draw_curves` draws them of."""

import math
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gradhesion.core import draw_curves
from gradhesion.core.loops.paths.misfit import Misfit
from gradhesion.core.loops.paths.model import LINEAR, LoopModel
from gradhesion.core.loops.paths.path import LoopPath, draw_loop
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Profile
from tests.core.scene import pattern_of, profile_of

Array = NDArray[np.float64]

R: Final = 5e-6
UNIT: Final = 1.5 * math.pi * R * 0.03
"""Of the load, in N."""
TRUE: Final = {"E_star": 1e7, "work_of_adhesion": 0.03, "wavelength": 0.5e-6, "A": 0.012}
SCENE: Final = {"k": 0.0, "nu": 0.3, "modulus": 1e7 * R / 0.03, "c0_over_R": 1.0, "lambda_over_R": 0.1, "A": 0.012}
TURN: Final = 0.05
"""Depth at which loading turns, over R."""
SERIES: Final = profile_of(2.2, (1, 1.0, 0.0), (2, 0.0, 0.3))
RINGS: Final = pattern_of("toughness", (1, 0.2, 0.1))
SPRING: Final = 10.0
"""N/m."""
STIFF: Final = {"machine_stiffness": SPRING / (1e7 * R)}
RIM: Final = 0.2 * R
PULLED: Final = {"spring_constant": SPRING, "indentation_max": TURN * R}
BY_MACHINE: Final = {"loading": Loading(control="machine")}
NOISE: Final = (1e-4 * R, 0.01 * UNIT)
"""Of depth and load."""


@dataclass(frozen=True)
class Case:
    """A kind of loop: what it has beside `TRUE`, how it is driven, and the same for `draw_curves`."""

    own: dict[str, float] = field(default_factory=dict)
    more: dict[str, Any] = field(default_factory=dict)
    scene: dict[str, float] = field(default_factory=dict)
    highest: float = -math.inf
    """The largest load of the data, in N."""

    def model(self, names: tuple[str, ...] = ("E_star",), fixed: dict[str, float] | None = None) -> LoopModel:
        """What draws its path from numbers of these names."""
        known = {"k": 0.0, "turn": TURN * R, "nu": 0.3, "R": R} | TRUE | self.own | (fixed or {})
        known = {name: value for name, value in known.items() if name not in names}
        ends: dict[str, Any] = {"furthest": (TURN * R, self.highest), "first": -0.1 * R, "profile": Profile()}
        return LoopModel(known, names, **(ends | self.more))

    def drawn(self) -> dict[str, Any]:
        """What `draw_curves` draws, with `x` and `y`, the depths (of the far end of a machine) and loads in SI units."""
        turn = {} if "load_max" in self.scene else {"indentation_max_over_R": TURN}
        scene = SCENE | {"a_max_over_R": math.inf} | turn | self.scene
        more = {name: one for name, one in self.more.items() if name != "indentation_max"}
        path = dict(draw_curves(scene, ["path"], **more)[0])
        compliance = 1.0 / SPRING if "machine_stiffness" in scene else 0.0
        y = UNIT * path["path_load"]
        return path | {"x": R * path["path_indentation"] + compliance * y, "y": y}


CASES: Final = {
    "wavy": Case(),
    "smooth": Case({"A": 0.0}, scene={"A": 0.0}),
    "series": Case(more={"profile": SERIES}),
    "rim": Case({"a_max": 0.2 * R}, scene={"a_max_over_R": 0.2}),
    "preload": Case({"preload": 5e-8}, scene={"load_max": 5e-8 / UNIT}),
    "machine": Case(PULLED, BY_MACHINE, STIFF),
    "machine at the rim": Case(PULLED | {"a_max": 0.2 * R}, BY_MACHINE, STIFF | {"a_max_over_R": 0.2}),
    "load control": Case(more={"loading": Loading(control="load")}, scene={"load_max": 5e-7 / UNIT}, highest=5e-7),
    "load control to a depth": Case({"indentation_max": TURN * R}, {"loading": Loading(control="load")}),
    "preload at the rim": Case({"preload": 6e-6, "a_max": RIM}, scene={"load_max": 6e-6 / UNIT, "a_max_over_R": 0.2}),
    "closing ratio 0.3": Case({"closing_ratio": 0.3}, scene={"closing_ratio": 0.3}),
    "closing ratio 0": Case({"closing_ratio": 0.0}, scene={"closing_ratio": 0.0}),
    "rings": Case(
        {"A": 0.0, "toughness_wavelength": 0.08 * R, "toughness_amplitude": 1.0},
        {"toughness": RINGS},
        {"A": 0.0, "toughness_wavelength_over_R": 0.08, "toughness_amplitude": 1.0},
    ),
}
"""Every kind of path, by what is special about it."""


def vector(model: LoopModel, **more: float) -> Array:
    """The numbers of a loop, as they are searched."""
    known = {"k": 0.0, "turn": TURN * R, "indentation_offset": 2e-9, "load_offset": 1e-8, "load_slope": 0.02}
    known |= TRUE | model.fixed | more
    return np.array([known[name] if name in LINEAR else math.log(known[name]) for name in model.names])


def path_of(model: LoopModel, here: Array) -> LoopPath:
    drawn = draw_loop(model, here)
    assert drawn is not None
    return drawn


def misfit_of(model: LoopModel, here: Array, spots: Array, back: Any, count: float = 1.0, wide: float = 1e3) -> Misfit:
    """The misfit of some points, with ranges so far away."""
    return Misfit(spots, back, NOISE, np.full(len(spots), count), model, here - wide, here + wide)
