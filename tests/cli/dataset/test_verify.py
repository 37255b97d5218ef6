"""`gradhesion verify` finds what is wrong with a dataset, and nothing wrong with a good one."""

import hashlib
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest

import gradhesion as gr
from gradhesion.core import OUTPUTS
from tests.cli.conftest import Call, Made


@pytest.fixture
def file(made: Made) -> Path:
    return made(outputs=[*OUTPUTS])


def verified(path: Path) -> tuple[int, Any]:
    """Recompute all scenes: the number of values that exceed their errors, and what was found."""
    found = gr.verify(path, sample=100, seed=1)
    shares = [one.share for one in found.deviations]
    assert shares == sorted(shares, reverse=True), "the worst first"
    return found.exceeding, found


def change(path: Path, name: str, place: Any, value: Any) -> None:
    with netCDF4.Dataset(path, "a") as file:
        file[name][place] = value(file[name][place]) if callable(value) else value


def off(by: float) -> Callable[[Any], Any]:
    return lambda value: value * (1.0 + by)


def edit_study(path: Path, old: str, new: str) -> None:
    """Change the text of a dataset's study, and its sha256."""
    with netCDF4.Dataset(path, "a") as file:
        assert old in file.study
        file.study = file.study.replace(old, new)
        file.study_sha256 = hashlib.sha256(file.study.encode()).hexdigest()


def test_a_good_dataset_stands_up_and_a_changed_value_is_named_first(gradhesion: Call, file: Path) -> None:
    exceeding, found = verified(file)
    assert (exceeding, found.scenes, len(found.deviations)) == (0, 24, 240)
    assert found.deviations[0].share > 0.0, "values of 53 bits are not exact"
    assert gradhesion("verify", file).exit_code == 0
    first, again, other = (gradhesion("verify", file, "--sample=3", f"--seed={seed}").stdout for seed in (5, 5, 6))
    assert first == again != other
    place = {"k": 0.31, "lambda_over_R": 0.47, "A": 0.023, "a_max_over_R": 0.7}
    wrong = {"pull_off_force": off(1e-11), "loading_jumps": lambda count: count + 1, "delta_jump_out": off(1e-11)}
    for output, way in wrong.items():
        change(file, output, (1, 2, 1, 0), way)
    exceeding, found = verified(file)
    assert {one.output for one in found.deviations[:exceeding]} == {*wrong}
    assert all(dict(one.scene) == pytest.approx(place) for one in found.deviations[:exceeding])
    assert gradhesion("verify", file, "--sample", "100", code=3).stderr.count("\n") == 1


def test_loading_on_the_opening_curve_beside_a_ratio_of_1_is_found(made: Made) -> None:
    """Version 0.3.0 wrote the loading of ratio 1 at every ratio."""
    outputs = ["dissipated_energy", "delta_max", "loading_jumps"]
    path = made(outputs=outputs, parameters={"A": 0.03, "a_max_over_R": 0.5, "closing_ratio": [0.5, 1.0]})
    with netCDF4.Dataset(path, "a") as file:
        for name in outputs[1:]:
            file[name][..., 0] = file[name][..., 1]
    exceeding, found = verified(path)
    wrong = found.deviations[:exceeding]
    assert {one.output for one in wrong} == {*outputs[1:]}
    assert {one.scene["closing_ratio"] for one in wrong} == {0.5}


STUDIES: list[tuple[str, str, int]] = [
    ("modulus = 430.0", "modulus = 431.0", 2),
    ("0.31]", "0.32]", 2),
    ("num = 3", "num = 4", 2),
    ("num = 3", "num = 2", 2),
    ('spacing = "log"', 'spacing = "linear"', 2),
    ("A = [", "B = [", 2),
    ("[parameters]", "[parameters", 2),
    ("[parameters]", "[method]\nsolver = 'asymptotic'\n[parameters]", 2),
    ("title = ", "kind = 'curve'\ntitle = ", 2),
    ("[parameters]", "[method]\nsolver = 'envelope'\n[parameters]", 3),
    ("[parameters]", "[profile]\nexponent = 2.5\n[parameters]", 3),
    ("[parameters]", "[loading]\ncontrol = 'load'\n[parameters]", 3),
    ('"pull_off_radius", ', "", 0),  # a study may ask for less, or for what changes no value
    ("[parameters]", "[method]\ncheck_contact = false\n[parameters]", 0),
]
"""What is changed in a study, and the exit code: 3 where it is told by the values alone."""


