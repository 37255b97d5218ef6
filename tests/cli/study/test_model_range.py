"""The range of the model: its numbers as outputs of a map, and contacts on steep slopes, said and marked unasked."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.names.scenes import STEEP
from gradhesion.cli.picture.shown import DOUBTS
from gradhesion.cli.study import study_from
from gradhesion.core import VALIDITY, validity
from tests.cli.conftest import Call, Patch, Run, legend

PARAMETERS = {"nu": 0.3, "modulus": 30.0, "c0_over_R": 0.1, "lambda_over_R": [0.05, 0.1, 0.2, 0.4, 0.8], "A": 0.05}
STUDY: dict[str, Any] = {"outputs": ["dissipated_energy"], "parameters": {"k": [0.0, 0.1, 0.2, 0.3]} | PARAMETERS}
WORDS = DOUBTS["contact_slope"].words
NUMBERS = {"A": [0.0, 1e-5, 0.05, 0.2], "adhesion_range_over_R": [1e-5, 0.01]}
COUNTED: list[tuple[dict[str, Any], dict[str, int]]] = [
    ({}, {"wave_slope": 2}),
    ({"profile": {"harmonics": [{"n": 1, "cos": 0.0, "sin": 0.2}]}}, {}),
    ({"profile": {"spectrum": {"hurst": 0.8, "first": 1, "last": 4, "realisations": 2, "seed": 3}}}, {}),
    ({"outputs": ["pull_off_force", "wave_slope"]}, {"wave_slope": 2}),
    ({"outputs": [*VALIDITY], "parameters": NUMBERS}, {"tabor_parameter": 4, "wave_tabor_parameter": 1, "wave_slope": 2, "johnson_alpha": 2}),
]  # fmt: skip


def asked(**parameters: Any) -> dict[str, Any]:
    return STUDY | {"parameters": STUDY["parameters"] | parameters}


def is_steep(study: dict[str, Any]) -> Any:
    """Whether scenes leave the range, by the slopes themselves."""
    return compute(study_from(study | {"outputs": [*study["outputs"], "contact_slope"]}))["contact_slope"].values > 1.0


def marks(dataset: xarray.Dataset) -> Any:
    return np.asarray(dataset.coords[STEEP].values if STEEP in dataset.coords else np.zeros(dataset["status"].shape))


def test_all_ways_to_run_mark_as_many(ran: Run, gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    steep = is_steep(STUDY)
    assert 0 < steep.sum() < steep.size
    parts = {"low": [0.0, 0.1], "high": [0.2], "one": 0.3}
    for name, k in parts.items():
        ran(asked(k=k), output=f"{name}.nc")
    monkeypatch.setenv("GRADHESION_CHUNK", "3")
    said, dataset, path = ran(STUDY)
    told = gradhesion("info", path).stdout
    for i in (1, 2):
        words = ("-o", tmp_path / "shards.nc", "--shard", f"{i}/2")
        assert gradhesion("run", tmp_path / "study.toml", *words).exit_code == 0
    lines = [said, gradhesion("merge", tmp_path / "shards.nc").stderr]
    joined = [tmp_path / f"{name}.nc" for name in parts]
    lines.append(gradhesion("merge", *joined, "-o", tmp_path / "joined.nc").stderr)
    for output, line in zip(("out.nc", "shards.nc", "joined.nc"), lines, strict=True):
        assert f"{steep.sum()} of 20 scenes" in line
        with gr.open(tmp_path / output) as found:
            np.testing.assert_array_equal(marks(found), steep)
    first = told.partition("outside the range of the model\n")[2].splitlines()[0]
    assert first.split()[:5] == ["contact_slope", str(steep.sum()), "of", "20", "scenes"]
    assert set(dataset.data_vars) == {"dissipated_energy", "status"}
    assert not dataset["status"].any()
    assert STEEP in dataset["dissipated_energy"].coords
    said, dataset, _ = ran(STUDY | {"outputs": ["dissipated_energy", "contact_slope"]}, "--overwrite")
    assert f"{steep.sum()} of 20 scenes" in said
    assert STEEP not in dataset.variables, "the slope itself is there"
    assert WORDS in legend(gr.plot(dataset, "dissipated_energy"))


@pytest.mark.parametrize("change", [{}, {"a_max_over_R": 1.0}])
def test_all_within_says_nothing(change: dict[str, Any], gradhesion: Call, ran: Run) -> None:
    study = asked(k=0.3, lambda_over_R=[0.4, 0.8], **change)
    assert not is_steep(study).any()
    said, dataset, path = ran(study)
    assert "slope" not in said
    assert "outside the range" not in gradhesion("info", path).stdout
    assert STEEP not in dataset.variables


def test_force_alone_reaches_to_its_pull_off() -> None:
    for modulus, some in ((30.0, False), (2.0, True)):
        found = compute(study_from(asked(modulus=modulus) | {"outputs": ["pull_off_force", "pull_off_radius"]}))
        np.testing.assert_array_equal(marks(found), found["pull_off_radius"] > 1.0)
        assert marks(found).any() == (STEEP in found.coords) == some


def test_points_units_solvers_and_uncertain_inputs() -> None:
    punch = {"k": 0.0, "nu": 0.3, "A": 0.05, "R": "1 um", "c0": "1 um", "work_of_adhesion": "50 mJ/m^2"}
    quantities = punch | {"wavelength": ["50 nm", "0.8 um"], "E_star": "1.5 MPa"}
    np.testing.assert_array_equal(marks(gr.solve(quantities, "dissipated_energy")), [1, 0])
    assert marks(gr.solve(quantities, "dissipated_energy", a_max="1 um")).sum() == 0
    points = asked(k=[0.0, 0.1, 0.2, 0.3, 0.3]) | {"layout": "points"}
    np.testing.assert_array_equal(marks(compute(study_from(points))), is_steep(points))
    both = marks(compute(study_from(STUDY | {"method": {"solver": ["exact", "envelope"]}})))
    np.testing.assert_array_equal(both[0], is_steep(STUDY))
    assert both[1].all(), "envelopes of an unbounded punch have no end"
    uncertain = STUDY | {"uncertainty": {"modulus": "5 %", "samples": 8}}
    np.testing.assert_array_equal(marks(compute(study_from(uncertain))), is_steep(STUDY))


def test_optima_mark_what_they_find() -> None:
    search = {"maximise": "dissipated_energy", "over": ["lambda_over_R"], "resolution": 20}
    optimum: dict[str, Any] = asked(k=[0.0, 0.3], lambda_over_R={"start": 0.05, "stop": 0.8, "spacing": "log"})
    optimum = {"kind": "optimum", "parameters": optimum["parameters"], "optimum": search}
    found = compute(study_from(optimum))
    for i, k in enumerate([0.0, 0.3]):
        assert marks(found)[i] == is_steep(asked(k=k, lambda_over_R=float(found["best_lambda_over_R"][i])))
    assert marks(found)[0] == 1
    shallow = optimum | {"optimum": search | {"maximise": "contact_slope"}}
    assert compute(study_from(shallow))["best_contact_slope"][0] > 1.0


def test_curves_say_it_of_what_is_drawn(ran: Run) -> None:
    study = asked(k=0.0, lambda_over_R=0.8, indentation_max_over_R=[0.1, 3.0]) | {"kind": "curve", "outputs": ["path"]}
    said, dataset, _ = ran(study)
    assert "1 of 2 scenes" in said
    np.testing.assert_array_equal(marks(dataset), dataset["path_contact_radius"].max("path_point") > 1.0)


def test_a_cone_says_it_once(gradhesion: Call, ran: Run) -> None:
    cone = asked(k=[0.0, 0.3], A=0.0, a_max_over_R=0.2) | {"profile": {"exponent": 1.0}, "outputs": ["pull_off_force"]}
    del cone["parameters"]["lambda_over_R"]
    said, _, path = ran(cone)
    assert said.count("a cone of slope 1") == 1
    assert "a cone" in gradhesion("info", path).stdout.partition("outside the range")[2]


def test_pictures_hatch_them_and_pages_say_it(ran: Run, gradhesion: Call, tmp_path: Path) -> None:
    waves = {"start": 0.05, "stop": 0.8, "num": 10, "spacing": "log"}
    study = asked(k={"start": 0.0, "stop": 0.3, "num": 12}, lambda_over_R=waves)
    said, dataset, _ = ran(study, "--quiet")
    assert said == ""
    panels = gr.plot(dataset, "dissipated_energy")
    assert legend(panels) == [WORDS]
    filled = {one.hatches[0] for one in panels[0].collections if getattr(one, "filled", False)}  # type: ignore[attr-defined]
    assert filled - {None} == {DOUBTS["contact_slope"].hatch}
    few = dataset.isel(k=slice(10, 12), lambda_over_R=slice(8, 10))
    assert WORDS not in legend(gr.plot(few, "dissipated_energy"))
    assert gradhesion("explore", tmp_path / "out.nc").exit_code == 0
    share = f"{is_steep(study).sum()} of 120 scenes"
    assert share in panels.figure.get_suptitle()
    assert share in (tmp_path / "out.html").read_text(encoding="utf-8")


def test_python_says_it_once(capsys: pytest.CaptureFixture[str]) -> None:
    punch = {"k": 0.0, "nu": 0.3, "modulus": 31.7, "lambda_over_R": 0.05, "A": 0.05}
    for _ in range(2):
        found = gr.solve(punch, "dissipated_energy")
    assert found.gr.outside("contact_slope").item()
    assert capsys.readouterr().err.count("contact reaches slopes that are not small") <= 1
    assert not gr.solve(punch, "dissipated_energy", a_max_over_R=0.5).gr.outside("contact_slope").item()
    with pytest.raises(gr.GradhesionError, match="wave_slope"):
        found.gr.outside("wave_slope")


def test_a_cycle_that_turns_before_contact_is_flagged(gradhesion: Call, ran: Run) -> None:
    _, dataset, path = ran(asked(indentation_max_over_R=[-1.0, 0.05], k=0.0))
    away = dataset.gr.flagged("no_contact")
    np.testing.assert_array_equal(away, [[True, False]] * 5)
    assert (dataset["dissipated_energy"].where(away, drop=True) == 0.0).all()
    assert dataset.gr.valid("dissipated_energy").all(), "no contact is an answer"
    assert "the cycle turns before first contact" in gradhesion("info", path).stdout


@pytest.mark.parametrize("solver", ["exact", ["asymptotic", "envelope"]])
def test_the_range_is_the_last_dimension_and_solves_nothing_again(solver: Any, data: dict[str, Any]) -> None:
    parameters = data["parameters"] | {"adhesion_range_over_R": [1e-5, 1e-3]}
    data |= {"outputs": ["pull_off_force", *VALIDITY], "parameters": parameters, "method": {"solver": solver}}
    dataset = compute(study_from(data))
    own = [] if solver == "exact" else ["solver"]
    assert list(dataset.sizes) == [*own, "k", "lambda_over_R", "A", "a_max_over_R", "adhesion_range_over_R"]
    np.testing.assert_array_equal(dataset["pull_off_force"][..., 0], dataset["pull_off_force"][..., 1])
    names = [*gr.PARAMETERS, "adhesion_range_over_R"]
    arrays = dict(zip(names, xarray.broadcast(*(dataset[name] for name in names)), strict=True))
    order = dataset["status"].dims[len(own) :]
    for name, values in validity({one: array.transpose(*order).values for one, array in arrays.items()}).items():
        np.testing.assert_array_equal(dataset[name], np.broadcast_to(values, dataset[name].shape))
        assert dataset[name].attrs["units"] == "1"


def test_a_scene_without_value_has_none_of_them() -> None:
    punch = {"k": 0.0, "nu": 0.3, "modulus": 5000.0, "A": 0.3, "lambda_over_R": 1e-9, "a_max_over_R": 0.4}
    found = gr.solve(punch, ["dissipated_energy", *VALIDITY[2:]])
    assert found.gr.flagged("no_value").item()
    assert all(np.isnan(found[name].item()) for name in VALIDITY[2:])


@pytest.mark.parametrize(("more", "beyond"), COUNTED)
def test_scenes_beyond_the_model_are_counted(more: Any, beyond: dict[str, int], gradhesion: Call, ran: Run) -> None:
    """Two of four amplitudes have 2 pi A above 0.5, and there chi is above 1/2 and loading not one disc."""
    numbers = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}
    numbers |= {"A": [0.01, 0.05, 0.1, 0.2]} | more.get("parameters", {})
    study = {"outputs": ["dissipated_energy"]} | more | {"parameters": numbers}
    said, _, path = ran(study)
    told = gradhesion("info", path).stdout.partition("outside the range of the model\n")[2]
    lines = {line.split()[0]: line for line in told.splitlines() if line.startswith("  ")}
    assert {name: int(lines[name].split(" of ")[0].split()[-1]) for name in VALIDITY if name in lines} == beyond
    if study["outputs"] == ["dissipated_energy"]:
        assert ("slopes above 0.5 in 2 of 4 scenes" in said) == ("wave_slope" in beyond)
        assert ("not one disc in 2 of 4 scenes" in said) == ("wave_slope" in beyond)
    if study["outputs"] == [*VALIDITY]:
        assert gradhesion("verify", path).exit_code == 2, "there is nothing to recompute"


@pytest.mark.parametrize(("scenes", "is_said"), [(12, False), (8, True)])
def test_less_than_a_tenth_that_is_not_one_disc_is_not_said(scenes: int, is_said: bool, ran: Run) -> None:
    numbers = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}
    numbers |= {"A": [*np.linspace(0.0, 0.02, scenes - 1).tolist(), 0.2]}
    said, found, _ = ran({"outputs": ["dissipated_energy"], "parameters": numbers})
    assert int(found.gr.flagged("loading_contact_not_one_disc").sum()) == 1
    assert ("one disc" in said) == is_said
