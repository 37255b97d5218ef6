"""Scenes made ready: how far they are drawn, and when there is nothing to draw."""

import math

import numpy as np
import pytest

from gradhesion.core import solve
from gradhesion.core.curve.branches import ARRIVAL, START
from gradhesion.core.curves.subject import BEYOND, BEYOND_SMOOTH, subject_of
from gradhesion.core.problem.material import stiffness


def _zero_depth(scene: dict[str, float]) -> float:
    """a_1 = [(1+k) R s]^(2/(3+k)), where the smooth curve crosses zero depth."""
    k = scene["k"]
    material = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    return float(((1 + k) * math.sqrt(2 ** (1 + k) * math.pi / material)) ** (2 / (3 + k)))


def test_a_punch_is_drawn_to_its_rim(scene: dict[str, float]) -> None:
    subject = subject_of(scene)
    assert subject is not None
    assert subject.bounded
    assert subject.end == subject.rim == scene["a_max_over_R"]


@pytest.mark.parametrize(
    "change", [{}, {"A": 0.2}, {"A": 0.0}, {"A": 1e-5}, {"lambda_over_R": 1.3}, {"k": 1.0, "nu": 0.5}], ids=str
)
def test_an_unbounded_punch_is_drawn_beyond_all_that_happens(change: dict[str, float], scene: dict[str, float]) -> None:
    scene |= change | {"a_max_over_R": math.inf}
    subject = subject_of(scene)
    assert subject is not None
    assert subject.trace is not None
    assert not subject.bounded
    radius = subject.exact.radius_scale
    events = [subject.trace[START, -1] * radius, subject.trace[ARRIVAL, -1] * radius, subject.load_folds[-1] * radius]
    assert solve(scene, ["pull_off_radius"])["pull_off_radius"] <= max(events) * (1 + 1e-12)
    least = BEYOND_SMOOTH * _zero_depth(scene)
    assert subject.end == pytest.approx(max(least, BEYOND * max(events)), rel=1e-13)
    # the cycle of a punch that ends there has saturated
    energy = solve(scene | {"a_max_over_R": [subject.end, math.inf]}, ["dissipated_energy"])["dissipated_energy"]
    assert energy[0] == pytest.approx(energy[1], rel=1e-12)


def test_without_waves_the_form_is_plain(scene: dict[str, float]) -> None:
    smooth, wavy = subject_of(scene | {"A": 0.0}), subject_of(scene)
    assert smooth is not None
    assert wavy is not None
    assert smooth.exact.is_plain
    assert wavy.exact.is_one_wave
    assert smooth.chi == smooth.mean_height == 0.0


def test_folds_so_far_out_that_they_are_rounding_make_a_smooth_curve(scene: dict[str, float]) -> None:
    """As in a map: the curve of such a scene is that of A = 0."""
    scene |= {"lambda_over_R": 1e-11, "A": 1e-15}
    subject = subject_of(scene)
    assert subject is not None
    assert subject.exact.is_plain
    assert solve(scene, ["loading_jumps"])["loading_jumps"] == 1


def test_chi_is_r_over_s(scene: dict[str, float]) -> None:
    k, wavelength = scene["k"], scene["lambda_over_R"]
    subject = subject_of(scene)
    assert subject is not None
    r = math.pi ** ((1 - k) / 2) * math.gamma((1 + k) / 2) * scene["A"] * wavelength ** ((1 + k) / 2)
    material = float(stiffness(k, scene["nu"], scene["modulus"], scene["c0_over_R"]))
    s = math.sqrt(2 ** (1 + k) * math.pi / material)
    assert subject.chi == pytest.approx(r / s, rel=1e-14)
    assert subject.mean_height == scene["A"] * wavelength


def test_without_a_trace_the_range_is_that_of_the_closed_forms(scene: dict[str, float]) -> None:
    """5 % beyond the lowest load of the unloading envelope, or 1.5 times the zero of the smooth curve."""
    k = scene["k"]
    for amplitude in (1e-3, 3.0):
        changed = scene | {"lambda_over_R": 1e-7, "A": amplitude, "a_max_over_R": math.inf}
        subject = subject_of(changed)
        assert subject is not None
        assert subject.trace is None
        zero = _zero_depth(changed)
        pull_off = zero * (0.25 * (3 + k) * (1 + subject.chi)) ** (2 / (3 + k))
        assert subject.end == pytest.approx(max(BEYOND_SMOOTH * zero, BEYOND * pull_off), rel=1e-13)


@pytest.mark.parametrize(
    "wrong",
    [{"k": 2.0}, {"nu": 0.51}, {"modulus": -1.0}, {"lambda_over_R": 0.0}, {"A": -1.0}, {"a_max_over_R": -1.0}],
    ids=str,
)
def test_out_of_range(wrong: dict[str, float], scene: dict[str, float]) -> None:
    assert subject_of(scene | wrong) is None


def test_a_wave_too_long_for_the_tables_is_none(scene: dict[str, float]) -> None:
    """Its curvature, 4 pi^2 A/lambda, is nothing beside 1/R."""
    long, smooth = subject_of(scene | {"lambda_over_R": 1e200}), subject_of(scene | {"A": 0.0})
    assert long is not None
    assert smooth is not None
    np.testing.assert_array_equal(long.trace, smooth.trace)
    assert subject_of(scene | {"lambda_over_R": 1e200, "A": 1e250}) is None


def test_scales(scene: dict[str, float]) -> None:
    subject = subject_of(scene)
    assert subject is not None
    radius, depth, load = subject.exact.scaled(np.array([[1.0, 2.0], [1.0, 3.0], [1.0, 5.0]]))
    assert radius.tolist() == [scene["lambda_over_R"], 2 * scene["lambda_over_R"]]
    assert depth[1] == 3 * depth[0] > 0
    assert load[1] == 5 * load[0] > 0
