"""Studies of optima: against brute force, in blocks, in units, with requirements, as fronts, and what is refused."""

import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gradhesion as gr
from gradhesion.cli.study import study_from
from gradhesion.core import solve
from tests.cli.conftest import Call, Run
from tests.conftest import mistakes

WAVES = {"start": 0.05, "stop": 1.0, "spacing": "log"}
PUNCH: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "A": 0.02, "a_max_over_R": 1.0}


@pytest.fixture
def study() -> dict[str, Any]:
    search = {"maximise": "pull_off_force", "over": ["lambda_over_R"]}
    return {"kind": "optimum", "optimum": search, "parameters": PUNCH | {"k": [0.0, 0.3, 0.7], "lambda_over_R": WAVES}}


@pytest.mark.parametrize(("word", "goal"), [("maximise", "dissipated_energy"), ("minimise", "pull_off_force")])
def test_one_input_against_brute_force(word: str, goal: str) -> None:
    """On a grid a hundred times finer none is better, but for peaks narrower than the spacing, which are flagged."""
    rng, count = np.random.default_rng(3), 24 if goal == "dissipated_energy" else 12
    fixed = {
        "k": rng.choice([0.0, 0.3, 0.5, 0.8], count),
        "modulus": 10 ** rng.uniform(1.5, 3.5, count),
        "c0_over_R": 10 ** rng.uniform(-3.0, 0.0, count),
        "A": rng.uniform(0.002, 0.1, count),
        "a_max_over_R": rng.uniform(0.3, 1.5, count),
        "nu": np.full(count, 0.3),
    }
    over = {"lambda_over_R": WAVES | {"start": 0.02}}
    search = {"kind": "optimum", "layout": "points", "optimum": {word: goal, "over": [*over]}}
    found = gr.run(search | {"parameters": {name: values.tolist() for name, values in fixed.items()} | over})
    waves, best = np.geomspace(0.02, 1.0, 199 * 100 + 1), {"maximise": np.nanmax, "minimise": np.nanmin}[word]
    fine = best(solve(fixed | {"lambda_over_R": waves[:, None]}, [goal], check_contact=False)[goal], axis=0)
    ours = found[f"best_{goal}"].values
    better = (fine - ours) * (1.0 if word == "maximise" else -1.0) > 1e-9 * np.abs(fine)
    assert not (better & ~found.gr.flagged("resolution_too_coarse").values).any()
    assert better.mean() <= 0.05
    # what is reported is the value of the place that is reported
    there = solve(fixed | {"lambda_over_R": found["best_lambda_over_R"].values}, [goal])[goal]
    np.testing.assert_array_equal(ours, there)


def test_the_place_of_a_smooth_peak_has_all_digits(study: dict[str, Any]) -> None:
    """The sensitivity is 0 there; the value for k = 0.3 is that of the manual."""
    asked = study_from(study)
    there = pickle.loads(pickle.dumps(asked))  # noqa: S301 (of our own)
    assert (there.search, there.searched, there.text) == (asked.search, asked.searched, asked.text)
    found = gr.run(there)
    assert found["best_lambda_over_R"].sel(k=0.3).item() == pytest.approx(0.2552076039, abs=5e-11)
    slopes = found["best_pull_off_force_sensitivity"].sel(parameter="lambda_over_R")
    np.testing.assert_allclose(slopes, 0.0, atol=1e-13)
    assert found["on_bound"].values.tolist() == [0, 0, 0]
    assert found["status"].dtype == np.int16


def test_by_the_envelope_theorem_the_best_force_has_the_slopes_of_the_force(study: dict[str, Any]) -> None:
    step = 1e-3
    parameters = study["parameters"] | {"A": [0.02 * np.exp(i * step) for i in (-2, -1, 0, 1, 2)]}
    found = gr.run(study | {"parameters": parameters})
    logs = np.log(found["best_pull_off_force"].values)
    exact = logs @ np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / (12.0 * step)
    own = found["best_pull_off_force_sensitivity"].sel(parameter="A").isel(A=2)
    np.testing.assert_allclose(own, exact, rtol=1e-7)


