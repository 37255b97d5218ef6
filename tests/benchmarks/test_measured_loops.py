"""Drawn loops are what their page says: the same for the same number, noise about the exact path, zeros far off."""

import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest


@pytest.fixture
def loops(root: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(root)
    return importlib.import_module("benchmarks.measured_loops")


@pytest.mark.parametrize("kind", ["smooth", "wavy", "wavy+works", "smooth+works+tilt+pauses+retract"])
def test_points_lie_about_the_path_as_far_as_noise_has_them(loops: Any, kind: str) -> None:
    for number in range(3):
        loop = loops.draw_loop(5, number, kind)
        count = loop.used[0].size
        assert abs(loop.chi_square() / count - 1.0) < 6.0 * np.sqrt(2.0 / count)
        assert (loop.number, loop.kind) == (number, kind)


def test_a_loop_is_given_by_its_number(loops: Any) -> None:
    first, again, other = (loops.draw_loop(5, number, "smooth") for number in (1, 1, 2))
    assert np.array_equal(first.depth, again.depth)
    assert np.array_equal(first.load, again.load)
    assert first.true != other.true


def test_ranges_are_wide_and_nowhere_centred(loops: Any) -> None:
    places = []
    for number in range(6):
        loop = loops.draw_loop(6, number, "wavy")
        for name, decades in (("E_star", 2.0), ("work_of_adhesion", 2.0), ("wavelength", 1.0), ("A", 1.0)):
            low, high = loop.free[name]
            assert np.log10(high / low) == pytest.approx(decades)
            places.append(np.log10(loop.true[name] / low) / decades)
    assert min(places) > 0.09
    assert max(places) < 0.91
    assert np.std(places) > 0.1


def test_words_change_what_they_say(loops: Any) -> None:
    plain, paused, approach = (loops.draw_loop(5, 0, kind) for kind in ("smooth", "smooth+pauses", "smooth+approach"))
    assert plain.depth.size == loops.POINTS
    assert not plain.pause.any()
    assert paused.used[0].size == loops.POINTS
    assert paused.pause.any()
    assert not approach.unloading.any()
    assert 0 < approach.depth.size < loops.POINTS
    pull_off = plain.load.min() - plain.true["load_offset"]
    assert plain.noise[1] / loops.NOISE == pytest.approx(-pull_off, rel=0.1)
    base_line = plain.load[
        plain.depth < plain.depth.min() + 0.3 * (plain.true["indentation_offset"] - plain.depth.min())
    ]
    drifting = loops.draw_loop(5, 0, "smooth+drift")
    assert np.std(base_line) == pytest.approx(plain.noise[1], rel=0.5)
    assert drifting.chi_square() > plain.chi_square()


def test_an_unknown_word_is_refused(loops: Any) -> None:
    with pytest.raises(ValueError, match="'rough' is none of smooth, wavy"):
        loops.draw_loop(5, 0, "rough")
