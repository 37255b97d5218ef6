"""A scene of the moving edge as kernels take it."""

from dataclasses import dataclass
from typing import Any

import pytest

from gradhesion.core import Loading, Profile
from gradhesion.core.arrays.tables import tables_of
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Series, curve_of
from gradhesion.core.problem.shape import depth_factor_of, rows_of
from tests.core.rate.second_way import Punch


@dataclass
class Case:
    """A punch, and the same in reduced units."""

    punch: Punch
    basis: Basis
    curve: Series
    length: float
    unit: float
    force: float


@pytest.fixture
def case_of() -> Any:
    """Give the case of a scene, a profile and a control."""

    def case(scene: dict[str, float], profile: Profile, loading: Loading) -> Case:
        punch = Punch(scene, profile, loading)
        k, rows = punch.k, rows_of(profile)
        factor = depth_factor_of(k, profile.exponent)
        wave = scene["lambda_over_R"], scene["A"]
        curve, length, unit = curve_of(k, profile.exponent, factor, punch.stretch, *wave, punch.compliance)
        return Case(punch, Basis(*tables_of(k, rows), rows), curve, length, unit, force_unit(k, length, unit))

    return case
