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

Call = Callable[..., Result]
ALL = ("--sample", "100", "--seed", "1")


@pytest.fixture
def dataset_file(gradhesion: Call, data: dict[str, Any], write_study: Callable[[str], Path], tmp_path: Path) -> Path:
    """The small study with all outputs: 24 scenes."""
    from gradhesion.cli.study.reading import study_from
    from gradhesion.core import OUTPUTS

    path = tmp_path / "out.nc"
    study = write_study(study_from(data | {"outputs": list(OUTPUTS)}).text)
    assert gradhesion("run", study, "-o", path, "--quiet").exit_code == 0
    return path


def rows(result: Result) -> list[list[str]]:
    """Give the lines of the table in words."""
    lines = result.stdout.split("worst first")[1].splitlines()[1:]
    return [line.split() for line in lines[: lines.index("")]]


def edit_study(path: Path, old: str, new: str, *, seal: bool = False) -> None:
    """Change the text of a dataset's study, and its sha256 if `seal`."""
    with netCDF4.Dataset(path, "a") as file:
        assert old in file.study
        file.study = file.study.replace(old, new)
        if seal:
            file.study_sha256 = hashlib.sha256(file.study.encode()).hexdigest()


def test_a_good_dataset_stands_up(gradhesion: Call, dataset_file: Path) -> None:
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 0, result.stderr
    assert "24 of 24 scenes recomputed (--seed 1), 240 values, solver exact" in result.stdout
    assert "all 240 values are within their stated errors" in result.stdout
    shares = [float(row[3]) for row in rows(result) if row[0] != "..."]
    assert len(shares) == 12
    assert shares == sorted(shares, reverse=True)
    assert shares[0] > 0.0, "values of 53 bits are not exact"
    assert result.stderr == ""


@pytest.mark.parametrize("output", ["pull_off_force", "dissipated_energy", "loading_jumps", "delta_jump_out"])
def test_one_changed_value_is_found_and_named_first(output: str, gradhesion: Call, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        value = file[output][1, 2, 1, 0]
        file[output][1, 2, 1, 0] = value + 1 if output.endswith("_jumps") else value * (1 + 1e-11)
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][0] == output
    assert " ".join(rows(result)[0][4:]) == "k = 0.31, lambda_over_R = 0.47, A = 0.023, a_max_over_R = 0.7"
    assert "1 of 240 values deviate by more than their stated errors" in result.stderr
    assert result.stderr.startswith(f"{dataset_file}: ")


def test_loading_on_the_opening_curve_beside_a_ratio_of_1_is_found(
    gradhesion: Call, data: dict[str, Any], write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    """Version 0.3.0 wrote the loading of ratio 1 at every ratio: such a dataset is found, and a new one is not."""
    from gradhesion.cli.study.reading import study_from

    parameters = data["parameters"] | {"A": 0.03, "a_max_over_R": 0.5, "closing_ratio": [0.5, 1.0]}
    outputs = ["dissipated_energy", "delta_max", "loading_jumps"]
    path = tmp_path / "out.nc"
    study = write_study(study_from(data | {"outputs": outputs, "parameters": parameters}).text)
    assert gradhesion("run", study, "-o", path, "--quiet").exit_code == 0
    assert gradhesion("verify", path, *ALL).exit_code == 0
    with netCDF4.Dataset(path, "a") as file:
        for name in ("delta_max", "loading_jumps"):
            file[name][..., 0] = file[name][..., 1]
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 3
    wrong = [row for row in rows(result) if row[0] != "..." and float(row[3]) > 1.0]
    assert {row[0] for row in wrong} == {"delta_max", "loading_jumps"}
    assert all(" ".join(row).endswith("closing_ratio = 0.5") for row in wrong)


def test_the_sample_is_that_of_its_seed(gradhesion: Call, dataset_file: Path) -> None:
    first, again, other = (
        gradhesion("verify", dataset_file, "--sample=3", f"--seed={seed}").stdout for seed in (5, 5, 6)
    )
    assert first == again != other
    assert "3 of 24 scenes" in first
    fresh = gradhesion("verify", dataset_file, "--sample=1").stdout
    assert re.search(r"--seed \d+", fresh)


def test_digits_are_given_up_with_what_to_do_instead(gradhesion: Call, dataset_file: Path) -> None:
    result = gradhesion("verify", dataset_file, "--digits")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "gr.verify(FILE).deviations" in result.stderr


def test_an_edited_study_is_told(gradhesion: Call, dataset_file: Path) -> None:
    edit_study(dataset_file, "modulus = 430.0", "modulus = 431.0")
    result = gradhesion("verify", dataset_file)
    assert result.exit_code == 2
    assert "the text of its study was changed" in result.stderr
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("modulus = 430.0", "modulus = 431.0", "modulus is 430.0, in its study 431.0"),
        ("0.31]", "0.32]", "k[1] is 0.31, in its study 0.32"),
        ("num = 3", "num = 4", "lambda_over_R[1] is "),
        ("num = 3", "num = 2", "its study has 2 items of lambda_over_R, the dataset 3"),
        ('spacing = "log"', 'spacing = "linear"', "lambda_over_R[1] is "),
        ("stop = 0.47", "stop = 0.48", "lambda_over_R[1] is "),
        ('"pull_off_radius", ', "", None),
        ("A = [", "B = [", "its study is not valid in this version (its study: parameters."),
        ("[parameters]", "[parameters", "its study is not valid TOML"),
        ("[parameters]", "[method]\nsolver = 'asymptotic'\n[parameters]", "without an independent twin"),
        ("[parameters]", "[method]\nsolver = 'envelope'\n[parameters]", 3),
        ("[parameters]", "[method]\ncheck_contact = false\n[parameters]", None),
        ("title = ", "kind = 'curve'\ntitle = ", "contains a curve; `gradhesion verify` accepts only maps"),
    ],
)
def test_a_study_of_another_dataset_is_told(
    old: str, new: str, message: str | int | None, gradhesion: Call, dataset_file: Path
) -> None:
    """The sha256 fits, but not the dataset: by its coordinates, or by its values alone."""
    edit_study(dataset_file, old, new, seal=True)
    result = gradhesion("verify", dataset_file, "--sample=8", "--seed=2")
    if message is None:  # a study may ask for less, or for what changes no value
        assert result.exit_code == 0
        assert ("pull_off_radius" in result.stdout) == (old == "[parameters]")
    elif message == 3:
        assert result.exit_code == 3
    else:
        assert result.exit_code == 2
        assert str(message) in result.stderr
        assert result.stderr.startswith(f"{dataset_file}: ")
        assert result.stderr.count("\n") == 1


