"""The curve of the smooth punch: closed forms, and its turns."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core.curves.smooth import draw_smooth, turns_of
from gradhesion.core.curves.subject import Subject, subject_of


def test_points_lie_on_the_curve(scene: dict[str, float], slow_curve: Callable[..., Any]) -> None:
    subject, slow = subject_of(scene), slow_curve(scene | {"A": 0.0})
    assert subject is not None
    curve = draw_smooth(subject)
    for a, depth, load in zip(
        *(curve[f"smooth_{name}"][::9] for name in ("contact_radius", "indentation", "load")), strict=True
    ):
        assert abs(depth - slow.depth(a)) <= 1e-14 * np.ptp(curve["smooth_indentation"])
        assert abs(load - slow.load(a)) <= 1e-14 * np.ptp(curve["smooth_load"])


def test_chords_are_within_the_contract(any_subject: Subject, worst_chord: Callable[..., float]) -> None:
    curve = draw_smooth(any_subject)
    assert worst_chord(any_subject.plain(1.0), tuple(curve.values())) <= 2e-4
    assert curve["smooth_contact_radius"].size <= 150


def test_the_pull_off_is_met_exactly(any_subject: Subject) -> None:
    """(3+k)/3 in units of 1.5 pi R dgamma, at the radius a_1 [(3+k)/4]^(2/(3+k)), if the punch reaches there."""
    k = any_subject.k
    a = ((1 + k) * any_subject.stretch * 0.25 * (3 + k)) ** (2 / (3 + k))
    if a > any_subject.end:
        return
    curve = draw_smooth(any_subject)
    assert curve["smooth_load"].min() == pytest.approx(-(3 + k) / 3, rel=1e-14)
    assert np.abs(curve["smooth_contact_radius"] / a - 1).min() <= 1e-14


def test_zero_depth_is_a_point(scene: dict[str, float]) -> None:
    subject = subject_of(scene)
    assert subject is not None
    a = ((1 + subject.k) * subject.stretch) ** (2 / (3 + subject.k))
    curve = draw_smooth(subject)
    nearest = int(np.abs(curve["smooth_contact_radius"] - a).argmin())
    assert curve["smooth_contact_radius"][nearest] == pytest.approx(a, rel=1e-14)
    assert abs(curve["smooth_indentation"][nearest]) <= 1e-14 * a * a


def test_places_of_several_pulls() -> None:
    """At k = 1, X = z^2: pulls of 0.5 and 2 turn at X = 0, X = 2 pull (load), and are at zero depth there as well."""
    assert turns_of(1.0).places((0.5, 2.0), 9.0) == pytest.approx([1.0, 2.0])
    assert turns_of(1.0).places((0.5, 2.0), 1.5) == pytest.approx([1.0])
    assert turns_of(0.3).places((-0.5, 0.0), 9.0).size == 0
    # k = 0: X = z^(3/2) is pull/2, 3 pull/2 and 2 pull
    assert turns_of(0.0).places((1.0,), 9.0) ** 1.5 == pytest.approx([0.5, 1.5, 2.0])
