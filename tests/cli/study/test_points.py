"""Points from a file are those of lists; the study keeps the file's name and sha256, and a changed file is refused."""

import hashlib
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.cli.study import load_study, study_from
from tests.cli.conftest import Call, Patch, mistakes_of

LISTS: dict[str, list[float]] = {
    "modulus": [430.0, 517.3, 611.9],
    "lambda_over_R": [0.11, 0.23, 0.17],
    "A": [0.0, 0.023, 0.041],
    "a_max_over_R": [1.7, np.inf, 0.9],
}
REST = {"k": 0.31, "nu": 0.27, "c0_over_R": 0.013}
STUDY = """title = "Drawn"   # a comment stays
outputs = ["pull_off_force"]

[parameters]
points = "samples.csv"   # beside the study
k = 0.31
nu = 0.27
c0_over_R = 0.013
"""
TABLE = "\n".join([",".join(LISTS), *(",".join(map(repr, row)) for row in zip(*LISTS.values(), strict=True))]) + "\n"


@pytest.fixture
def study(tmp_path: Path) -> Path:
    (tmp_path / "samples.csv").write_text(TABLE)
    path = tmp_path / "drawn.toml"
    path.write_text(STUDY)
    return path


def test_a_file_gives_what_lists_give(study: Path, tmp_path: Path) -> None:
    lists = study_from({"layout": "points", "outputs": ["pull_off_force"], "parameters": REST | LISTS})
    xarray.Dataset({name: ("draw", values) for name, values in LISTS.items()}).to_netcdf(tmp_path / "samples.nc")
    for found in (load_study(study), load_study(study, ['parameters.points="samples.nc"'])):
        assert found.sizes == lists.sizes == {"scene": 3}
        assert list(found.parameters) == list(lists.parameters)
        for name, values in lists.parameters.items():
            np.testing.assert_array_equal(found.parameters[name], values)


def test_the_stored_study_has_the_fingerprint_and_is_read_again(study: Path, tmp_path: Path) -> None:
    found = load_study(study)
    table = {"file": "samples.csv", "sha256": hashlib.sha256(TABLE.encode()).hexdigest()}
    assert tomllib.loads(found.text)["parameters"]["points"] == table
    assert found.text.count("#") == 2, "comments stay"
    study.write_text(found.text)
    assert load_study(study).text == found.text
    assert load_study(study, ['title="Other"']).points.sha256 == table["sha256"]
    assert tomllib.loads(load_study(study, ['parameters.points="samples.csv"']).text) == tomllib.loads(found.text)
    columns = {name: np.array(values) for name, values in LISTS.items()}
    assert study_from(tomllib.loads(found.text), folder="/nowhere", columns=columns).scenes == 3, "the file is known"
    (tmp_path / "samples.csv").write_text(TABLE.replace("0.041", "0.042"))
    (sentence,) = mistakes_of(study)
    assert sentence.startswith(f"{study}:5: parameters.points = ")


def test_however_it_is_written(study: Path) -> None:
    pairs = [f"{name} = {value}" for name, value in REST.items()]
    for text in (
        "[parameters]\npoints = 'samples.csv'\n" + "\n".join(pairs),
        f'parameters = {{ points = "samples.csv", {", ".join(pairs)} }}\n',
        'parameters.points = "samples.csv" # x\n' + "".join(f"parameters.{pair}\n" for pair in pairs),
    ):
        study.write_text(f'outputs = ["pull_off_force"]\n{text}')
        found = load_study(study)
        assert tomllib.loads(found.text)["parameters"]["points"]["sha256"] == found.points.sha256
        assert found.scenes == 3


