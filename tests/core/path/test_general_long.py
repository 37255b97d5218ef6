"""Cycles of many waves: similar scenes, whose coordinates round anew while the phase at the rim is the same double.

Lengths differ by 5/4, which a power of two for the wavelength makes exact (docs/theory.md, section 6).
"""

import math
from typing import Any

import pytest

from gradhesion.core import Harmonic, Loading, Profile, solve
from gradhesion.core.closed.similarity import amplitude_of_ratio
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import FAILED

pytestmark = pytest.mark.slow

FACTOR = 1.25
PAIR = (Harmonic(n=1, cos=0.6, sin=-0.3), Harmonic(n=2, cos=-0.2, sin=0.25))
PARTS = ("loading_energy", "unloading_energy")


def _energies(scene: dict[str, float], factor: float, m: float, profile: Profile, control: str) -> list[float]:
    """Return energies of loading and unloading over the square of a factor in all lengths."""
    k = scene["k"]
    powers = {"modulus": 1.0 - 2.0 * m - k, "lambda_over_R": 1.0, "a_max_over_R": 1.0, "A": m - 1.0}
    powers |= {"machine_stiffness": 1.0 + k, "load_max": 2.0 - m, "indentation_max_over_R": m}
    similar = {name: value * factor ** powers.get(name, 0.0) for name, value in scene.items()}
    found = solve(similar, PARTS, profile=profile, loading=Loading(control=control), check_contact=False)
    assert not int(found["status"]) & FAILED
    return [float(found[name]) / factor**2 for name in PARTS]


@pytest.mark.parametrize(
    ("k", "m", "harmonics", "control", "waves", "ratio", "chi", "extra"),
    [
        # unloading ends between neighbours that are level to rounding
        (0.3, 2.0, PAIR, "displacement", 2.6e4, 3.0, 1e-3, {}),
        (0.0, 2.0, (Harmonic(n=1, cos=0.0, sin=1.0),), "displacement", 4.3e5, 2.0, 0.1, {}),
        (0.5, 3.0, PAIR, "machine", 7.1e5, 5.0, 0.02, {"machine_stiffness": 0.3}),
        (0.8, 1.0, PAIR, "load", 9.9e4, 4.0, 0.3, {}),
        # k = 1: the waves next to zero contact are level, and unloading passes them
        (1.0, 2.0, PAIR, "displacement", 5.3e5, 5.8, 0.016, {}),
        (1.0, 2.0, PAIR, "machine", 3.6e4, 6.0, 2.4e-4, {"machine_stiffness": 0.0038}),
        # loading jumps in where many waves end at the depth 0
        (0.9, 2.0, (Harmonic(n=1, cos=-1.0),), "displacement", 33910.125, 2.8, 1.2, {}),
    ],
)
def test_similar_scenes(
    k: float, m: float, harmonics: Any, control: str, waves: float, ratio: float, chi: float, extra: dict[str, float]
) -> None:
    nu, c0 = 0.5 if k == 1.0 else 0.2, 0.1
    wavelength = 2.0 ** round(math.log2(1e-3 / waves))
    length = waves * wavelength / ratio
    modulus = length ** (1.0 - 2.0 * m - k) / float(stiffness(k, nu, 1.0, c0))
    scene: dict[str, Any] = {"k": k, "nu": nu, "modulus": modulus, "c0_over_R": c0, "lambda_over_R": wavelength}
    scene |= {"A": float(amplitude_of_ratio(**scene, chi=chi)), "a_max_over_R": waves * wavelength, **extra}
    profile = Profile(exponent=m, harmonics=harmonics)
    one, other = (_energies(scene, factor, m, profile, control) for factor in (1.0, FACTOR))
    size = sum(abs(energy) for energy in one)
    for energy, similar in zip(one, other, strict=True):
        assert abs(energy - similar) <= 1e-12 * (waves / 1000.0) * size
