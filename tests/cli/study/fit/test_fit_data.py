"""What a fit takes for data: branches by any name, one of them, pauses, several files, many points, and wrong ones."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result

import gradhesion as gr
from gradhesion.core.loops.measured.averaging import MOST
from tests.cli.ball import BALL, COLUMNS, WORK

Call = Callable[..., Result]

STUDY = f"""
kind = "fit"
[data]
file = "loop.csv"
{COLUMNS}{BALL}{WORK}"""


def points(count: int, seed: int = 0) -> dict[str, Any]:
    """Points of a smooth ball with a jump into and out of contact, in nm and nN."""
    rng = np.random.default_rng(seed)
    half = count // 2
    depth = np.concatenate([np.linspace(-300.0, 200.0, half), np.linspace(200.0, -300.0, count - half)])
    back = np.arange(count) >= half
    touching = (depth > 0.0) | (back & (depth > -60.0))
    load = np.where(touching, 3.0 * np.maximum(depth + 80.0, 0.0) ** 1.5 / 10.0 - 350.0, 0.0)
    return {
        "depth": depth + 0.2 * rng.standard_normal(count),
        "force": load + 5.0 * rng.standard_normal(count),
        "back": back,
    }


def written(path: Path, rows: dict[str, Any], **more: Any) -> None:
    """Write a table, with more columns."""
    columns: dict[str, Any] = {"depth": rows["depth"], "force": rows["force"], **more}
    lines = [",".join(columns), *(",".join(map(str, row)) for row in zip(*columns.values(), strict=True))]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a study and a loop of 600 points."""
    (tmp_path / "fit.toml").write_text(STUDY)
    written(tmp_path / "loop.csv", points(600))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def load(**keys: Any) -> Any:
    """The study with some keys set."""
    return gr.load("fit.toml", set={name.replace("__", "."): value for name, value in keys.items()})


def refused(**keys: Any) -> str:
    """The one sentence that refuses the study."""
    with pytest.raises(gr.StudyError) as caught:
        load(**keys)
    text = str(caught.value)
    assert len(text.splitlines()) == 1, text
    return text


@pytest.mark.parametrize(
    "words",
    [("approach", "retract"), ("Approaching", "retracting"), ("extend", "withdraw"), ("0", "1"), ("false", "true")],
)
def test_branches_have_many_names(folder: Path, words: tuple[str, str]) -> None:
    rows = points(600)
    written(folder / "loop.csv", rows, way=[words[int(b)] for b in rows["back"]])
    study = load(data__branch="way")
    np.testing.assert_array_equal(study.loop.unloading, rows["back"])
    assert study.loop.cycles == 1


def test_one_branch_alone_is_read_or_chosen(folder: Path) -> None:
    rows = points(600)
    both = load()
    for which, way in (("loading", False), ("unloading", True)):
        study = load(data__which=which)
        assert (study.loop.unloading == way).all()
        own = both.loop.unloading == way
        np.testing.assert_array_equal(study.loop.depth, both.loop.depth[own])
        alone = {name: values[rows["back"] == way] for name, values in rows.items()}
        written(folder / "one.csv", alone, way=alone["back"].astype(int))
        found = load(data__file="one.csv", data__branch="way")
        assert (found.loop.unloading == way).all()
        other = "unloading" if which == "loading" else "loading"
        told = refused(data__file="one.csv", data__branch="way", data__which=other)
        assert f"the data have no {other}; write the other branch, or remove which" in told
    written(folder / "up.csv", {name: values[:300] for name, values in rows.items()})
    assert not load(data__file="up.csv").loop.unloading.any(), "approach only needs no column"


def test_pauses_are_left_out_by_label_and_counted(folder: Path) -> None:
    rows = points(600)
    creep = {"depth": np.full(50, 200.0), "force": np.full(50, 300.0)}
    joined = {name: np.concatenate([rows[name][:300], creep[name], creep[name], rows[name][300:]]) for name in creep}
    words = [*300 * ["approach"], *50 * ["hold"], *50 * ["Wait here"], *300 * ["retract"]]
    written(folder / "loop.csv", joined, way=words)
    told = refused(data__branch="way")
    assert 'way = "Wait here" is not one of its words' in told
    study = load(data__branch="way", data__leave_out=["wait here"])
    np.testing.assert_allclose(study.loop.depth, 1e-9 * rows["depth"], rtol=1e-12)
    assert study.loop.paused == 100
    assert "loop.csv: 100 rows of pauses were left out" in study.notes
    assert "rows are left out by the words of a column" in refused(data__leave_out=["pause"])
    written(folder / "loop.csv", rows, way=600 * ["pause"])
    assert "every row belongs to a pause; name a file with some" in refused(data__branch="way")


