"""The asymptotic curve: its definition (5.15)-(5.20), its chords, and the exact curve as waves become short."""

import math
from collections.abc import Callable

import mpmath
import numpy as np
import pytest

from gradhesion.core.curve.branches import END, START
from gradhesion.core.curve.general import Basis
from gradhesion.core.curve.short_wave import ShortWave, waves_of
from gradhesion.core.curves import asymptotic as drawing
from gradhesion.core.curves import draw_curves
from gradhesion.core.curves import general as general_curves
from gradhesion.core.curves.forms import fill_points, general_numbers
from gradhesion.core.curves.smooth import draw_smooth
from gradhesion.core.curves.subject import Form, Subject, subject_of, wavy_form
from gradhesion.core.equations import short_waves
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.profile import Harmonic, Profile

TWO: Profile = Profile(exponent=3.0, harmonics=(Harmonic(n=1, cos=1.0), Harmonic(n=3, cos=0.1, sin=-0.2)))


def draw_asymptotic(subject: Subject) -> dict[str, np.ndarray] | None:
    return drawing.draw_asymptotic(subject, Profile())


def _form(subject: Subject) -> Form:
    if subject.mean_height == 0.0:
        return subject.plain(1.0)
    wavy = wavy_form(subject.table, subject.stretch, subject.wavelength, subject.mean_height)
    bend, gain, _ = wavy.curve
    series = np.array([[1.0, 1.0, 0.0]])
    curve = ShortWave(0.5 * bend, 2.0, gain, 1.0, 0.0)
    numbers = general_numbers(subject.k, curve, float(subject.table["amplitude"]), series)
    basis = Basis(subject.table, *waves_of(subject.table, series))
    return Form(basis, numbers, subject.wavelength, wavy.depth_scale, wavy.load_scale)


def test_points_lie_on_the_curve_of_the_paper(scene: dict[str, float]) -> None:
    """delta1 + lambda A + 2^((k-1)/2) a^((1-k)/2) G((1+k)/2) lambda^((1+k)/2) zeta and P1 + K 2^((k-1)/2) a^((3+k)/2) ..."""
    subject = subject_of(scene)
    assert subject is not None
    curve = draw_asymptotic(subject)
    assert curve is not None
    k, wavelength, amplitude = (mpmath.mpf(scene[name]) for name in ("k", "lambda_over_R", "A"))
    stretch = mpmath.mpf(subject.stretch)
    front = 2 ** (1 - k) / (1 + k) * 2 ** (1 + k) * mpmath.pi / stretch**2
    depths, loads = curve["asymptotic_indentation"], curve["asymptotic_load"]
    for radius, depth, load in zip(curve["asymptotic_contact_radius"][1::13], depths[1::13], loads[1::13], strict=True):
        a = mpmath.mpf(radius)
        angle = 2 * mpmath.pi * a / wavelength - k * mpmath.pi / 4 - mpmath.pi / 4
        zeta = (2 * mpmath.pi) ** ((1 - k) / 2) * amplitude * mpmath.sin(angle)
        wave = 2 ** ((k - 1) / 2) * mpmath.gamma((1 + k) / 2) * wavelength ** ((1 + k) / 2) * zeta
        paraboloid, pull = a * a / (1 + k), stretch * a ** ((1 - k) / 2)
        expected = paraboloid - pull + wavelength * amplitude + a ** ((1 - k) / 2) * wave
        assert abs(depth - expected) <= 1e-13 * np.ptp(depths)  # of a phase of seventy turns
        hertz = 2 * a ** (3 + k) / ((1 + k) * (3 + k))
        expected = front * (hertz - a ** (1 + k) * pull + a ** ((3 + k) / 2) * wave) / (1.5 * mpmath.pi)
        assert abs(load - expected) <= 1e-13 * np.ptp(loads)


def test_chords_are_within_the_contract(any_subject: Subject, worst_chord: Callable[..., float]) -> None:
    curve = draw_asymptotic(any_subject)
    assert curve is not None
    depths = curve["asymptotic_indentation"]
    if np.ptp(depths) > 1e-12 * np.abs(depths).max():  # of a wave far longer than the punch its mean height is all
        assert worst_chord(_form(any_subject), tuple(curve.values())) <= 2e-4


def test_turns_are_points(scene: dict[str, float]) -> None:
    subject = subject_of(scene)
    assert subject is not None
    curve, form = draw_asymptotic(subject), _form(subject)
    assert curve is not None
    dense = np.zeros((3, 100_001))
    dense[0] = np.linspace(0.0, subject.end / form.radius_scale, dense.shape[1])
    fill_points(form.table, form.numbers, dense)
    for values, scan in (("asymptotic_indentation", dense[1]), ("asymptotic_load", dense[2])):
        turns = np.count_nonzero(np.diff(np.sign(np.diff(curve[values]))))
        assert turns == np.count_nonzero(np.diff(np.sign(np.diff(scan)))) > 5


