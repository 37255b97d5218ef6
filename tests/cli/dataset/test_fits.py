"""What a dataset has of a fit beyond its values, and what `info` says of it; nothing is fitted here."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset.fits import dataset_of
from gradhesion.cli.dataset.read.reader import opened
from gradhesion.cli.dataset.select import write_dataset
from gradhesion.cli.names.fits import FIT_MORE
from gradhesion.cli.study.fit.study import FitStudy
from gradhesion.cli.work.solve.fitting import Fit
from gradhesion.core.loops.fitted import FittedLoop, OtherMinimum
from gradhesion.core.loops.measured.features import ContactPoint
from gradhesion.core.problem.status import ANOTHER_MINIMUM, NO_VALUE, POOR_FIT

Call = Callable[..., Result]
CONFIGS = Path(__file__).parents[3] / "configs"


@pytest.fixture(scope="module")
def study() -> FitStudy:
    """The example, with a tilt, and its zero of depth at the contact point."""
    found = gr.load(CONFIGS / "fit.toml", set={"fit.offsets": {"indentation": "contact", "slope": True}})
    assert isinstance(found, FitStudy)
    return found


def fit(study: FitStudy, **changes: Any) -> Fit:
    """A fit of the loop of a study, with made-up numbers."""
    names = study.parameters
    values = dict.fromkeys(names, 1.0) | {"E_star": 1e7, "work_of_adhesion": 0.03, "A": 0.01, "wavelength": 5e-7}
    count = study.loop.depth.size
    found = FittedLoop(
        names=names,
        values=values,
        standard_deviations={name: 0.01 * value for name, value in values.items()},
        low={name: 0.98 * value for name, value in values.items()},
        high={name: 1.02 * value for name, value in values.items()},
        ranges={name: (0.1 * value, 10.0 * value) for name, value in values.items()},
        correlation=np.eye(len(names)),
        on_bound=(),
        chi_square=2.25 * (count - len(names)),
        degrees_of_freedom=count - len(names),
        residual=np.zeros(count),
        loading=np.zeros((3, 2)),
        unloading=np.zeros((2, 2)),
        converged=True,
        status=POOR_FIT | ANOTHER_MINIMUM,
        others=tuple(OtherMinimum(values=values | {"A": 0.02 + 0.01 * i}, chi_square=1400.0 + i) for i in range(2)),
        alike=("waves too fine to be seen would have the same effect",),
        contact=ContactPoint(depth=2e-9, deviation=1e-10, method="the end of the base line"),
        turning_radius=0.1,
        widening=1.5,
    )
    return Fit(loop=study.loop, found=replace(found, **changes))


def write(study: FitStudy, fits: list[Fit], path: Path) -> None:
    """Write made-up fits."""
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
    for words in (
        "contact point: 2 +- 0.1 nm",
        "widened by 1.5",
        "poor fit",
        "chi square 1400",
        "waves too fine",
        "Tabor",
    ):
        assert words in told, words


def test_a_file_of_version_0_2_is_read(study: FitStudy, tmp_path: Path, gradhesion: Call) -> None:
    path = tmp_path / "old.nc"
    sound = dataset_of(study, [fit(study, others=(), contact=None)], "made by a test")
    noise = {name: float(sound[name]) for name in ("noise_of_indentation", "noise_of_load")}
    sound.drop_vars([name for name in FIT_MORE if name in sound]).assign_attrs(noise).to_netcdf(path)
    told = gradhesion("info", path).stdout
    assert "0.25 nm and 7 nN, given" in told
    assert "reduced 2.25" in told
    assert gradhesion("plot", path).exit_code == 0


def test_side_by_side_minima_are_padded_and_flagged_loops_count_in_no_median(
    study: FitStudy, tmp_path: Path, gradhesion: Call
) -> None:
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
    sound, poor = tmp_path / "sound.nc", tmp_path / "poor.nc"
    write(study, [fit(study, others=(), status=0)], sound)
    write(study, [fit(study)], poor)
    scene = tmp_path / "scene.toml"
    scene.write_text(
        'outputs = ["pull_off_force"]\n[parameters]\nk = 0.0\nnu = 0.3\n[physical]\nR = "5 um"\na_max = "1 um"\n'
    )
    keys = ("physical.E_star", "physical.work_of_adhesion", "physical.wavelength", "parameters.A")
    sets = [f"--set={key}={sound}" for key in keys]
    assert gradhesion("run", scene, "-o", tmp_path / "scene.nc", *sets).exit_code == 0
    with opened(tmp_path / "scene.nc") as found:
        values = [found[name].item() for name in ("E_star", "work_of_adhesion", "wavelength", "A")]
        assert values == [1e7, 0.03, 5e-7, 0.01]
        assert 'E_star = "10000000.0 Pa"' in found.attrs["study"]
    for key, file in (
        ("R", sound),
        ("E_star", poor),
        ("E_star", tmp_path / "scene.nc"),
        ("E_star", tmp_path / "no.nc"),
    ):
        result = gradhesion("validate", scene, *sets[1:], f"--set=physical.{key}={file}")
        assert result.exit_code == 2
        assert f"physical.{key}" in result.stderr