def test_an_edited_coordinate_is_told(gradhesion: Call, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["lambda_over_R"][2] = 0.47 * (1 + 1e-13)
    result = gradhesion("verify", dataset_file)
    assert result.exit_code == 2
    assert "lambda_over_R[2] is 0.47000000000004" in result.stderr
    assert "do not belong together" in result.stderr


VALUES = (
    "pull_off_force",
    "pull_off_radius",
    "dissipated_energy",
    "loading_energy",
    "unloading_energy",
    "delta_max",
    "delta_jump_out",
    "turning_radius",
)


def test_scenes_without_a_value_must_have_none(gradhesion: Call, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["status"][0] = 64
        for name in VALUES:
            file[name][0] = np.nan
        for name in ("loading_jumps", "unloading_jumps"):
            file[name][0] = -1
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 0
    assert "12 of 24 scenes recomputed" in result.stdout
    assert "12 sampled scenes have failed" in result.stdout
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["pull_off_radius"][0, 1, 1, 1] = 0.2
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][:4] == ["pull_off_radius", "inf", "0", "inf"]


def test_a_value_that_is_missing_without_a_status_is_found(gradhesion: Call, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["pull_off_force"][1, 0, 1, 1] = np.nan
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][:2] == ["pull_off_force", "inf"]


def test_scenes_of_too_many_waves_are_left_out_and_others_drawn(
    gradhesion: Call, study_file: Path, tmp_path: Path
) -> None:
    path = tmp_path / "long.nc"
    some = [
        "--set=parameters.lambda_over_R=[1e-5, 0.2]",
        "--set=parameters.A=[0.0, 0.05]",
        "--set=parameters.a_max_over_R=[0.5, 1.0]",
    ]
    assert gradhesion("run", study_file, "-o", path, "--quiet", *some).exit_code == 0
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "12 of 16 scenes recomputed" in result.stdout  # without amplitude a wavelength of any size is fine
    assert "4 sampled scenes have more waves than can be followed" in result.stdout
    result = gradhesion(
        "run",
        study_file,
        "-o",
        path,
        "--quiet",
        "--overwrite",
        *some,
        "--set=parameters.A=0.05",
        "--set=parameters.lambda_over_R=1e-5",
    )
    result = gradhesion("verify", path)
    assert result.exit_code == 2
    assert "none of the scenes drawn can be recomputed (4 have too many waves" in result.stderr


def test_errors_that_a_dataset_tells_of_its_values_are_held_against_them(gradhesion: Call, dataset_file: Path) -> None:
    """As versions up to 0.3 wrote them, where the study asked for them."""
    edit_study(
        dataset_file,
        'outputs = ["pull_off_force", ',
        'outputs = ["pull_off_force", "pull_off_force_error", ',
        seal=True,
    )
    with netCDF4.Dataset(dataset_file, "a") as file:
        error = file.createVariable("pull_off_force_error", "f8", file["pull_off_force"].dimensions)
        error[:] = 1e-10
        file["pull_off_force"][0, 0, 0, 0] += 9e-11
        file["pull_off_force"][0, 0, 1, 0] += 2e-10
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 3
    assert "1 of 240 values" in result.stderr
    assert rows(result)[0][:3] == ["pull_off_force", "2e-10", "1e-10"]
    assert rows(result)[1][:3] == ["pull_off_force", "9e-11", "1e-10"]


def test_points_and_single_scenes_and_envelopes(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    single = [f"--set=parameters.{name}=0.2" for name in ("k", "lambda_over_R", "A", "a_max_over_R")]
    for i, more in enumerate(
        ([], ["--set=layout='points'"], ["--set=layout='points'", "--set=parameters.k=[0.1, 0.9]"])
    ):
        path = tmp_path / f"{i}.nc"
        assert gradhesion("run", study_file, "-o", path, "--quiet", *single, *more).exit_code == 0
        result = gradhesion("verify", path)
        assert result.exit_code == 0, result.stdout + result.stderr
        assert f"{('1 of 1 scene', '2 of 2 scenes')[i == 2]} recomputed" in result.stdout
    path = tmp_path / "envelope.nc"
    assert gradhesion("run", study_file, "-o", path, "--quiet", "--set=method.solver='envelope'").exit_code == 0
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "24 of 24 scenes recomputed (--seed 1), 72 values, solver envelope" in result.stdout
    with netCDF4.Dataset(path, "a") as file:
        file["dissipated_energy"][1, 0, 1, 0] *= 1 + 1e-10
    assert gradhesion("verify", path, *ALL).exit_code == 3


def test_of_several_solvers_those_with_a_twin_are_recomputed(
    gradhesion: Call, study_file: Path, tmp_path: Path
) -> None:
    path = tmp_path / "several.nc"
    solvers = "--set=method.solver=['asymptotic', 'envelope', 'exact']"
    assert gradhesion("run", study_file, "-o", path, "--quiet", solvers).exit_code == 0
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "48 of 48 scenes recomputed (--seed 1), 144 values, solver envelope and exact" in result.stdout
    assert "all of the solver asymptotic: there is no independent solution to compare with" in result.stdout
    with netCDF4.Dataset(path, "a") as file:
        file["pull_off_force"][0] *= 2.0  # nobody knows
        file["pull_off_force"][1, 0, 2, 1, 1] *= 1 + 1e-11
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 3
    assert "1 of 144 values" in result.stderr
    assert " ".join(rows(result)[0][4:]).startswith("solver = envelope, k = 0, ")
    edit_study(path, '"envelope", "exact"', '"exact", "envelope"', seal=True)
    result = gradhesion("verify", path)
    assert result.exit_code == 2
    assert "its solvers are not those of its study" in result.stderr


@pytest.mark.parametrize("layout", ["grid", "points"])
def test_a_rim_given_in_the_jump_in_radius_is_recomputed(
    layout: str, data: dict[str, Any], gradhesion: Call, write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    from gradhesion.cli.study.reading import study_from

    path = tmp_path / "ratio.nc"
    parameters = data["parameters"] | {"A": [0.0, 0.023, 9.0], "a_max_over_a2": [0.7, 1.3, 2.1]}
    del parameters["a_max_over_R"]
    if layout == "points":
        parameters |= {"k": [0.0, 0.31, 0.6], "lambda_over_R": 0.3}
    study = write_study(study_from(data | {"layout": layout, "parameters": parameters}).text)
    assert gradhesion("run", study, "-o", path, "--quiet").exit_code == 3  # r > s at A = 9
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "a_max_over_R" in result.stdout.split("worst of each")[1]
    with netCDF4.Dataset(path, "a") as file:
        rim = file["a_max_over_R"]
        place = (0,) * rim.ndim
        rim[place] *= 1 + 1e-12
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][0] == "a_max_over_R"
    with netCDF4.Dataset(path, "a") as file:
        file["a_max_over_R"][place] = np.nan
    assert "1 of" in gradhesion("verify", path, *ALL).stderr


def test_a_status_that_warns_of_jumps_excuses_counts_alone(gradhesion: Call, dataset_file: Path) -> None:
    cell = (1, 2, 1, 0)
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["status"][cell] = 16
        file["loading_jumps"][cell] += 1
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 0
    assert "1 values may be either of two (loading_jumps: its status says so)" in result.stdout
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["dissipated_energy"][cell] *= 1 + 1e-11
    assert gradhesion("verify", dataset_file, *ALL).exit_code == 3


def test_a_tolerance_that_is_not_met_is_a_failure_with_values(gradhesion: Call, dataset_file: Path) -> None:
    with netCDF4.Dataset(dataset_file, "a") as file:
        file["status"][0] = 32
        file["pull_off_force"][0] *= 1.5
    result = gradhesion("verify", dataset_file, *ALL)
    assert result.exit_code == 0
    assert "12 sampled scenes have failed, as their status shows" in result.stdout


GENERAL = (
    {"exponent": 1.4, "harmonics": [{"n": 1, "cos": 1.0}, {"n": 3, "cos": 0.2, "sin": -0.1}]},
    {"exponent": 3.0, "harmonics": [{"n": 2, "sin": 0.4}]},
)


@pytest.mark.parametrize("control", ["displacement", "load", "machine"])
@pytest.mark.parametrize("profile", GENERAL, ids=["two waves", "a sine"])
def test_datasets_of_any_profile_and_control_are_recomputed(
    profile: dict[str, Any],
    control: str,
    gradhesion: Call,
    write_study: Callable[[str], Path],
    tmp_path: Path,
) -> None:
    from gradhesion.cli.study.reading import study_from
    from gradhesion.core import OUTPUTS

    path = tmp_path / "out.nc"
    quantities = {
        "R": "1 um",
        "E_star": "1 GPa",
        "work_of_adhesion": "50 mJ/m^2",
        "c0": "13 nm",
        "wavelength": "0.3 um",
    }
    loading = {"control": control} | ({"machine_stiffness": [0.02, 5.0]} if control == "machine" else {})
    study: dict[str, Any] = {
        "outputs": list(OUTPUTS),
        "profile": profile,
        "loading": loading,
        "parameters": {"k": [0.0, 0.31], "nu": 0.27, "A": [0.0, 0.05]},
        "physical": quantities | {"a_max": ["0.2 um", "0.7 um"]},
    }
    if control == "machine" and profile is GENERAL[0]:
        study["loading"] = {"control": control}
        study["physical"] |= {"spring_constant": ["20 N/m", "5000 N/m"]}
    assert gradhesion("run", write_study(study_from(study).text), "-o", path, "--quiet").exit_code == 0
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "pull_off_force_si" in result.stdout
    assert ("machine_stiffness" in result.stdout.split("worst of each")[1]) == ("spring_constant" in study["physical"])
    with netCDF4.Dataset(path, "a") as file:
        place = (1,) * file["dissipated_energy"].ndim
        file["dissipated_energy"][place] *= 1 + 1e-11
    result = gradhesion("verify", path, *ALL)
    assert result.exit_code == 3
    assert rows(result)[0][0] == "dissipated_energy"
    edit_study(path, f'control = "{control}"', 'control = "lode"', seal=True)
    assert gradhesion("verify", path).exit_code == 2


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("exponent = 1.4", "exponent = 1.5"),
        ("sin = -0.1", "sin = -0.2"),
        ('control = "displacement"', 'control = "load"'),
    ],
)
def test_another_profile_or_control_in_the_study_is_found(
    old: str, new: str, gradhesion: Call, data: dict[str, Any], write_study: Callable[[str], Path], tmp_path: Path
) -> None:
    from gradhesion.cli.study.reading import study_from

    path = tmp_path / "out.nc"
    parameters = data["parameters"] | {"lambda_over_R": 0.3, "a_max_over_R": 0.5, "A": 0.023}
    study = {
        "outputs": ["dissipated_energy"],
        "parameters": parameters,
        "profile": GENERAL[0],
        "loading": {"control": "displacement"},
    }
    assert gradhesion("run", write_study(study_from(study).text), "-o", path, "--quiet").exit_code == 0
    edit_study(path, old, new)
    assert "sha256" in gradhesion("verify", path).stderr
    edit_study(path, new, new, seal=True)
    assert gradhesion("verify", path).exit_code == 3  # the values are those of another scene


@pytest.mark.parametrize("machine", [False, True])
def test_a_study_by_youngs_modulus_is_recomputed(machine: bool, gradhesion: Call, tmp_path: Path) -> None:
    spring = ('spring_constant = "3 N/m"\n', '[loading]\ncontrol = "machine"\n') if machine else ("", "")
    (tmp_path / "probe.toml").write_text(
        'outputs = ["pull_off_force"]\n[parameters]\nk = 0.0\nnu = [-0.9, 0.3, 0.49]\nA = 0.0\n'
        '[physical]\nR = "5 um"\nE = "2 MPa"\nwork_of_adhesion = "45 mJ/m^2"\na_max = "2 um"\n' + "".join(spring)
    )
    file = tmp_path / "probe.nc"
    assert gradhesion("run", tmp_path / "probe.toml", "-o", file, "--quiet").exit_code == 0
    result = gradhesion("verify", file)
    assert result.exit_code == 0, result.stderr
    with netCDF4.Dataset(file, "a") as dataset:
        dataset["modulus"][:] = dataset["modulus"][:] * (1.0 + 1e-12)
    assert gradhesion("verify", file).exit_code == 3
