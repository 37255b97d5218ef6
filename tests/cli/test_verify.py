"""`gradhesion verify` finds what is wrong with a dataset, and nothing wrong with a good one."""

import hashlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest
from click.testing import Result

from gradhesion.core import OUTPUTS

Call = Callable[..., Result]
ALL = ("--sample", "100", "--seed", "1")


@pytest.fixture
def file(made: Callable[..., Path]) -> Path:
    """All outputs."""
    return made(outputs=[*OUTPUTS])


def rows(result: Result) -> list[list[str]]:
    """Give the lines of the table in words."""
    lines = result.stdout.split("worst first")[1].splitlines()[1:]
    return [line.split() for line in lines[: lines.index("")]]


def change(path: Path, name: str, place: Any, value: Any) -> None:
    """Change values of a variable."""
    with netCDF4.Dataset(path, "a") as file:
        file[name][place] = value(file[name][place]) if callable(value) else value


def edit_study(path: Path, old: str, new: str, *, seal: bool) -> None:
    """Change the text of a dataset's study, and its sha256 if `seal`."""
    with netCDF4.Dataset(path, "a") as file:
        assert old in file.study
        file.study = file.study.replace(old, new)
        if seal:
            file.study_sha256 = hashlib.sha256(file.study.encode()).hexdigest()


def test_a_good_dataset_stands_up(gradhesion: Call, file: Path) -> None:
    result = gradhesion("verify", file, *ALL)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "24 of 24 scenes recomputed (--seed 1), 240 values" in result.stdout
    shares = [float(row[3]) for row in rows(result) if row[0] != "..."]
    assert len(shares) == 12
    assert shares == sorted(shares, reverse=True)
    assert shares[0] > 0.0, "values of 53 bits are not exact"


@pytest.mark.parametrize("output", ["pull_off_force", "loading_jumps", "delta_jump_out"])
def test_one_changed_value_is_found_and_named_first(output: str, gradhesion: Call, file: Path) -> None:
    change(file, output, (1, 2, 1, 0), lambda value: value + 1 if output.endswith("_jumps") else value * (1 + 1e-11))
    result = gradhesion("verify", file, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][0] == output
    assert " ".join(rows(result)[0][4:]) == "k = 0.31, lambda_over_R = 0.47, A = 0.023, a_max_over_R = 0.7"
    assert result.stderr.startswith(f"{file}: 1 of 240 values ")


def test_loading_on_the_opening_curve_beside_a_ratio_of_1_is_found(gradhesion: Call, made: Callable[..., Path]) -> None:
    """Version 0.3.0 wrote the loading of ratio 1 at every ratio."""
    outputs = ["dissipated_energy", "delta_max", "loading_jumps"]
    path = made(outputs=outputs, parameters={"A": 0.03, "a_max_over_R": 0.5, "closing_ratio": [0.5, 1.0]})
    with netCDF4.Dataset(path, "a") as file:
        for name in outputs[1:]:
            file[name][..., 0] = file[name][..., 1]
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 3
    wrong = [row for row in rows(result) if row[0] != "..." and float(row[3]) > 1.0]
    assert {row[0] for row in wrong} == {*outputs[1:]}
    assert all(" ".join(row).endswith("closing_ratio = 0.5") for row in wrong)


def test_the_sample_is_that_of_its_seed(gradhesion: Call, file: Path) -> None:
    first, again, other = (gradhesion("verify", file, "--sample=3", f"--seed={seed}").stdout for seed in (5, 5, 6))
    assert first == again != other
    assert "3 of 24 scenes" in first
    assert re.search(r"--seed \d+", gradhesion("verify", file, "--sample=1").stdout)


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
    """By its sha256; where that fits, by its coordinates, or by its values."""
    edit_study(file, old, new, seal=False)
    assert gradhesion("verify", file).exit_code == 2
    edit_study(file, new, new, seal=True)
    result = gradhesion("verify", file, "--sample=8", "--seed=2")
    assert result.exit_code == code
    if code == 2:
        assert result.stderr.startswith(f"{file}: ")
        assert result.stderr.count("\n") == 1


def test_an_edited_coordinate_is_told(gradhesion: Call, file: Path) -> None:
    change(file, "lambda_over_R", 2, 0.47 * (1 + 1e-13))
    result = gradhesion("verify", file)
    assert result.exit_code == 2
    assert "lambda_over_R[2]" in result.stderr


def test_scenes_without_a_value_must_have_none_and_others_one(gradhesion: Call, file: Path) -> None:
    values = [name for name in OUTPUTS if not name.endswith("_jumps")]
    blank = {"status": 64} | dict.fromkeys(OUTPUTS, -1) | dict.fromkeys(values, np.nan)
    for name, value in blank.items():
        change(file, name, 0, value)
    result = gradhesion("verify", file, *ALL)
    assert result.exit_code == 0, result.stderr
    assert "12 of 24 scenes recomputed" in result.stdout
    for name, value in (("pull_off_radius", 0.2), ("loading_jumps", 1)):
        change(file, name, (0, 1, 1, 1), value)
        result = gradhesion("verify", file, *ALL)
        assert result.exit_code == 3
        assert rows(result)[0][:4] == [name, "inf", "0", "inf"]
        change(file, name, (0, 1, 1, 1), blank[name])
    change(file, "pull_off_force", (1, 0, 1, 1), np.nan)
    result = gradhesion("verify", file, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][:2] == ["pull_off_force", "inf"]


