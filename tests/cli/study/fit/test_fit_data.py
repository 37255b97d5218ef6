"""What a fit takes for data: branches by any name, one of them, pauses, several files, many points, and wrong ones."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gradhesion as gr
from gradhesion.core.loops.measured.points import MOST
from tests.cli.conftest import BALL, COLUMNS, WORK, Call, Patch
from tests.conftest import mistakes

STUDY = f"""
kind = "fit"
[data]
file = "loop.csv"
{COLUMNS}{BALL}{WORK}"""
DEPTH, FORCE = {"column": "depth", "unit": "nm"}, {"column": "force", "unit": "nN"}
OFFSETS: dict[str, tuple[Any, tuple[Any, Any, bool], list[str]]] = {
    "yes": (True, ("free", "free", False), ["indentation_offset", "load_offset"]),
    "no": (False, (False, False, False), []),
    "a tilt": ({"slope": True}, ("free", "free", True), ["indentation_offset", "load_offset", "load_slope"]),
    "a range": ({"indentation": ["-1 um", "2 um"], "load": False}, ((-1e-6, 2e-6), False, False), ["indentation_offset"]),
    "contact": ({"indentation": "contact", "load": ["-5 nN", "5 nN"]}, ("contact", (-5e-9, 5e-9), False), ["load_offset"]),
}  # fmt: skip
"""What is written, the zero of depth, that of load and the slope, and what is fitted."""


def points(count: int, seed: int = 0) -> dict[str, Any]:
    """Points of a smooth ball with a jump into and out of contact, in nm and nN."""
    rng = np.random.default_rng(seed)
    half = count // 2
    depth = np.concatenate([np.linspace(-300.0, 200.0, half), np.linspace(200.0, -300.0, count - half)])
    back = np.arange(count) >= half
    touching = (depth > 0.0) | (back & (depth > -60.0))
    load = np.where(touching, 3.0 * np.maximum(depth + 80.0, 0.0) ** 1.5 / 10.0 - 350.0, 0.0)
    noise = [size * rng.standard_normal(count) for size in (0.2, 5.0)]
    return {"depth": depth + noise[0], "force": load + noise[1], "back": back}


def written(path: Path, rows: dict[str, Any], **more: Any) -> None:
    columns: dict[str, Any] = {"depth": rows["depth"], "force": rows["force"], **more}
    lines = [",".join(columns), *(",".join(map(str, row)) for row in zip(*columns.values(), strict=True))]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: Patch) -> Path:
    (tmp_path / "fit.toml").write_text(STUDY)
    written(tmp_path / "loop.csv", points(600))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def load(**keys: Any) -> Any:
    return gr.load("fit.toml", set={name.replace("__", "."): value for name, value in keys.items()})


def refused(*at: str, **keys: Any) -> str:
    """What is said where the study is refused at some keys: a sentence each, with what to do."""
    told = mistakes(load, **keys)
    assert [re.findall(r": ((?:data|physical)\.\w+)", one)[0] for one in told] == [*at]
    assert all(";" in one for one in told)
    return "\n".join(told)


def test_one_branch_alone_is_read_or_chosen(folder: Path) -> None:
    rows, both = points(600), load().loop
    for which, other, way in (("loading", "unloading", False), ("unloading", "loading", True)):
        study = load(data__which=which)
        assert (study.loop.unloading == way).all()
        np.testing.assert_array_equal(study.loop.depth, both.depth[both.unloading == way])
        alone = {name: values[rows["back"] == way] for name, values in rows.items()}
        written(folder / "one.csv", alone, way=alone["back"].astype(int))
        assert (load(data__file="one.csv", data__branch="way").loop.unloading == way).all()
        refused("data.which", data__file="one.csv", data__branch="way", data__which=other)
    written(folder / "up.csv", {name: values[:300] for name, values in rows.items()})
    assert not load(data__file="up.csv").loop.unloading.any(), "approach only needs no column"


def test_pauses_are_left_out_by_label_and_counted(folder: Path) -> None:
    rows = points(600)
    creep = {"depth": np.full(50, 200.0), "force": np.full(50, 300.0)}
    joined = {name: np.concatenate([rows[name][:300], creep[name], creep[name], rows[name][300:]]) for name in creep}
    words = [*300 * ["approach"], *50 * ["hold"], *50 * ["Wait here"], *300 * ["retract"]]
    written(folder / "loop.csv", joined, way=words)
    assert '"Wait here"' in refused("data.file", data__branch="way")
    study = load(data__branch="way", data__leave_out=["wait here"])
    np.testing.assert_allclose(study.loop.depth, 1e-9 * rows["depth"], rtol=1e-12)
    assert study.loop.paused == 100
    assert any("loop.csv: 100 rows" in note for note in study.notes)
    refused("data.leave_out", data__leave_out=["pause"])
    written(folder / "loop.csv", rows, way=600 * ["pause"])
    refused("data.file", data__branch="way")


def test_many_points_are_averaged_and_said(folder: Path) -> None:
    written(folder / "loop.csv", points(20_000), turn=np.repeat([5, 7], 10_000))
    study = load(data__cycle="turn")
    assert study.loop.depth.size < 1.1 * MOST
    assert study.loop.points == 20_000
    assert set(study.loop.cycle.tolist()) == {5, 7}
    assert any(f"20,000 points averaged along the path; {study.loop.depth.size:,} kept" in one for one in study.notes)
    assert study.loop.noise == pytest.approx((0.2e-9, 5e-9), rel=0.05)
    whole = load(fit__average=False)
    assert whole.loop.depth.size == 20_000
    assert not any("averaged" in note for note in whole.notes)


def test_several_files_are_loops_by_name(gradhesion: Call, folder: Path) -> None:
    (folder / "curves").mkdir()
    for i, name in enumerate(("b", "c", "a")):
        written(folder / "curves" / f"{name}.csv", points(600, seed=i))
    (folder / "curves" / "empty.csv").write_text("depth,force\nnan,nan\n")
    (folder / "curves" / "notes.txt").write_text("no loop")
    study = load(data__file="curves/*.csv")
    assert [loop.file for loop in study.loops] == [f"curves/{name}.csv" for name in ("a", "b", "c", "empty")]
    assert len({loop.sha256 for loop in study.loops}) == 4
    assert [bool(loop.problem) for loop in study.loops] == [False, False, False, True]
    assert any(note.startswith("curves/empty.csv: ") for note in study.notes)
    assert not study.is_of_one
    assert not load(data__file="curves/a*.csv").is_of_one, "a pattern has a dimension of loops, though it finds one"
    (folder / "stored.toml").write_text(study.text)
    assert gr.load("stored.toml").text == study.text
    for command in ("validate", "plan"):
        assert "1,800 points in 3 cycles of 4 loops" in gradhesion(command, "stored.toml").stdout
    written(folder / "curves" / "a.csv", points(600, seed=9))
    assert gradhesion("validate", "stored.toml").exit_code == 2, "the files are others"
    for pattern in ("curve/*.csv", "curves/e*.csv"):
        refused("data.file", data__file=pattern)


def test_a_file_whose_name_has_a_star_is_one_file(folder: Path) -> None:
    (folder / "loop.csv").rename(folder / "loop[1].csv")
    study = load(data__file="loop[1].csv")
    assert study.is_of_one
    assert study.loop.depth.size == 600


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("name", OFFSETS)
def test_zeros_are_free_bounded_found_or_right(name: str) -> None:
    given, zeros, fitted = OFFSETS[name]
    study = load(fit__offsets=given)
    assert study.parameters == ("E_star", "work_of_adhesion", *fitted)
    assert (study.offsets.indentation, study.offsets.load, study.offsets.slope) == zeros


@pytest.mark.usefixtures("folder")
def test_more_of_the_model_is_read() -> None:
    speeds = {"physical__speed": "1 um/s", "physical__reference_speed": {"start": "1 um/s", "stop": "1 mm/s"}}
    ranges = {"parameters__closing_ratio": {"start": 0.0, "stop": 1.0}, "rate__exponent": {"start": 0.3, "stop": 0.9}}
    study = load(**ranges, **speeds, physical__adhesion_range="0.3 nm")
    assert (study.free["closing_ratio"], study.free["exponent"]) == ((0.0, 1.0), (0.3, 0.9))
    assert study.free["reference_speed"] == pytest.approx((1e-6, 1e-3))
    assert study.rate.closing == "quasi-static"
    assert study.adhesion_range == 3e-10
    assert "adhesion_range" not in study.fixed
    assert load(rate__exponent=0.6, parameters__speed_over_reference=0.5).rate.exponent == 0.6
    pattern = load(toughness__harmonics=[{"n": 1, "cos": 0.2}], physical__toughness_wavelength="0.3 um")
    assert pattern.toughness is not None
    assert pattern.fixed["toughness_wavelength"] == pytest.approx(3e-7)
    assert load(loading__control="load").loading.control == "load"
    of_nu = load(
        parameters__nu={"start": 0.0, "stop": 0.5}, parameters__k=0.3, physical__c0="1 um", physical__E_star="10 MPa"
    )
    assert of_nu.free["nu"] == (0.0, 0.5)


def test_a_column_is_named_in_any_case_or_with_its_unit(folder: Path) -> None:
    plain = load().loop
    text = (folder / "loop.csv").read_text()
    (folder / "loop.csv").write_text(text.replace("depth,force", "Height (nm),Load (nN)", 1))
    for depth in ("Height", "height", "Height (nm)", {"column": "Height (nm)", "unit": "nm"}):
        loop = load(data__indentation=depth, data__load="load").loop
        np.testing.assert_array_equal(loop.depth, plain.depth)
        np.testing.assert_array_equal(loop.load, plain.load)
    refused("data.indentation", data__indentation={"column": "Height", "unit": "um"}, data__load="load")


@pytest.mark.parametrize(("depth", "load_"), [(1, -1), (-1, 1), (-1, -1)])
def test_wrong_signs_are_refused_with_the_remedy(depth: int, load_: int, folder: Path) -> None:
    rows = points(600)
    written(folder / "loop.csv", {"depth": depth * rows["depth"], "force": load_ * rows["force"]})
    assert "sign = -1" in refused("data.load" if load_ == -1 else "data.indentation")
    turned = load(data__load=FORCE | {"sign": load_}, data__indentation=DEPTH | {"sign": depth})
    np.testing.assert_allclose(turned.loop.load, 1e-9 * rows["force"], rtol=1e-12)
    np.testing.assert_allclose(turned.loop.depth, 1e-9 * rows["depth"], rtol=1e-12)


def test_points_in_no_order_and_without_contact_are_refused(folder: Path) -> None:
    rows = points(600)
    mix = np.random.default_rng(1).permutation(600)
    written(folder / "loop.csv", {name: rows[name][mix] for name in ("depth", "force")}, way=rows["back"][mix])
    assert "branch" in refused("data.file")
    shuffled = load(data__branch="way").loop
    assert shuffled.noise == pytest.approx((0.2e-9, 5e-9), rel=0.6), "a labelled branch needs no order"
    base = np.linspace(-500.0, -100.0, 600)
    written(folder / "loop.csv", {"depth": base, "force": np.random.default_rng(2).standard_normal(600)})
    refused("data.load")


def test_a_gap_is_no_mistake(folder: Path) -> None:
    rows = points(600)
    own = (rows["depth"] < 40.0) | (rows["depth"] > 90.0)
    written(folder / "loop.csv", {name: rows[name][own] for name in ("depth", "force")})
    loop = load().loop
    assert loop.depth.size == np.count_nonzero(own)
    assert loop.cycles == 1
