"""Why a fit is not to be trusted, in sentences; nothing is fitted here."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import gradhesion as gr
from gradhesion.cli.dataset.fits import cautions_of_fit
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.work.solve.fitting import doubts_of
from gradhesion.core.loops.fitted import FittedLoop, OtherMinimum
from gradhesion.core.loops.measured.features import BaseLine
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT
from tests.conftest import ROOT

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
        turning_radius=0.1,
    )
    return replace(sound, **changes)


OTHER = OtherMinimum(values=VALUES | {"E_star": 4e6}, chi_square=212.5)
DOUBTS: list[tuple[dict[str, Any], list[str]]] = [
    ({}, []),
    ({"converged": False}, ["starts"]),
    ({"chi_square": 900.0, "status": POOR_FIT}, ["4.5"]),
    ({"chi_square": 9e4, "status": POOR_FIT}, ["signs of depth and load"]),
    ({"others": (OTHER,), "status": ANOTHER_MINIMUM}, ["chi square 212.5 at E_star = 4e+06"]),
    ({"on_bound": ("E_star",)}, ["E_star is at an end of its range (2e+06 of 1e+06 to 1e+08)"]),
    ({"on_bound": ("load_offset", "E_star")}, ["offsets under [fit]", "E_star"]),
    ({"on_bound": ("closing_ratio",), "values": {"closing_ratio": 1.0}, "ranges": {"closing_ratio": (0.2, 1.0)}}, ["leave closing_ratio out"]),
]  # fmt: skip
"""What is changed, and words of what is said: a sentence each."""


@pytest.mark.parametrize(("changes", "words"), DOUBTS)
def test_each_is_a_sentence_with_numbers_and_what_to_do(changes: dict[str, Any], words: list[str]) -> None:
    said = list(doubts_of(fit(**changes)))
    assert len(said) == len(words)
    assert all(word in sentence for word, sentence in zip(words, said, strict=True))


TILT = {"slope": 1e-3, "slope_deviation": 1e-4}
CAUTIONS: list[tuple[dict[str, Any], float, dict[str, Any], list[str]]] = [
    (TILT, 1.0, {}, ["10 standard deviations"]),
    (TILT | {"slope": -1e-3}, 1.0, {}, ["10 standard deviations"]),
    (TILT | {"slope": 5e-4}, 1.0, {}, []),
    (TILT, 1.0, {"names": (*NAMES, "load_slope"), "values": VALUES | {"load_slope": 1e-3}}, []),
    ({}, 30.0, {}, ["is below 5"]),
    ({}, 1000.0, {}, ["is below 0.1"]),
    ({}, 1.0, {"turning_radius": 1.5}, ["a = 1.5 R"]),
    ({}, 1.0, {"alike": ("it may be another",)}, ["it may be another"]),
]
"""The base line, the range of the attraction in nm, what else is changed, and words of what is said."""


@pytest.mark.parametrize(("line", "reach", "changes", "words"), CAUTIONS)
def test_cautions_are_said_where_there_is_a_reason(
    line: dict[str, float], reach: float, changes: dict[str, Any], words: list[str]
) -> None:
    study = gr.load(ROOT / "configs" / "fit.toml", set={"physical.adhesion_range": f"{reach} nm"})
    assert isinstance(study, FitStudy)
    base = BaseLine(level=0.0, spread=1e-9, ends=(0.0, 0.0), **line) if line else None
    study = replace(study, free={}, fixed=study.fixed | {"A": 0.0})
    said = list(cautions_of_fit(study, fit(base_line=base, **changes)))
    assert len(said) == len(words), said
    assert all(word in sentence for word, sentence in zip(words, said, strict=True))