def test_scenes_of_too_many_waves_are_left_out_and_others_drawn(gradhesion: Call, made: Callable[..., Path]) -> None:
    some = {"A": [0.0, 0.05], "a_max_over_R": [0.5, 1.0]}
    result = gradhesion("verify", made(parameters=some | {"lambda_over_R": [1e-5, 0.2]}), *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "12 of 16 scenes recomputed" in result.stdout  # without amplitude a wavelength of any size is fine
    assert gradhesion("verify", made(parameters=some | {"A": 0.05, "lambda_over_R": 1.1e-5})).exit_code == 2


def test_errors_that_a_dataset_tells_of_its_values_are_held_against_them(gradhesion: Call, file: Path) -> None:
    """As versions up to 0.3 wrote them, where the study asked for them."""
    edit_study(
        file, 'outputs = ["pull_off_force", ', 'outputs = ["pull_off_force", "pull_off_force_error", ', seal=True
    )
    with netCDF4.Dataset(file, "a") as old:
        error = old.createVariable("pull_off_force_error", "f8", old["pull_off_force"].dimensions)
        error[:] = 1e-10
        old["pull_off_force"][0, 0, 0, 0] += 9e-11
        old["pull_off_force"][0, 0, 1, 0] += 2e-10
    result = gradhesion("verify", file, *ALL)
    assert result.exit_code == 3
    assert "1 of 240 values" in result.stderr
    assert [row[:3] for row in rows(result)[:2]] == [["pull_off_force", size, "1e-10"] for size in ("2e-10", "9e-11")]


def test_of_several_solvers_those_with_a_twin_are_recomputed(gradhesion: Call, made: Callable[..., Path]) -> None:
    path = made(method={"solver": ["asymptotic", "envelope", "exact"]})
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "48 of 48 scenes recomputed" in result.stdout
    assert "all of the solver asymptotic" in result.stdout
    change(path, "pull_off_force", 0, lambda values: 2.0 * values)  # nobody knows
    change(path, "pull_off_force", (1, 0, 2, 1, 1), lambda value: value * (1 + 1e-11))
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 3
    assert "1 of 144 values" in result.stderr
    assert " ".join(rows(result)[0][4:]).startswith("solver = envelope, k = 0, ")
    edit_study(path, '"envelope", "exact"', '"exact", "envelope"', seal=True)
    assert gradhesion("verify", path).exit_code == 2


def test_a_rim_given_in_the_jump_in_radius_is_recomputed(
    gradhesion: Call, data: dict[str, Any], made: Callable[..., Path]
) -> None:
    del data["parameters"]["a_max_over_R"]
    path = made(exit_code=3, parameters={"A": [0.0, 0.023, 9.0], "a_max_over_a2": [0.7, 1.3, 2.1]})  # r > s at A = 9
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    change(path, "a_max_over_R", (0, 0, 0, 0), lambda value: value * (1 + 1e-12))
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][0] == "a_max_over_R"
    change(path, "a_max_over_R", (0, 0, 0, 0), np.nan)
    assert "1 of" in gradhesion("verify", path, *ALL).stderr


def test_a_status_excuses_counts_near_a_jump_and_values_that_failed(gradhesion: Call, file: Path) -> None:
    cell = (1, 2, 1, 0)
    change(file, "status", cell, 16)
    change(file, "loading_jumps", cell, lambda count: count + 1)
    result = gradhesion("verify", file, *ALL)
    assert result.exit_code == 0
    change(file, "dissipated_energy", cell, lambda value: value * (1 + 1e-11))
    assert gradhesion("verify", file, *ALL).exit_code == 3
    change(file, "status", cell, 32)
    assert gradhesion("verify", file, *ALL).exit_code == 0


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize(
    "profile",
    [
        {"exponent": 1.4, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "cos": 0.2, "sin": -0.1}]},
        {"exponent": 3.0, "harmonics": [{"n": 2, "sin": 0.4}]},
    ],
    ids=["two waves", "a sine"],
)
def test_all_outputs_of_any_profile_and_control_are_recomputed(
    profile: dict[str, Any], control: str, gradhesion: Call, made: Callable[..., Path]
) -> None:
    stiffness = {"machine_stiffness": [0.02, 5.0]} if control == "machine" else {}
    parameters = {"lambda_over_R": 0.3, "A": [0.0, 0.05], "a_max_over_R": [0.2, 0.7]}
    path = made(outputs=[*OUTPUTS], profile=profile, loading={"control": control} | stiffness, parameters=parameters)
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