def test_an_optimum_at_a_bound_is_an_answer(study: dict[str, Any], ran: Run, gradhesion: Call) -> None:
    parameters = study["parameters"] | {"lambda_over_R": {"start": 0.15, "stop": 0.22}, "k": [0.0, 0.7]}
    _, found, path = ran(study | {"parameters": parameters})
    assert found["best_lambda_over_R"].values.tolist()[0] == 0.22
    assert found["on_bound"].values[0] == 2
    meanings = found["on_bound"].attrs["flag_meanings"].split()
    assert meanings == ["lambda_over_R_at_its_lower_bound", "lambda_over_R_at_its_upper_bound"]
    upper = int((found["on_bound"].values == 2).sum())
    assert f"{meanings[1]} {upper} of 2 scenes" in " ".join(gradhesion("info", path).stdout.split())


def test_what_is_required(study: dict[str, Any]) -> None:
    free = gr.run(study | {"optimum": study["optimum"] | {"require": {"maximum": {"pull_off_radius": 10.0}}}})
    best = PUNCH | {"lambda_over_R": free["best_lambda_over_R"].values[1]}
    least = 1.5 * float(solve(best, ["dissipated_energy"])["dissipated_energy"])
    bound = gr.run(study | {"optimum": study["optimum"] | {"require": {"minimum": {"dissipated_energy": least}}}})
    waves = np.geomspace(0.05, 1.0, 200_001)
    fine = solve(PUNCH | {"lambda_over_R": waves}, ["pull_off_force", "dissipated_energy"], check_contact=False)
    best = fine["pull_off_force"][fine["dissipated_energy"] >= least].max()
    one = bound.sel(k=0.3)
    assert one["best_dissipated_energy"].item() >= least
    assert best <= one["best_pull_off_force"].item() <= best * (1.0 + 1e-3)
    assert one["best_dissipated_energy"].item() == pytest.approx(least, rel=1e-9)  # the requirement binds


@pytest.mark.parametrize("bound", ["minimum", "maximum"])
def test_what_is_exactly_what_is_required_meets_it(bound: str, study: dict[str, Any]) -> None:
    """A count of jumps, which is a whole number."""
    search = study["optimum"] | {"require": {"maximum": {"unloading_jumps": 1000}}}
    free = gr.run(study | {"optimum": search})
    jumps = int(free["best_unloading_jumps"].sel(k=0.3))
    met = gr.run(study | {"optimum": search | {"require": {bound: {"unloading_jumps": jumps}}}})
    assert met["best_pull_off_force"].sel(k=0.3) == free["best_pull_off_force"].sel(k=0.3)
    assert jumps > 1


def test_contact_of_one_disc_may_be_required(study: dict[str, Any]) -> None:
    parameters = study["parameters"] | {"A": 0.1, "k": [0.0, 0.3]}
    disc = gr.run(study | {"parameters": parameters, "optimum": study["optimum"] | {"require": {"one_disc": True}}})
    assert not disc.gr.flagged("loading_contact_not_one_disc").any()
    waves = np.geomspace(0.05, 1.0, 20_001)
    for k in (0.0, 0.3):
        fine = solve(PUNCH | {"k": k, "A": 0.1, "lambda_over_R": waves}, ["pull_off_force", "delta_max"])
        allowed = fine["pull_off_force"][(fine["status"] & 1) == 0]
        assert disc["best_pull_off_force"].sel(k=k).item() >= allowed.max() * (1.0 - 1e-12)


def test_where_nothing_meets_what_is_required(study: dict[str, Any], ran: Run) -> None:
    said, found, _ = ran(study | {"optimum": study["optimum"] | {"require": {"minimum": {"dissipated_energy": 5.0}}}})
    assert "3 of 3 scenes" in said
    assert bool(found.gr.flagged("nothing_feasible").all())
    assert bool(found["best_lambda_over_R"].isnull().all())
    assert bool(found["best_pull_off_force"].isnull().all())


