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


@pytest.mark.parametrize("kind", ["smooth", "wavy", "wavy+works", "smooth+works+tilt+retract"])
def test_points_lie_about_the_path_as_far_as_noise_has_them(loops: Any, kind: str) -> None:
    for number in range(3):
        loop, again = (loops.draw_loop(5, number, kind) for _ in range(2))
        count = loop.depth.size
        assert abs(loop.chi_square() / count - 1.0) < 6.0 * np.sqrt(2.0 / count)
        assert (loop.number, loop.kind) == (number, kind)
        assert np.array_equal([loop.depth, loop.load], [again.depth, again.load])
    assert loop.true != loops.draw_loop(5, 0, kind).true


def test_ranges_are_wide_and_nowhere_centred(loops: Any) -> None:
    places = []
    for number in range(6):
        loop = loops.draw_loop(6, number, "wavy")
        for name, decades in loops.DECADES.items():
            low, high = loop.free[name]
            assert np.log10(high / low) == pytest.approx(decades)
            places.append(np.log10(loop.true[name] / low) / decades)
    assert 0.09 < min(places) < max(places) < 0.91
    assert np.std(places) > 0.1


def test_words_change_what_they_say(loops: Any) -> None:
    plain, drifting, approach = (loops.draw_loop(5, 0, f"smooth{word}") for word in ("", "+drift", "+approach"))
    assert plain.depth.size == loops.POINTS > approach.depth.size > 0
    assert not approach.unloading.any()
    assert plain.noise[1] / loops.NOISE == pytest.approx(plain.true["load_offset"] - plain.load.min(), rel=0.1)
    line = plain.depth < plain.depth.min() + 0.3 * (plain.true["indentation_offset"] - plain.depth.min())
    assert np.std(plain.load[line]) == pytest.approx(plain.noise[1], rel=0.5)
    assert drifting.chi_square() > plain.chi_square()
    with pytest.raises(ValueError, match="'rough' is none of smooth, wavy"):
        loops.draw_loop(5, 0, "rough")
