"""Many rims of a curve against each for itself: pull-off, cycle and status."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import Harmonic, Loading, Profile
from gradhesion.core.arrays.general import solve_general
from gradhesion.core.problem.names import RESULTS

pytestmark = pytest.mark.slow

SERIES = (Harmonic(n=1), Harmonic(n=2, cos=0.3, sin=0.4), Harmonic(n=3, cos=-0.2, sin=0.1))
PROFILES = [
    Profile(harmonics=SERIES),
    Profile(exponent=3.0),
    Profile(exponent=1.0, harmonics=(Harmonic(n=3),)),
    Profile(exponent=1.3, harmonics=(Harmonic(n=1, cos=-1.0),)),
]
CONTROLS: list[tuple[str, dict[str, float]]] = [
    ("displacement", {}),
    ("load", {}),
    ("machine", {"machine_stiffness": 0.1}),
]


@pytest.mark.parametrize(("control", "spring"), CONTROLS)
@pytest.mark.parametrize("profile", PROFILES)
def test_rims_share_what_each_finds_alone(profile: Profile, control: str, spring: dict[str, float]) -> None:
    rng = np.random.default_rng(3)
    loading = Loading(control=control)
    for k in (0.0, 0.4, 1.0):
        scene: dict[str, Any] = {
            "k": k,
            "nu": 0.5 if k == 1.0 else 0.3,
            "modulus": 10.0 ** rng.uniform(1.5, 3.5),
            "c0_over_R": 0.05,
            "lambda_over_R": 10.0 ** rng.uniform(-1.7, -0.5),
            "A": 10.0 ** rng.uniform(-3.0, -0.7),
        }
        rims = 10.0 ** rng.uniform(-1.8, 0.5, 30)
        rims[3], rims[11] = -1.0, math.nan
        together = solve_general(scene | spring | {"a_max_over_R": rims}, RESULTS, profile, loading, 1)
        for i, rim in enumerate(rims):
            alone = solve_general(scene | spring | {"a_max_over_R": rim}, RESULTS, profile, loading, 1)
            for name, value in alone.items():
                # cells end elsewhere, so that a place is refined from another start
                np.testing.assert_allclose(together[name][i], value, rtol=1e-12, atol=1e-15, err_msg=name)
