"""The envelopes: their definition, and the curves that lie between them and touch them."""

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gradhesion.core.curves import draw_curves
from gradhesion.core.curves.asymptotic import draw_asymptotic
from gradhesion.core.curves.envelope import draw_envelope
from gradhesion.core.curves.forms import fill_points
from gradhesion.core.curves.path import draw_path
from gradhesion.core.curves.subject import Subject, subject_of
from gradhesion.core.problem.profile import WAVY, Harmonic, Profile


def test_points_lie_on_the_envelopes_of_the_paper(scene: dict[str, float]) -> None:
    """delta = a^2/((1+k)R) + lambda A - (s -+ r) a^((1-k)/2), P = K [2 a^(3+k)/((1+k)(3+k)R) - (s -+ r) a^((3+k)/2)]."""
    subject = subject_of(scene)
    assert subject is not None
    curve = draw_envelope(subject, WAVY)
    k, wavelength, amplitude = (mpmath.mpf(scene[name]) for name in ("k", "lambda_over_R", "A"))
    s = mpmath.mpf(subject.stretch)
    r = mpmath.pi ** ((1 - k) / 2) * mpmath.gamma((1 + k) / 2) * amplitude * wavelength ** ((1 + k) / 2)
    front = 4 * mpmath.pi / ((1 + k) * s**2)
    for name, pull in (("loading", s - r), ("unloading", s + r)):
        depths, loads = curve[f"{name}_envelope_indentation"], curve[f"{name}_envelope_load"]
        for radius, depth, load in zip(curve["envelope_contact_radius"][::7], depths[::7], loads[::7], strict=True):
            a = mpmath.mpf(radius)
            expected = a * a / (1 + k) + wavelength * amplitude - pull * a ** ((1 - k) / 2)
            assert abs(depth - expected) <= 1e-14 * np.ptp(depths)
            expected = front * (2 * a ** (3 + k) / ((1 + k) * (3 + k)) - pull * a ** ((3 + k) / 2)) / (1.5 * mpmath.pi)
            assert abs(load - expected) <= 1e-14 * np.ptp(loads)


def test_chords_are_within_the_contract(any_subject: Subject, worst_chord: Callable[..., float]) -> None:
    curve = draw_envelope(any_subject, WAVY)
    for name, sign in (("loading", -1), ("unloading", 1)):
        form = any_subject.plain(1.0 + sign * any_subject.chi, any_subject.mean_height)
        points = (
            curve["envelope_contact_radius"],
            curve[f"{name}_envelope_indentation"],
            curve[f"{name}_envelope_load"],
        )
        assert worst_chord(form, points) <= 2e-4
    assert curve["envelope_contact_radius"].size <= 300


def _at(subject: Subject, sign: int, radii: Any) -> tuple[Any, Any]:
    """Depth and load of an envelope: that of loading has the sign -1."""
    form = subject.plain(1.0 + sign * subject.chi, subject.mean_height)
    points = np.array([radii, radii, radii]) / form.radius_scale
    fill_points(form.table, form.numbers, points)
    _, depth, load = form.scaled(points)
    return depth, load


def test_the_asymptotic_curve_lies_between_and_touches_both(scene: dict[str, float]) -> None:
    subject = subject_of(scene | {"A": 0.05})
    assert subject is not None
    curve = draw_asymptotic(subject, WAVY)
    assert curve is not None
    radii = curve["asymptotic_contact_radius"]
    far = radii > 0.3 * subject.end
    for upper, lower, name in zip(
        _at(subject, -1, radii), _at(subject, 1, radii), ("indentation", "load"), strict=True
    ):
        values = curve[f"asymptotic_{name}"]
        rounding = 1e-14 * np.ptp(values)
        assert (lower - rounding <= values).all()
        assert (values <= upper + rounding).all()
        height = 0.5 * np.median((upper - lower)[far])  # towards each there is a point in every wave
        assert np.count_nonzero((upper - values)[far] < 0.1 * height) >= 5
        assert np.count_nonzero((values - lower)[far] < 0.1 * height) >= 5


def test_the_exact_path_runs_along_them(scene: dict[str, float]) -> None:
    """The ends of branches that loading leaves lie on the upper envelope, those of unloading on the lower one."""
    subject = subject_of(scene | {"lambda_over_R": 1e-3, "A": 0.1})
    assert subject is not None
    path = draw_path(subject)
    jumps = np.flatnonzero(path["path_jump"])
    left = jumps - 1
    for unloading, sign in ((0, -1), (1, 1)):
        here = left[(path["path_contact_radius"][left] > 0.2) & (path["path_unloading"][jumps] == unloading)]
        here = here[path["path_contact_radius"][here] < subject.rim]
        assert here.size > 50
        radii = path["path_contact_radius"][here]
        gap = path["path_indentation"][here] - _at(subject, sign, radii)[0]
        width = _at(subject, -1, radii)[0] - _at(subject, 1, radii)[0]
        assert np.abs(gap / width).max() <= 0.01  # of the order lambda/a


ROUGH = Profile(exponent=2.5, harmonics=(Harmonic(n=1, cos=1.0), Harmonic(n=3, cos=0.2, sin=-0.3)))


def test_a_series_of_one_cosine_has_the_same_envelopes(scene: dict[str, float]) -> None:
    """A second harmonic of half the amplitude is a cosine of half the length."""
    half = Profile(harmonics=(Harmonic(n=2, cos=0.5),))
    one, _ = draw_curves(scene | {"lambda_over_R": 0.5 * scene["lambda_over_R"]}, ["envelope", "effective"])
    other, _ = draw_curves(scene, ["envelope", "effective"], half)
    for name, values in one.items():
        assert other[name].shape == values.shape
        assert other[name] == pytest.approx(values, rel=1e-12, abs=1e-13 * np.ptp(values)), name


def test_short_waves_of_any_punch_lie_between_their_envelopes_and_touch_them(scene: dict[str, float]) -> None:
    found, status = draw_curves(scene | {"lambda_over_R": 0.01, "A": 0.03}, ["asymptotic", "envelope"], ROUGH)
    assert status == 0
    radii = found["asymptotic_contact_radius"]
    far = radii > 0.3 * radii[-1]
    for name in ("indentation", "load"):
        values = found[f"asymptotic_{name}"]
        upper, lower = (
            CubicSpline(found["envelope_contact_radius"], found[f"{way}_envelope_{name}"])(radii)
            for way in ("loading", "unloading")
        )
        height = np.median((upper - lower)[far])
        assert (lower[far] - 0.02 * height <= values[far]).all()
        assert (values[far] <= upper[far] + 0.02 * height).all()
        assert np.count_nonzero((upper - values)[far] < 0.1 * height) >= 5
        assert np.count_nonzero((values - lower)[far] < 0.1 * height) >= 5
