"""Loops with known parameters, drawn at random, and what their fits make of them."""

import math
import time
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t

from gradhesion.core import draw_curves
from gradhesion.core.answers.loop_fit import fit_loop
from gradhesion.core.equations import jkr

Array = NDArray[np.float64]

R: Final = 5e-6
FREE: Final = {
    "E_star": (1e6, 1e8),
    "work_of_adhesion": (5e-3, 0.2),
    "wavelength": (0.2e-6, 1.5e-6),
    "A": (0.002, 0.05),
}
"""What is searched."""
DRAWN: Final = {
    "E_star": (3e6, 5e7),
    "work_of_adhesion": (0.01, 0.1),
    "wavelength": (0.3e-6, 1e-6),
    "A": (0.005, 0.025),
}
"""What the loops are drawn from, by the logarithm."""
TURN: Final = (0.02, 0.08)
"""Depths, in R, at which they turn."""
NOISE: Final = 0.01
"""Of the load, in parts of the pull-off force; that of the depth is a tenth of it, in parts of its span."""
TIMED: Final = 50
"""Loops whose linear intervals are timed too."""
OTHER: Final = 10.0
"""Standard deviations that a value is off by where a fit is in another minimum."""


@dataclass(frozen=True)
class Loop:
    """A loop, with what it was made with."""

    true: dict[str, float]
    depth: Array
    load: Array
    back: NDArray[np.bool_]
    noise: tuple[float, float]


def drawn(rng: np.random.Generator, points: int) -> Loop:
    """Draw a loop."""
    true = {name: float(np.exp(rng.uniform(*np.log(ends)))) for name, ends in DRAWN.items()}
    E_star, work, wavelength, A = true.values()
    modulus, turn = E_star * R / work, float(rng.uniform(*TURN))
    scene = {"k": 0.0, "nu": 0.3, "modulus": modulus, "c0_over_R": 1.0, "lambda_over_R": wavelength / R, "A": A}
    path = draw_curves(scene | {"a_max_over_R": math.inf, "indentation_max_over_R": turn}, ["path"])[0]
    x, y, a = (path[f"path_{name}"] for name in ("indentation", "load", "contact_radius"))
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x) / np.ptp(x), np.diff(y) / np.ptp(y)))])
    places = np.linspace(0.0, along[-1], points)
    after = np.clip(np.searchsorted(along, places), 1, x.size - 1)
    depth, load, radius = (np.interp(places, along, row) for row in (x, y, a))
    curved = path["path_jump"][after] == 0  # elsewhere a jump, which is straight
    shape = (0.0, modulus, radius[curved], wavelength / R, A)
    depth[curved], load[curved] = jkr.indentation(*shape), jkr.load(*shape)
    depth, load = R * depth, 1.5 * math.pi * R * work * load
    noise = 0.1 * NOISE * float(np.ptp(depth)), -NOISE * float(load.min())
    errors = rng.standard_normal((2, points))
    true |= {
        "indentation_offset": 0.02 * float(rng.uniform(-1.0, 1.0)) * float(np.ptp(depth)),
        "load_offset": 0.02 * float(rng.uniform(-1.0, 1.0)) * float(np.ptp(load)),
    }
    return Loop(
        true,
        depth + noise[0] * errors[0] + true["indentation_offset"],
        load + noise[1] * errors[1] + true["load_offset"],
        path["path_unloading"][after] > 0,
        noise,
    )


def fitted(number: int, seed: int, points: int) -> dict[str, Any]:
    """Draw a loop by its number and fit it."""
    loop = drawn(np.random.default_rng([seed, number]), points)
    fixed = {"k": 0.0, "nu": 0.3, "R": R}
    seconds = []
    for way in ("linear", "profile") if number < TIMED else ("profile",):
        start = time.perf_counter()
        found = fit_loop(loop.depth, loop.load, loop.back, fixed, FREE, noise=loop.noise, intervals=way)
        seconds.append(time.perf_counter() - start)
    quantile = float(t.ppf(0.975, found.degrees_of_freedom))
    off = {name: (found.values[name] - true) / found.standard_deviations[name] for name, true in loop.true.items()}
    return {
        "number": number,
        "true": loop.true,
        "off": off,
        "linear": {name: abs(error) <= quantile for name, error in off.items()},
        "profile": {name: found.low[name] <= true <= found.high[name] for name, true in loop.true.items()},
        "misfit": found.chi_square / found.degrees_of_freedom,
        "seconds": seconds,
    }
