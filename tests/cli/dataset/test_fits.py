"""What a dataset has of a fit beyond its values, what `info` and a run say of it, and why it may be doubted; nothing is fitted here."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gradhesion as gr
from gradhesion.cli.dataset.fits import cautions_of_fit, dataset_of
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.dataset.select import write_dataset
from gradhesion.cli.names.fits import FIT_MORE
from gradhesion.cli.study import load_study
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.words.fit_words import doubts_of
from gradhesion.cli.work.solve.fitting import Fit
from gradhesion.core.loops.fitted import FittedLoop, OtherMinimum
from gradhesion.core.loops.measured.features import BaseLine, ContactPoint
from gradhesion.core.problem.status import ANOTHER_MINIMUM, NO_VALUE, POOR_FIT
from tests.cli.conftest import Call
from tests.conftest import ROOT

EXAMPLE = ROOT / "configs" / "fit.toml"


@pytest.fixture(scope="module")
def study() -> FitStudy:
    """The example, with a tilt, and its zero of depth at the contact point."""
    return gr.load(EXAMPLE, set={"fit.offsets": {"indentation": "contact", "slope": True}})


def made_up(values: dict[str, float], degrees: int = 200, /, **changes: Any) -> FittedLoop:
    """A sound fit with made-up numbers, some of it changed."""
    sound = FittedLoop(
        names=tuple(values),
        values=values,
        standard_deviations={name: 0.01 * value for name, value in values.items()},
        low={name: 0.98 * value for name, value in values.items()},
        high={name: 1.02 * value for name, value in values.items()},
        ranges={name: (0.1 * value, 10.0 * value) for name, value in values.items()},
        correlation=np.eye(len(values)),
        on_bound=(),
        chi_square=1.05 * degrees,
        degrees_of_freedom=degrees,
        residual=np.zeros(degrees + len(values)),
        loading=np.zeros((3, 2)),
        unloading=np.zeros((2, 2)),
        converged=True,
        status=0,
        turning_radius=0.1,
    )
    return replace(sound, **changes)


def fit(study: FitStudy, **changes: Any) -> Fit:
    """A poor fit of the loop of a study beside two other minima, some of it changed."""
    values = dict.fromkeys(study.parameters, 1.0)
    values |= {"E_star": 1e7, "work_of_adhesion": 0.03, "A": 0.01, "wavelength": 5e-7}
    degrees = study.loop.depth.size - len(values)
    poor = {
        "chi_square": 2.25 * degrees,
        "status": POOR_FIT | ANOTHER_MINIMUM,
        "others": tuple(OtherMinimum(values=values | {"A": 0.02 + 0.01 * i}, chi_square=1400.0 + i) for i in range(2)),
        "alike": ("waves too fine to be seen would have the same effect",),
        "contact": ContactPoint(depth=2e-9, deviation=1e-10, method="the end of the base line"),
        "widening": 1.5,
    }
    return Fit(loop=study.loop, found=made_up(values, degrees, **(poor | changes)))


def write(study: FitStudy, fits: list[Fit], path: Path) -> None:
    write_dataset(dataset_of(study, fits, "made by a test"), path, overwrite=False)


def test_a_dataset_has_minima_ranges_and_the_contact_point(study: FitStudy, tmp_path: Path, gradhesion: Call) -> None:
    path = tmp_path / "one.nc"
    write(study, [fit(study)], path)
    with opened(path) as dataset:
        assert dataset["parameter"].values.tolist()[-1] == "load_slope"
        assert dataset["parameter_units"].values.tolist()[-1] == "N/m"
        assert dataset["minimum_value"].dims == ("minimum", "parameter")
        assert dataset["minimum_value"].values[:, 3].tolist() == [0.02, 0.03]
        assert dataset["minimum_chi_square"].values.tolist() == [1400.0, 1401.0]
        assert [float(dataset[name]) for name in ("contact_depth", "interval_widening")] == [2e-9, 1.5]
        assert float(dataset["high_searched"][0]) == 1e8
        assert dataset["contact_depth_deviation"].attrs["units"] == "m"
        assert dataset.attrs["contact_point"] == "the end of the base line"
        flags = dataset["status"].attrs
        masks = dict(zip(flags["flag_meanings"].split(), flags["flag_masks"], strict=True))
        assert (masks["poor_fit"], masks["another_minimum"]) == (2048, 4096)
    told = gradhesion("info", path).stdout
    words = ("contact point: 2 +- 0.1 nm", "widened by 1.5", "poor fit", "chi square 1400", "waves too fine", "Tabor")
    assert [one for one in words if one not in told] == []


def test_a_file_of_version_0_2_is_read(study: FitStudy, tmp_path: Path, gradhesion: Call) -> None:
    path = tmp_path / "old.nc"
    sound = dataset_of(study, [fit(study, others=(), contact=None)], "made by a test")
    noise = {name: float(sound[name]) for name in ("noise_of_indentation", "noise_of_load")}
    sound.drop_vars([name for name in FIT_MORE if name in sound]).assign_attrs(noise).to_netcdf(path)
    told = gradhesion("info", path).stdout
    assert "0.25 nm and 7 nN, given" in told
    assert "reduced 2.25" in told
    assert gradhesion("plot", path).exit_code == 0


def test_minima_are_padded_and_no_median_has_flagged_loops(study: FitStudy, tmp_path: Path, gradhesion: Call) -> None:
    several = replace(study, loops=(study.loop, study.loop, study.loop), file="*.csv")
    sound = fit(study, others=(), alike=(), status=0, chi_square=500.0)
    write(several, [sound, fit(study), Fit(loop=study.loop, problem="it has no path")], tmp_path / "all.nc")
    with opened(tmp_path / "all.nc") as dataset:
        assert dataset["minimum_chi_square"].dims == ("loop", "minimum")
        np.testing.assert_array_equal(np.isnan(dataset["minimum_chi_square"]), [[True] * 2, [False] * 2, [True] * 2])
        assert dataset["status"].values.tolist() == [0, POOR_FIT | ANOTHER_MINIMUM, NO_VALUE]
    told = gradhesion("info", tmp_path / "all.nc").stdout.splitlines()
    assert not any("+-" in line for line in told), "what stands beside 95 % is an interval"
    median = next(i for i, line in enumerate(told) if line.startswith("median of 1 loop")) + 1
    assert told[median].split() == ["E_star", "1e+07", "1e+07", "to", "1e+07"], "not of the loop that is flagged"


def test_a_fitted_value_is_taken_for_a_key(study: FitStudy, tmp_path: Path, gradhesion: Call) -> None:
    sound, poor, at_an_end = (tmp_path / f"{name}.nc" for name in ("sound", "poor", "at_an_end"))
    write(study, [fit(study, others=(), status=0)], sound)
    write(study, [fit(study)], poor)
    write(study, [fit(study, others=(), status=0, on_bound=("A",))], at_an_end)
    scene = tmp_path / "scene.toml"
    scene.write_text('outputs = ["pull_off_force"]\nparameters = {k=0, nu=0.3}\nphysical = {R="5 um", a_max="1 um"}')
    keys = ("physical.E_star", "physical.work_of_adhesion", "physical.wavelength", "parameters.A")
    sets = [f"--set={key}={sound}" for key in keys]
    assert gradhesion("run", scene, "-o", tmp_path / "scene.nc", *sets).exit_code == 0
    with opened(tmp_path / "scene.nc") as found:
        values = [found[name].item() for name in ("E_star", "work_of_adhesion", "wavelength", "A")]
        assert values == [1e7, 0.03, 5e-7, 0.01]
        assert 'E_star = "10000000.0 Pa"' in found.attrs["study"]
    uncertain = load_study(scene, [*(one.removeprefix("--set=") for one in sets), f"uncertainty.E_star={sound}"])
    assert uncertain.uncertainty.deviations["E_star"].deviation == 1e5
    for file in (sound, poor, at_an_end, tmp_path / "scene.nc", tmp_path / "no.nc"):
        key = "physical.R" if file == sound else "physical.E_star"
        assert key in gradhesion("validate", scene, *sets[1:], f"--set={key}={file}", code=2).stderr


DOUBTS: list[tuple[dict[str, Any], list[str]]] = [
    ({}, []),
    ({"converged": False}, ["starts"]),
    ({"chi_square": 4.5, "status": POOR_FIT}, ["4.5"]),
    ({"chi_square": 450.0, "status": POOR_FIT}, ["signs of depth and load"]),
    ({"others": ..., "status": ANOTHER_MINIMUM}, ["chi square 1400 at E_star = 1e+07", "chi square 1401 at E_star"]),
    ({"on_bound": ("E_star",)}, ["E_star is at an end of its range of 1e+06 to 1e+08"]),
    ({"on_bound": ("load_offset", "E_star")}, ["E_star", "offsets under [fit]"]),
    ({"on_bound": ("closing_ratio",)}, ["leave closing_ratio out"]),
]  # fmt: skip
"""What is changed, chi square for each degree of freedom, and words of what is said: a sentence each."""


@pytest.mark.parametrize(("changes", "words"), DOUBTS)
def test_each_is_a_sentence_with_numbers_and_what_to_do(
    changes: dict[str, Any], words: list[str], study: FitStudy
) -> None:
    study = replace(study, free=study.free | {"closing_ratio": (0.2, 1.0)})
    changes = {"others": (), "alike": (), "status": 0, "chi_square": 1.05} | changes
    changes["chi_square"] *= study.loop.depth.size - len(study.parameters)
    one = fit(study, **{name: value for name, value in changes.items() if value is not ...})
    said = list(doubts_of(dataset_of(study, [one], "made by a test")))
    assert len(said) == len(words)
    assert all(word in sentence for word, sentence in zip(words, said, strict=True))


VALUES = {"E_star": 2e6, "work_of_adhesion": 0.02, "load_offset": 1e-9}
TILT = {"slope": 1e-3, "slope_deviation": 1e-4}
CAUTIONS: list[tuple[dict[str, Any], float, dict[str, Any], list[str]]] = [
    (TILT, 1.0, {}, ["10 standard deviations"]),
    (TILT | {"slope": -1e-3}, 1.0, {}, ["10 standard deviations"]),
    (TILT | {"slope": 5e-4}, 1.0, {}, []),
    (TILT, 1.0, {"names": (*VALUES, "load_slope"), "values": VALUES | {"load_slope": 1e-3}}, []),
    ({}, 30.0, {}, ["is below 5"]),
    ({}, 1000.0, {}, ["is below 0.1"]),
    ({}, 1.0, {"turning_radius": 1.5}, ["a = 1.5 R"]),
    ({}, 1.0, {"alike": ("it may be another",)}, ["it may be another"]),
]
"""The base line, the range of the attraction in nm, what else is changed, and words of what is said."""


@pytest.mark.parametrize(("line", "reach", "changes", "words"), CAUTIONS)
def test_cautions_have_reasons(line: dict[str, float], reach: float, changes: dict[str, Any], words: list[str]) -> None:
    study = gr.load(EXAMPLE, set={"physical.adhesion_range": f"{reach} nm"})
    base = BaseLine(level=0.0, spread=1e-9, ends=(0.0, 0.0), **line) if line else None
    study = replace(study, free={}, fixed=study.fixed | {"A": 0.0})
    said = list(cautions_of_fit(study, made_up(VALUES, base_line=base, **changes)))
    assert len(said) == len(words), said
    assert all(word in sentence for word, sentence in zip(words, said, strict=True))