def test_short_waves_come_to_the_exact_curve(scene: dict[str, float]) -> None:
    """At one chi and radius the error of the depth, in waves of the depth, falls as lambda."""
    k, errors = scene["k"], []
    for wavelength in (0.02, 0.01, 0.005):
        changed = scene | {"lambda_over_R": wavelength, "A": 0.002 * wavelength ** (-0.5 * (1 + k))}
        subject = subject_of(changed)
        assert subject is not None
        short, exact = _form(subject), subject.exact
        radii = np.linspace(0.3, 0.4, 501)
        values = []
        for form in (short, exact):
            points = np.zeros((3, radii.size))
            points[0] = radii / form.radius_scale
            fill_points(form.table, form.numbers, points)
            values.append(points[1] * form.depth_scale)
        height = subject.chi * subject.stretch * 0.35 ** (0.5 * (1 - k))
        errors.append(np.abs(values[0] - values[1]).max() / height)
    assert errors[0] < 0.02
    assert errors[1] / errors[0] == pytest.approx(0.5, rel=0.1)
    assert errors[2] / errors[1] == pytest.approx(0.5, rel=0.1)


def test_without_waves_it_is_the_smooth_curve(scene: dict[str, float]) -> None:
    subject = subject_of(scene | {"A": 0.0})
    assert subject is not None
    curve = draw_asymptotic(subject)
    assert curve is not None
    for one, other in zip(curve.values(), draw_smooth(subject).values(), strict=True):
        assert np.array_equal(one, other)


def test_too_many_waves_are_none(scene: dict[str, float]) -> None:
    subject = subject_of(scene | {"lambda_over_R": 1e-6, "A": 1.0})
    assert subject is not None
    assert draw_asymptotic(subject) is None


def test_branches_of_both_curves_are_neighbours(scene: dict[str, float]) -> None:
    """Far out, the asymptotic folds of depth are those of the exact curve to a small part of a wave."""
    subject = subject_of(scene | {"lambda_over_R": 0.005, "A": 0.06})
    assert subject is not None
    assert subject.trace is not None
    curve = draw_asymptotic(subject)
    assert curve is not None
    depth, radius = curve["asymptotic_indentation"], curve["asymptotic_contact_radius"]
    turns = radius[1:-1][np.diff(np.sign(np.diff(depth))) != 0] / subject.wavelength
    exact = np.sort(subject.trace[[START, END]].ravel())
    exact = exact[(exact > 20) & (exact < 0.99 * subject.rim / subject.wavelength)]
    assert exact.size > 50
    gap = np.abs(exact[:, None] - turns).min(axis=1)
    assert gap.max() <= 0.01
    assert math.isfinite(depth.max())


def test_another_profile_has_its_own(scene: dict[str, float]) -> None:
    """The equation of any punch (5.15), (5.16), and the folds of both depth and load as points."""
    curve, status = draw_curves(scene, ["asymptotic"], TWO)
    assert status == 0
    k, wavelength, A = (scene[name] for name in ("k", "lambda_over_R", "A"))
    M = float(stiffness(*(scene[name] for name in ("k", "nu", "modulus", "c0_over_R"))))
    radius, depth, load = curve.values()
    cosines, sines = [-A, 0.0, -0.1 * A], [0.0, 0.0, -0.2 * A]
    for found, function in ((depth, short_waves.indentation), (load, short_waves.load)):
        expected = function(k, M, radius[1:], wavelength, cosines, sines, exponent=3.0)
        assert np.abs(found[1:] - expected).max() <= 1e-12 * np.ptp(found)
    assert depth[0] == pytest.approx(1.1 * A * wavelength)
    assert load[0] == 0.0
    dense = np.linspace(1e-3 * scene["a_max_over_R"], scene["a_max_over_R"], 100_001)
    for found, function in ((depth, short_waves.indentation), (load, short_waves.load)):
        scan = function(k, M, dense, wavelength, cosines, sines, exponent=3.0)
        assert found.max() == pytest.approx(scan.max(), abs=1e-7 * np.ptp(scan))
        assert found.min() == pytest.approx(min(scan.min(), found[0]), abs=1e-7 * np.ptp(scan))


def test_a_profile_that_is_the_default_has_the_same(scene: dict[str, float]) -> None:
    """A third of the wavelength, three times A: one curve; the same points but for rounding of lengths."""
    third = Profile(harmonics=(Harmonic(n=3, cos=0.7),))
    one, _ = draw_curves(scene, ["asymptotic"], third)
    own = scene | {"lambda_over_R": scene["lambda_over_R"] / 3, "A": 3 * 0.7 * scene["A"]}
    for name, values in draw_curves(own, ["asymptotic"])[0].items():
        np.testing.assert_allclose(one[name], values, rtol=1e-9, atol=1e-12 * np.ptp(values))


def test_without_waves_any_punch_is_its_smooth_one(scene: dict[str, float]) -> None:
    subject = general_curves.subject_of(scene | {"A": 0.0}, TWO, Loading())
    assert subject is not None
    drawn = drawing.draw_asymptotic(subject, TWO)
    assert drawn is not None
    for one, other in zip(drawn.values(), general_curves.draw_smooth(subject).values(), strict=True):
        assert np.array_equal(one, other)