def test_units_are_those_of_the_header(study: Path, tmp_path: Path) -> None:
    known = {"k": 0.0, "nu": 0.3, "points": "samples.csv"}
    physical = {"E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "wavelength": "0.1 um"}
    for header in ("R [um],A [%]", "R (um),A (%)"):
        (tmp_path / "samples.csv").write_text(f"{header}\n25,0.0\n2.5,1\n")
        keys = {"outputs": ["pull_off_force"], "parameters": known, "physical": physical}
        found = study_from(keys, folder=study.parent).parameters
        np.testing.assert_array_equal(found["R"], [25e-6, 2.5e-6])
        np.testing.assert_array_equal(found["A"], [0.0, 0.01])


WRONG = {
    ("lambda_over_R", "lambda_ovr_R"): 'did you mean "lambda_over_R"?',
    ("A,", "pull_off_force,"): '"pull_off_force"',
    ("0.023", "nan"): "line 3: A is missing",
    ("0.041", "-0.041"): "line 4: A = -0.041",
    ("517.3", "inf"): "line 3: modulus = inf",
    ("A,", "k,"): "k is given under [parameters] and as a column",
    ("0.11,0.0,1.7\n517.3,0.23", "nan,0.0,1.7\n517.3,nan"): "line 2: lambda_over_R is missing (NaN), and 1 more row",
}


@pytest.mark.parametrize("change", WRONG, ids=str)
def test_every_mistake_names_study_line_value_and_remedy(change: tuple[str, str], study: Path, tmp_path: Path) -> None:
    (tmp_path / "samples.csv").write_text(TABLE.replace(*change))
    found = mistakes_of(study)
    assert any(line.startswith(f'{study}:5: parameters.points = "samples.csv": ') for line in found)
    assert any(WRONG[change] in line for line in found), found


NO_FILES = {
    '"absent.csv"': 'points = "absent.csv": ',
    "3": "points = 3: ",
    '""': 'points = "": ',
    "{ file = 3 }": "points.file = 3: ",
    '{ file = "samples.csv", sha256 = "abc" }': 'points.sha256 = "abc": ',
    '{ sha256 = "' + 64 * "0" + '" }': "points.file: ",
    '{ file = "samples.csv", sha265 = "" }': 'points.sha265 = "": ',
}


@pytest.mark.parametrize("value", NO_FILES)
def test_what_is_no_file(value: str, study: Path) -> None:
    found = mistakes_of(study, f"parameters.points={value}")
    assert any(f": parameters.{NO_FILES[value]}" in line for line in found), found
    assert len(found) == 1 or "absent" not in value, "nothing is missing that the file would give"


def test_rows_are_points_and_all_lists_of_one_length(study: Path) -> None:
    assert "layout = " in mistakes_of(study, 'layout="grid"')[0]
    assert any("it has 3 values, but k has 2" in line for line in mistakes_of(study, "parameters.k=[0.1, 0.2]"))
    assert load_study(study, ["parameters.k=[0.1, 0.2, 0.3]", 'layout="points"']).scenes == 3


def test_python_and_verify_find_the_file(study: Path, gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    """Or what the dataset has of it."""
    assert gr.run(gr.load(study), set={"parameters.k": 0.0})["k"].values.tolist() == [0.0, 0.0, 0.0]
    output = tmp_path / "out.nc"
    assert gradhesion("run", study, "-o", output, "--quiet").exit_code == 0
    with xarray.open_dataset(output) as dataset:
        commented = [name for name in dataset.coords if "samples.csv" in dataset[name].attrs.get("comment", "")]
    assert sorted(map(str, commented)) == sorted(LISTS)
    monkeypatch.chdir(tmp_path)
    assert gr.load(tomllib.loads(study.read_text())).scenes == 3
    (tmp_path / "samples.csv").unlink()
    assert gradhesion("verify", output, "--sample", "2").exit_code == 0


def test_shards_and_merge_find_the_file(study: Path, gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    output, whole = tmp_path / "elsewhere" / "out.nc", tmp_path / "whole.nc"
    output.parent.mkdir()
    monkeypatch.chdir(output.parent)
    monkeypatch.setenv("GRADHESION_CHUNK", "1")
    for shard in ("1/2", "2/2"):
        assert gradhesion("run", study, "-o", output, "--quiet", "--shard", shard).exit_code == 0
    (tmp_path / "samples.csv").write_text(TABLE + "1,1,1,1\n")
    assert "samples.csv" in gradhesion("merge", output, code=2).stderr
    (tmp_path / "samples.csv").write_text(TABLE)
    assert gradhesion("merge", output, "--quiet").exit_code == 0
    gradhesion("run", study, "-o", whole, "--quiet")
    with xarray.open_dataset(output) as one, xarray.open_dataset(whole) as other:
        np.testing.assert_array_equal(one["pull_off_force"], other["pull_off_force"])
