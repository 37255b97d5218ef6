"""What is compiled ahead is all that is used then."""

import math
import os
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numba.core import event

from gradhesion.core import CURVES, OUTPUTS, REPORTS, SENSITIVITIES, Loading, Profile, draw_curves, solve, warm_up
from gradhesion.core.problem.toughness import Rate
from tests.core.scene import pattern_of, profile_of, scene_of

SCENE = scene_of(0.31, 0.27, 430.0, 0.013, 0.17, 0.023, 0.7)
FAR = {"lambda_over_R": 1.3e-3, "a_max_over_R": 1.0}
DEEP = {"indentation_max_over_R": 0.04}
SPRING = {"machine_stiffness": 3.0}
LENGTH = {"toughness_wavelength_over_R": 0.3}
SLOW = {"speed_over_reference": 0.1, "a_max_over_R": 0.5}
WORKS = {"closing_ratio": 0.7, "a_max_over_R": 0.5}
MANY_K = {"k": np.linspace(0.1, 0.9, 300)}
OTHERS = {"profile": profile_of(1.0, (2, 0.3, 0.4), (5, 0.1, 0.0))}
BY_LOAD = {"profile": Profile(exponent=2.5), "loading": Loading(control="load")}
BY_MACHINE = {"profile": OTHERS["profile"], "loading": Loading(control="machine")}
OVER = {"toughness": pattern_of("toughness", (1, 0.1, 0.0), (4, 0.0, -0.2))}
ASKED: list[tuple[Callable[..., Any], dict[str, Any], Any, dict[str, Any]]] = [
    (solve, {}, ["pull_off_force", "pull_off_radius"], {}),
    (solve, {}, OUTPUTS, {}),
    (solve, {}, REPORTS, {}),
    (solve, {}, SENSITIVITIES, {}),
    (solve, {"load_max": [0.1, 3.0]}, OUTPUTS, {}),
    (solve, DEEP, SENSITIVITIES[:1], {}),
    (solve, {"a_max_over_R": [0.3, 0.5, math.inf]}, OUTPUTS, {}),
    (solve, FAR, OUTPUTS, {}),
    (solve, {"lambda_over_R": [1e-3, 0.1], "a_max_over_R": 0.4}, ["delta_max"], {}),
    (solve, WORKS, (*OUTPUTS, "snap_in_force", "front_energy"), {}),
    *((solve, {}, ["dissipated_energy"], more | {"solver": one}) for one in ("asymptotic", "envelope") for more in ({}, OTHERS)),
    (solve, {}, OUTPUTS, OTHERS),
    (solve, FAR, SENSITIVITIES, OTHERS),
    (solve, {}, OUTPUTS, BY_LOAD),
    (solve, SPRING, OUTPUTS, BY_MACHINE),
    (solve, SPRING | DEEP, SENSITIVITIES, BY_MACHINE),
    (solve, LENGTH, (*OUTPUTS, *REPORTS), OVER),
    (solve, LENGTH | {"load_max": 1.0}, OUTPUTS, OVER),
    (solve, LENGTH, SENSITIVITIES, OVER | OTHERS),
    (solve, SLOW, ["pull_off_force"], {"rate": Rate(exponent=0.6)}),
    (draw_curves, {}, tuple(CURVES), {}),
    (draw_curves, {}, ("path", "jumps"), OTHERS),
    (draw_curves, SPRING, ("equilibrium", "path", "jumps"), BY_MACHINE),
    (draw_curves, LENGTH, ("equilibrium", "path", "jumps"), OVER),
    (solve, MANY_K, ["pull_off_force"], {}),
    (solve, MANY_K, ["pull_off_force"], {"solver": "asymptotic"}),
]  # fmt: skip

ARRAYS = """
from numba.core.runtime import rtsys
from gradhesion.core import warm_up

def made_and_kept():
    warm_up()
    stats = rtsys.get_allocation_stats()
    return stats.mi_alloc, stats.mi_alloc - stats.mi_free

(first, kept), (then, now) = made_and_kept(), made_and_kept()
print(then > first, now - kept)
"""


@pytest.mark.slow
def test_the_arrays_that_kernels_make_are_given_back() -> None:
    counting = os.environ | {"NUMBA_NRT_STATS": "1"}
    done = subprocess.run([sys.executable, "-c", ARRAYS], env=counting, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr, done.returncode) == ("True 0\n", "", 0)


@pytest.mark.slow
def test_nothing_is_left_to_compile_and_usual_scenes_compile_less() -> None:
    everything: list[str] = []
    usual: list[str] = []
    warm_up(lambda name, _: everything.append(name))
    warm_up(lambda name, _: usual.append(name), everything=False)
    assert set() < {*usual} < {*everything}
    with event.install_recorder("numba:compiler_lock") as recorder:
        for change in ({}, {"k": 0.0, "A": 0.0}, {"k": 1.0, "nu": 0.5, "a_max_over_R": math.inf}):
            for call, more, names, how in ASKED:
                if "k" not in more or not change:
                    call(SCENE | change | more, names, **how)
    assert recorder.buffer == [], "no kernel is compiled, nor read from the cache: all have been used"