def test_in_units_with_a_radius_that_is_searched() -> None:
    """The force in newtons of a smooth ball grows with R: the upper bound, 1.5 pi R dgamma."""
    search = {"maximise": "pull_off_force_si", "over": ["R"], "resolution": 10}
    units = {"R": {"start": "0.5 um", "stop": "2 um"}, "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2"}
    ball = {"k": 0.0, "nu": [0.2, 0.3], "A": 0.0}
    found = gr.run({"kind": "optimum", "optimum": search, "parameters": ball, "physical": units})
    np.testing.assert_array_equal(found["best_R"], 2e-6)
    np.testing.assert_allclose(found["best_pull_off_force_si"], 1.5 * np.pi * 2e-6 * 0.05, rtol=1e-14)
    assert found["best_R"].attrs["units"] == "m"
    assert "modulus" not in found.coords
    search["require"] = {"maximum": {"pull_off_force_si": 1.5 * np.pi * 1e-6 * 0.05}}
    found = gr.run({"kind": "optimum", "optimum": search, "parameters": ball, "physical": units})
    np.testing.assert_allclose(found["best_R"], 1e-6, rtol=1e-9)


def test_a_front_of_two_outputs(study: dict[str, Any], ran: Run, gradhesion: Call, tmp_path: Path) -> None:
    goals = ["pull_off_force", "dissipated_energy"]
    _, found, path = ran(study | {"optimum": {"maximise": goals, "over": ["lambda_over_R"], "resolution": 60}})
    assert found["best_pull_off_force"].dims == ("k", "pareto_point")
    for k in found["k"].values:
        there = ~found["best_lambda_over_R"].sel(k=k).isnull()
        force, energy, wave = (found[f"best_{name}"].sel(k=k).values[there] for name in (*goals, "lambda_over_R"))
        assert np.all(np.diff(force) < 0.0)
        assert np.all(np.diff(energy) > 0.0)
        exact = solve(PUNCH | {"k": k, "lambda_over_R": wave}, goals)
        np.testing.assert_array_equal([force, energy], [exact[name] for name in goals])
        swept = solve(PUNCH | {"k": k, "lambda_over_R": np.geomspace(0.05, 1.0, 60)}, goals)
        near = 1.0 + 1e-12
        for one, other in zip(swept[goals[0]], swept[goals[1]], strict=True):
            assert np.any((force * near >= one) & (energy * near >= other)), "no swept point excels the front"
    alone = gr.run(study)["best_pull_off_force"]  # its ends are the refined optima of each output
    np.testing.assert_allclose(found["best_pull_off_force"].max("pareto_point"), alone, rtol=1e-12)
    assert gradhesion("plot", path, "-o", tmp_path / "front.svg", "--at", "k=0.3").exit_code == 0
    assert gradhesion("explore", path).exit_code == gradhesion("verify", path).exit_code == 2


def test_a_peak_between_the_points_is_flagged(ran: Run) -> None:
    """Five points over many peaks: more show a higher one."""
    search = {"maximise": "dissipated_energy", "over": ["lambda_over_R"], "resolution": 5}
    wavy = PUNCH | {"k": [0.3, 0.5], "A": 0.1, "lambda_over_R": {"start": 0.02, "stop": 1.0}}
    said, found, _ = ran({"kind": "optimum", "parameters": wavy, "optimum": search})
    assert "2 of 2 scenes" in said
    assert found.gr.flagged("resolution_too_coarse").values.all()
    assert not found.gr.valid("best_dissipated_energy").values.any()


def test_the_resolution_that_is_named_is_the_finest_that_is_searched(study: dict[str, Any]) -> None:
    study["parameters"] |= {"A": {"start": 0.01, "stop": 0.1}}
    search: dict[str, Any] = {"maximise": "pull_off_force", "over": ["lambda_over_R", "A"]}
    (sentence,) = mistakes(study_from, study | {"optimum": search | {"resolution": 10**6}})
    finest = int(re.findall(r"at most (\d+)", sentence)[0])
    study_from(study | {"optimum": search | {"resolution": finest}})
    assert str(finest) in mistakes(study_from, study | {"optimum": search | {"resolution": finest + 1}})[0]
