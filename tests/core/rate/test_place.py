"""The curve at a radius against quadrature of the profile."""

import math
from typing import Any

import pytest

from gradhesion.core import Harmonic, Loading, Profile
from gradhesion.core.rate.place import coordinate_of, load_of, place_at

SCENE = {"k": 0.37, "nu": 0.2, "modulus": 700.0, "c0_over_R": 0.03, "lambda_over_R": 0.17, "A": 0.013}
MORE = {"a_max_over_R": 0.5, "machine_stiffness": 0.4}
TWO = Profile(exponent=2.5, harmonics=(Harmonic(n=1, cos=1.0, sin=0.3), Harmonic(n=3, cos=-0.2, sin=0.1)))


@pytest.mark.parametrize("control", ["displacement", "machine"])
@pytest.mark.parametrize("a", [1e-6, 0.01, 0.13, 0.5])
def test_place(case_of: Any, control: str, a: float) -> None:
    case, rho = case_of(SCENE | MORE, TWO, Loading(control=control)), 1.3
    punch, curve = case.punch, case.curve
    place = place_at(case.basis, curve, a / SCENE["lambda_over_R"])
    size = punch.adhesion(a)
    assert case.length * place.z == pytest.approx(a, rel=1e-15)
    assert case.unit * place.adhesion == pytest.approx(size, rel=1e-14)
    assert case.unit * place.depth == pytest.approx(punch.at(a)[0], rel=1e-13)
    load = case.force * load_of(place, rho) * 1.5 * math.pi
    assert load == pytest.approx(punch.load(a, rho), abs=1e-12 * punch.K * a ** (1.0 + punch.k) * size)
    assert case.unit / curve.alpha * coordinate_of(curve, place, rho) == pytest.approx(
        punch.coordinate(a, rho), abs=1e-12 * size * (1.0 + punch.compliance * a ** (1.0 + punch.k))
    )
    need, force = punch.terms(a, rho)
    assert place.push - place.level * rho == pytest.approx(need, abs=1e-12)
    assert case.length * curve.alpha / case.unit * place.drag == pytest.approx(force, rel=1e-13)