@pytest.mark.parametrize(("old", "new", "code"), STUDIES)
def test_a_study_of_another_dataset_is_told(old: str, new: str, code: int, gradhesion: Call, file: Path) -> None:
    """By its coordinates, or by its values, where its sha256 fits (which it does not in test_joining.py)."""
    edit_study(file, old, new)
    result = gradhesion("verify", file, "--sample=8", "--seed=2", code=code)
    if code == 2:
        assert result.stderr.startswith(f"{file}: ")
        assert result.stderr.count("\n") == 1


def test_scenes_without_a_value_must_have_none_and_others_one(file: Path) -> None:
    values = [name for name in OUTPUTS if not name.endswith("_jumps")]
    blank = {"status": 64} | dict.fromkeys(OUTPUTS, -1) | dict.fromkeys(values, np.nan)
    for name, value in blank.items():
        change(file, name, 0, value)
    exceeding, found = verified(file)
    assert (exceeding, found.scenes, found.failed) == (0, 12, 12)
    wrong = {"pull_off_radius": (0, 0.2), "loading_jumps": (0, 1), "pull_off_force": (1, np.nan)}
    for name, (k, value) in wrong.items():
        change(file, name, (k, 1, 1, 1), value)
    exceeding, found = verified(file)
    assert {(one.output, one.share) for one in found.deviations[:exceeding]} == {(name, math.inf) for name in wrong}


def test_scenes_of_too_many_waves_are_left_out_and_others_drawn(gradhesion: Call, made: Made) -> None:
    some = {"A": [0.0, 0.05], "a_max_over_R": [0.5, 1.0]}
    exceeding, found = verified(made(parameters=some | {"lambda_over_R": [1e-5, 0.2]}))
    assert (exceeding, found.scenes, found.beyond) == (0, 12, 4), "without amplitude a wavelength of any size is fine"
    assert gradhesion("verify", made(parameters=some | {"A": 0.05, "lambda_over_R": 1.1e-5})).exit_code == 2


def test_errors_that_a_dataset_tells_of_its_values_are_held_against_them(file: Path) -> None:
    """As versions up to 0.3 wrote them, where the study asked for them."""
    edit_study(file, 'outputs = ["pull', 'outputs = ["pull_off_force_error", "pull')
    with netCDF4.Dataset(file, "a") as old:
        error = old.createVariable("pull_off_force_error", "f8", old["pull_off_force"].dimensions)
        error[:] = 1e-10
        old["pull_off_force"][0, 0, 0, 0] += 9e-11
        old["pull_off_force"][0, 0, 1, 0] += 2e-10
    exceeding, found = verified(file)
    assert exceeding == 1
    assert [one.output for one in found.deviations[:2]] == 2 * ["pull_off_force"]
    assert [one.share for one in found.deviations[:2]] == pytest.approx([2.0, 0.9], rel=1e-3)


def test_of_several_solvers_those_with_a_twin_are_recomputed(gradhesion: Call, made: Made) -> None:
    path = made(method={"solver": ["asymptotic", "envelope", "exact"]})
    exceeding, found = verified(path)
    assert (exceeding, found.scenes, len(found.deviations)) == (0, 48, 144)
    change(path, "pull_off_force", 0, off(1.0))  # nobody knows
    change(path, "pull_off_force", (1, 0, 2, 1, 1), off(1e-11))
    exceeding, found = verified(path)
    assert exceeding == 1
    assert (found.deviations[0].scene["solver"], found.deviations[0].scene["k"]) == ("envelope", 0.0)
    edit_study(path, '"envelope", "exact"', '"exact", "envelope"')
    assert gradhesion("verify", path).exit_code == 2


def test_a_rim_given_in_the_jump_in_radius_is_recomputed(data: dict[str, Any], made: Made) -> None:
    del data["parameters"]["a_max_over_R"]
    path = made(exit_code=3, parameters={"A": [0.0, 0.023, 9.0], "a_max_over_a2": [0.7, 1.3, 2.1]})  # r > s at A = 9
    assert verified(path)[0] == 0
    for wrong in (off(1e-12), np.nan):
        change(path, "a_max_over_R", (0, 0, 0, 0), wrong)
        exceeding, found = verified(path)
        assert exceeding > 0
        assert found.deviations[0].output == "a_max_over_R"


def test_a_status_excuses_counts_and_places_near_a_jump_and_values_that_failed(file: Path) -> None:
    for k, status in ((0, 16), (1, 32)):
        change(file, "status", (k, 2, 1, 0), status)
        change(file, "loading_jumps", (k, 2, 1, 0), lambda count: count + 1)
        change(file, "pull_off_radius", (k, 2, 1, 0), off(0.1))
        change(file, "dissipated_energy", (k, 2, 1, 0), off(1e-11))
    exceeding, found = verified(file)
    wrong = [(one.output, one.scene["k"]) for one in found.deviations[:exceeding]]
    assert wrong == [("dissipated_energy", 0.0)]