def test_many_points_are_averaged_and_said(folder: Path) -> None:
    rows = points(20_000)
    written(folder / "loop.csv", rows, turn=np.repeat([5, 7], 10_000))
    study = load(data__cycle="turn")
    loop = study.loop
    assert loop.depth.size < 1.1 * MOST
    assert loop.points == 20_000
    assert loop.is_averaged
    assert set(loop.cycle.tolist()) == {5, 7}
    assert f"loop.csv: 20,000 points averaged along the path; {loop.depth.size:,} kept" in study.notes
    assert loop.noise == pytest.approx((0.2e-9, 5e-9), rel=0.05)
    whole = load(fit__average=False)
    assert whole.loop.depth.size == 20_000
    assert not whole.loop.is_averaged
    assert whole.notes[0].startswith("loop.csv: noise estimated")


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
    assert "curves/empty.csv: no row has numbers in all of its columns; name a file with some" in study.notes
    assert not study.is_of_one
    (folder / "stored.toml").write_text(study.text)
    assert gr.load("stored.toml").text == study.text
    told = gradhesion("validate", "stored.toml").stdout
    assert "valid; a fit of 1,800 points in 3 cycles of 4 loops; fitted: E_star, work_of_adhesion" in told
    assert "points    1,800 points in 3 cycles of 4 loops" in gradhesion("plan", "stored.toml").stdout
    written(folder / "curves" / "a.csv", points(600, seed=9))
    result = gradhesion("validate", "stored.toml")
    assert result.exit_code == 2
    assert "the files are not the ones that this study was written for" in result.stderr
    assert "no file matches this pattern" in refused(data__file="curve/*.csv")
    told = refused(data__file="curves/e*.csv")
    assert "no row has numbers" in told
    for name in ("a", "b", "c"):
        (folder / "curves" / f"{name}.csv").write_text("depth,force\nnan,nan\n")
    assert "(and so with each of the 4 loops)" in refused(data__file="curves/*.csv")


def test_a_file_whose_name_has_a_star_is_one_file(folder: Path) -> None:
    (folder / "loop.csv").rename(folder / "loop[1].csv")
    study = load(data__file="loop[1].csv")
    assert study.is_of_one
    assert study.loop.depth.size == 600


OFFSETS: dict[str, tuple[Any, tuple[str, ...]]] = {
    "yes": (True, ("indentation_offset", "load_offset")),
    "no": (False, ()),
    "a tilt": ({"slope": True}, ("indentation_offset", "load_offset", "load_slope")),
    "a range": ({"indentation": ["-1 um", "2 um"], "load": False}, ("indentation_offset",)),
    "contact": ({"indentation": "contact", "load": ["-5 nN", "5 nN"]}, ("load_offset",)),
}


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("name", OFFSETS)
def test_zeros_are_free_bounded_found_or_right(name: str) -> None:
    given, names = OFFSETS[name]
    study = load(fit__offsets=given)
    assert study.parameters == ("E_star", "work_of_adhesion", *names)
    if name == "a range":
        assert study.offsets.indentation == (-1e-6, 2e-6)
    if name == "contact":
        assert study.offsets.load == pytest.approx((-5e-9, 5e-9))


