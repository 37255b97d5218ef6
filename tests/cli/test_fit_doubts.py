"""Why a fit is not to be trusted, in sentences; nothing is fitted here."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gradhesion.cli.dataset.fits.cautions import tilt_warnings
from gradhesion.cli.dataset.read.model_range import tabor_warnings
from gradhesion.cli.work.solve.fitting import doubts_of
from gradhesion.core.loops.fitted import FittedLoop, OtherMinimum
from gradhesion.core.loops.measured.features import BaseLine
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT

NAMES = ("E_star", "work_of_adhesion", "load_offset")
VALUES = {"E_star": 2e6, "work_of_adhesion": 0.02, "load_offset": 1e-9}


def fit(**changes: Any) -> FittedLoop:
    """A sound fit, with some of it changed."""
    sound = FittedLoop(
        names=NAMES,
        values=VALUES,
        standard_deviations={name: 0.01 * value for name, value in VALUES.items()},
        low={name: 0.98 * value for name, value in VALUES.items()},
        high={name: 1.02 * value for name, value in VALUES.items()},
        ranges={"E_star": (1e6, 1e8), "work_of_adhesion": (5e-3, 0.2), "load_offset": (-1e-8, 1e-8)},
        correlation=np.eye(3),
        on_bound=(),
        chi_square=210.0,
        degrees_of_freedom=200,
        residual=np.zeros(203),
        loading=np.zeros((2, 2)),
        unloading=np.zeros((2, 2)),
        converged=True,
        status=0,
    )
    return replace(sound, **changes)


def said(**changes: Any) -> str:
    """The one sentence against a fit."""
    (sentence,) = doubts_of(fit(**changes))
    return sentence


def test_a_sound_fit_has_none() -> None:
    assert not list(doubts_of(fit()))


OTHER = OtherMinimum(values=VALUES | {"E_star": 4e6}, chi_square=212.5)
ENDS = {
    "E_star": ({}, "E_star is at an end of its range (2e+06 of 1e+06 to 1e+08); widen the range, or give it as a number"),
    "load_offset": ({}, "widen it with offsets under [fit]"),
    "work_of_adhesion": ({"values": VALUES | {"work_of_adhesion": 5e-3}}, "or the data show no adhesion"),
    "closing_ratio": ({"values": {"closing_ratio": 1.0}, "ranges": {"closing_ratio": (0.2, 1.0)}}, "leave closing_ratio out"),
}  # fmt: skip
DOUBTS = [
    ({"converged": False}, "did not converge"),
    ({"chi_square": 900.0, "status": POOR_FIT}, "reduced chi square 4.5, where 2 is the most"),
    ({"chi_square": 9e4, "status": POOR_FIT}, "check the signs of depth and load"),
    ({"others": (OTHER,), "status": ANOTHER_MINIMUM}, "chi square 212.5 at E_star = 4e+06, work_of_adhesion = 0.02, load_offset = 1e-09, beside 210 at E_star"),
    *(({"on_bound": (name,)} | more, words) for name, (more, words) in ENDS.items()),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "words"), DOUBTS)
def test_each_is_a_sentence_with_numbers_and_what_to_do(changes: dict[str, Any], words: str) -> None:
    assert words in said(**changes)
    assert "signs" in words or "signs" not in said(**changes)
    assert "no adhesion" not in said(on_bound=("work_of_adhesion",), values=VALUES | {"work_of_adhesion": 0.2})


@pytest.mark.parametrize(("slope", "names", "is_said"), [
    (1e-3, NAMES, True), (-1e-3, NAMES, True), (5e-4, NAMES, False), (1e-3, (*NAMES, "load_slope"), False)])  # fmt: skip
def test_a_tilted_base_line_is_said_unless_its_tilt_is_fitted(
    slope: float, names: tuple[str, ...], is_said: bool
) -> None:
    line = BaseLine(level=0.0, spread=1e-9, slope=slope, slope_deviation=1e-4, ends=(0.0, 0.0))
    found = list(tilt_warnings(fit(base_line=line, names=names)))
    assert len(found) == is_said
    if is_said:
        assert found[0].endswith("10 standard deviations: write offsets = { slope = true } under [fit]")
    assert not list(tilt_warnings(fit()))


@pytest.mark.parametrize(("number", "words"), [(6.0, ""), (4.0, "is below 5: "), (0.09, "is below 0.1: ")])
def test_a_small_tabor_parameter_is_said(number: float, words: str) -> None:
    told = list(tabor_warnings(number, "with a range of 0.3 nm"))
    assert len(told) == bool(words)
    assert all(words in one for one in told)