@pytest.mark.usefixtures("folder")
def test_more_of_the_model_is_read() -> None:
    study = load(
        parameters__closing_ratio={"start": 0.0, "stop": 1.0},
        rate__exponent={"start": 0.3, "stop": 0.9},
        physical__speed="1 um/s",
        physical__reference_speed={"start": "1 um/s", "stop": "1 mm/s"},
        physical__adhesion_range="0.3 nm",
    )
    assert study.free["closing_ratio"] == (0.0, 1.0)
    assert study.free["exponent"] == (0.3, 0.9)
    assert study.free["reference_speed"] == pytest.approx((1e-6, 1e-3))
    assert study.rate is not None
    assert study.rate.closing == "quasi-static"
    assert study.adhesion_range == 3e-10
    assert "adhesion_range" not in study.fixed
    assert load(rate__exponent=0.6, parameters__speed_over_reference=0.5).rate.exponent == 0.6
    pattern = load(toughness__harmonics=[{"n": 1, "cos": 0.2}], physical__toughness_wavelength="0.3 um")
    assert pattern.toughness is not None
    assert pattern.fixed["toughness_wavelength"] == pytest.approx(3e-7)
    assert load(loading__control="load").loading.control == "load"


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("keys", "at"),
    [
        ({"data__load": {"column": "depth", "unit": "nm"}}, "data.load"),
        ({"data__load": {"column": "force", "unit": "nm"}}, "data.load"),
        ({"data__load": {"column": "force"}}, "data.load"),
        ({"data__load": {"column": "forse", "unit": "nN"}}, "data.load"),
        ({"data__load": {"column": "force", "unit": "nN", "back": "x"}}, "data.indentation"),
        ({"data__file": "none.csv"}, "data.file"),
        ({"data__sha256": 64 * "0"}, "data.file"),
    ],
)
def test_what_is_wrong_with_the_columns_is_one_sentence(keys: dict[str, Any], at: str) -> None:
    assert f": {at} = " in refused(**keys)


def test_a_column_is_named_in_any_case_or_with_its_unit(folder: Path) -> None:
    plain = load().loop
    rows = points(600)
    written(folder / "loop.csv", {"depth": rows["depth"], "force": rows["force"]})
    text = (folder / "loop.csv").read_text()
    (folder / "loop.csv").write_text(text.replace("depth,force", "Height (nm),Load (nN)", 1))
    for depth in ("Height", "height", "Height (nm)", {"column": "Height (nm)", "unit": "nm"}):
        loop = load(data__indentation=depth, data__load="load").loop
        np.testing.assert_array_equal(loop.depth, plain.depth)
        np.testing.assert_array_equal(loop.load, plain.load)
    told = refused(data__indentation={"column": "Height", "unit": "um"}, data__load="load")
    assert '"um" in the study and "nm" in the header' in told


def test_wrong_signs_are_refused_with_the_remedy(folder: Path) -> None:
    rows = points(600)
    written(folder / "loop.csv", rows | {"force": -rows["force"]})
    told = refused()
    assert 'positive loads press; write load = { column = "force", unit = "nN", sign = -1 }' in told
    turned = load(data__load={"column": "force", "unit": "nN", "sign": -1})
    np.testing.assert_allclose(turned.loop.load, 1e-9 * rows["force"], rtol=1e-12)
    written(folder / "loop.csv", rows | {"depth": -rows["depth"]})
    assert 'write indentation = { column = "depth", unit = "nm", sign = -1 }' in refused()
    assert load(data__indentation={"column": "depth", "unit": "nm", "sign": -1}).loop.cycles == 1
    written(folder / "loop.csv", {"depth": -rows["depth"], "force": -rows["force"]})
    assert "as is that of the depth" in refused()


def test_points_in_no_order_and_without_contact_are_refused(folder: Path) -> None:
    rows = points(600)
    mix = np.random.default_rng(1).permutation(600)
    written(folder / "loop.csv", {name: rows[name][mix] for name in ("depth", "force")}, way=rows["back"][mix])
    assert "the branches cannot be recognised from the order of the points" in refused()
    shuffled = load(data__branch="way").loop
    assert shuffled.noise == pytest.approx((0.2e-9, 5e-9), rel=0.6), "a labelled branch needs no order"
    base = np.linspace(-500.0, -100.0, 600)
    written(folder / "loop.csv", {"depth": base, "force": np.random.default_rng(2).standard_normal(600)})
    assert "the load is linear in the depth within its noise: the data show no contact" in refused()


def test_a_gap_is_no_mistake(folder: Path) -> None:
    rows = points(600)
    own = (rows["depth"] < 40.0) | (rows["depth"] > 90.0)
    written(folder / "loop.csv", {name: rows[name][own] for name in ("depth", "force")})
    loop = load().loop
    assert loop.depth.size == np.count_nonzero(own)
    assert loop.cycles == 1
