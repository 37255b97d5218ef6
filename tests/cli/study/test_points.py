"""Points from a file are those of lists; the study keeps the file's name and sha256, and a changed file is refused."""

import hashlib
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.dataset import compute
from gradhesion.cli.errors import StudyError
from gradhesion.cli.study import load_study, study_from
from gradhesion.cli.study.points import points_of

Call = Callable[..., Result]

LISTS: dict[str, list[float]] = {
    "modulus": [430.0, 517.3, 611.9],
    "lambda_over_R": [0.11, 0.23, 0.17],
    "A": [0.0, 0.023, 0.041],
    "a_max_over_R": [1.7, np.inf, 0.9],
}
STUDY = """\
title = "Drawn"   # a comment stays
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
    """A study with its file."""
    (tmp_path / "samples.csv").write_text(TABLE)
    path = tmp_path / "drawn.toml"
    path.write_text(STUDY)
    return path


def in_lists() -> dict[str, Any]:
    """The same study without a file."""
    parameters = {"k": 0.31, "nu": 0.27, "c0_over_R": 0.013, **LISTS}
    return {"title": "Drawn", "layout": "points", "outputs": ["pull_off_force"], "parameters": parameters}


def mistakes(path: Path, *overrides: str) -> list[str]:
    """List what is wrong with a study."""
    with pytest.raises(StudyError) as caught:
        load_study(path, overrides)
    return list(caught.value.mistakes)


def test_a_file_gives_what_lists_give(study: Path) -> None:
    found, lists = load_study(study), study_from(in_lists())
    assert found.sizes == lists.sizes == {"scene": 3}
    assert list(found.parameters) == list(lists.parameters)
    for name, values in lists.parameters.items():
        np.testing.assert_array_equal(found.parameters[name], values)
    np.testing.assert_array_equal(compute(found)["pull_off_force"], compute(lists)["pull_off_force"])


def test_the_stored_study_has_the_fingerprint_and_is_read_again(study: Path) -> None:
    found = load_study(study)
    table = {"file": "samples.csv", "sha256": hashlib.sha256(TABLE.encode()).hexdigest()}
    assert tomllib.loads(found.text)["parameters"]["points"] == table
    assert "# a comment stays" in found.text
    assert "# beside the study" in found.text
    study.write_text(found.text)
    assert load_study(study).text == found.text
    assert load_study(study, ['title="Other"']).points.sha256 == table["sha256"]
    assert tomllib.loads(load_study(study, ['parameters.points="samples.csv"']).text) == tomllib.loads(found.text)


@pytest.mark.parametrize(
    "line",
    ["points = 'samples.csv'", 'parameters.points = "samples.csv" # x', 'parameters = { points = "samples.csv" }'],
)
def test_however_it_is_written(line: str, study: Path) -> None:
    rest = {"k": 0.31, "nu": 0.27, "c0_over_R": 0.013}
    beside = "".join(f"{name} = {value}\n" for name, value in rest.items())
    if line.startswith("points"):
        text = f'outputs = ["pull_off_force"]\n[parameters]\n{line}\n{beside}'
    elif "{" in line:
        inner = ", ".join(f"{name} = {value}" for name, value in rest.items())
        text = f'outputs = ["pull_off_force"]\n{line.replace(" }", ", " + inner + " }")}\n'
    else:
        text = line + "\n" + "".join(f"parameters.{name} = {value}\n" for name, value in rest.items())
        text += 'outputs = ["pull_off_force"]\n'
    study.write_text(text)
    found = load_study(study)
    assert tomllib.loads(found.text)["parameters"]["points"]["sha256"] == found.points.sha256
    assert found.scenes == 3


def test_another_file_is_refused_with_exit_2(study: Path, gradhesion: Call, tmp_path: Path) -> None:
    study.write_text(load_study(study).text)
    (tmp_path / "samples.csv").write_text(TABLE.replace("0.041", "0.042"))
    result = gradhesion("run", study, "-o", tmp_path / "out.nc")
    assert result.exit_code == 2
    assert f"{study}:5: parameters.points = " in result.stderr
    assert "the file is not the one that this study was written for" in result.stderr
    assert not (tmp_path / "out.nc").exists()


def test_units_are_those_of_the_header(study: Path, tmp_path: Path) -> None:
    (tmp_path / "samples.csv").write_text("R [um],A [%]\n25,0.0\n2.5,1\n")
    study.write_text(
        'outputs = ["pull_off_force"]\n[parameters]\npoints = "samples.csv"\nk = 0.0\nnu = 0.3\n'
        '[physical]\nE_star = "1 GPa"\nwork_of_adhesion = "50 mJ/m^2"\nwavelength = "0.1 um"\n'
    )
    dataset = compute(load_study(study))
    np.testing.assert_array_equal(dataset["R"], [25e-6, 2.5e-6])
    np.testing.assert_array_equal(dataset["A"], [0.0, 0.01])
    assert dataset["pull_off_force_si"][0].item() == pytest.approx(1.5 * np.pi * 25e-6 * 0.05, rel=1e-14)
    for header, words in {
        "R,A": "has no unit; write it after",
        "R [um],A [m]": '"m" is not a unit of this quantity; a number without a unit is expected',
        "R [N],A": "not a unit of this quantity",
    }.items():
        (tmp_path / "samples.csv").write_text(f"{header}\n5,0.0\n")
        assert any(words in line for line in mistakes(study)), header


def test_a_table_in_netcdf(study: Path, tmp_path: Path) -> None:
    xarray.Dataset({name: ("draw", values) for name, values in LISTS.items()}).to_netcdf(tmp_path / "samples.nc")
    found = load_study(study, ['parameters.points="samples.nc"'])
    for name, values in LISTS.items():
        np.testing.assert_array_equal(found.parameters[name], values)


WRONG = {
    (): "the file has 0 bytes",
    ("lambda_over_R", "lambda_ovr_R"): 'its column "lambda_ovr_R" is not a parameter; did you mean "lambda_over_R"?',
    ("A,", "pull_off_force,"): 'its column "pull_off_force" is an output, not a parameter',
    ("0.023", "nan"): "line 3: A is missing (NaN); give it, or remove the row",
    ("0.041", "-0.041"): "line 4: A = -0.041 is out of range; choose a value with A >= 0, and finite",
    ("517.3", "inf"): "line 3: modulus = inf is out of range",
    ("611.9", "six"): 'line 4: modulus = "six" is not a number; write one',
    ("430.0,", "430.0"): "line 2 has 3 values under 4 names",
    ("1.7", "nan"): "line 2: a_max_over_R is missing (NaN)",
    ("0.9", "-0.9"): "line 4: a_max_over_R = -0.9 is out of range",
    ("A,", "k,"): "k is given under [parameters] and as a column of the file; keep one of the two",
    ("0.11,0.0,1.7\n517.3", "nan,0.0,1.7\nnan"): "line 2: lambda_over_R is missing",
}


@pytest.mark.parametrize("change", WRONG, ids=str)
def test_every_mistake_names_study_line_value_and_remedy(change: tuple[str, ...], study: Path, tmp_path: Path) -> None:
    (tmp_path / "samples.csv").write_text(TABLE.replace(*change) if change else "")
    found = mistakes(study)
    assert any(line.startswith(f'{study}:5: parameters.points = "samples.csv": ') for line in found)
    assert any(WRONG[change] in line for line in found), found


def test_several_rows_are_counted(study: Path, tmp_path: Path) -> None:
    (tmp_path / "samples.csv").write_text("\n".join(["A,modulus,lambda_over_R", *(9 * ["nan,500,0.1"])]))
    assert any("line 2: A is missing (NaN), and 8 more rows are as well" in line for line in mistakes(study))


def test_what_is_no_file(study: Path) -> None:
    for value, words in {
        '"absent.csv"': "cannot be read (No such file",
        "3": "parameters.points = 3: ",
        '""': 'parameters.points = "": ',
        "{ file = 3 }": "parameters.points.file = 3: ",
        '{ file = "samples.csv", sha256 = "abc" }': 'parameters.points.sha256 = "abc": ',
        '{ sha256 = "' + 64 * "0" + '" }': "parameters.points.file: ",
        '{ file = "samples.csv", sha265 = "" }': 'did you mean "sha256"',
    }.items():
        assert any(words in line for line in mistakes(study, f"parameters.points={value}")), value
    assert len(mistakes(study, 'parameters.points="absent.csv"')) == 1, "nothing is missing that the file would give"


def test_rows_are_points_and_all_lists_of_one_length(study: Path) -> None:
    assert "layout = " in mistakes(study, 'layout="grid"')[0]
    assert any("it has 3 values, but k has 2" in line for line in mistakes(study, "parameters.k=[0.1, 0.2]"))
    assert load_study(study, ["parameters.k=[0.1, 0.2, 0.3]", 'layout="points"']).scenes == 3


def test_in_python_the_file_is_beside_the_study(study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    loaded = gr.load(study)
    assert gr.run(loaded, set={"parameters.k": 0.0})["k"].values.tolist() == [0.0, 0.0, 0.0]
    monkeypatch.chdir(tmp_path)
    assert gr.load(tomllib.loads(study.read_text())).scenes == 3


def test_verify_takes_the_file_or_else_what_the_dataset_has_of_it(
    study: Path, gradhesion: Call, tmp_path: Path
) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study, "-o", output, "--quiet").exit_code == 0
    with xarray.open_dataset(output) as dataset:
        commented = [name for name in dataset.coords if "samples.csv" in dataset[name].attrs.get("comment", "")]
    assert sorted(map(str, commented)) == sorted(LISTS)
    assert gradhesion("verify", output, "--sample", "2").exit_code == 0
    (tmp_path / "samples.csv").unlink()
    assert gradhesion("verify", output, "--sample", "2").exit_code == 0


def test_shards_and_their_merge_find_the_file(
    study: Path, gradhesion: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output, whole = tmp_path / "elsewhere" / "out.nc", tmp_path / "whole.nc"
    output.parent.mkdir()
    monkeypatch.chdir(output.parent)
    monkeypatch.setenv("GRADHESION_CHUNK", "1")
    arguments = ["run", study, "-o", output, "--quiet"]
    for shard in ("1/2", "2/2"):
        assert gradhesion(*arguments, "--shard", shard).exit_code == 0
    table = (tmp_path / "samples.csv").read_text()
    (tmp_path / "samples.csv").write_text(table + "1,1,1,1\n")
    refused = gradhesion("merge", output)
    assert refused.exit_code == 2
    assert "samples.csv" in refused.stderr
    (tmp_path / "samples.csv").write_text(table)
    merged = gradhesion("merge", output, "--quiet")
    assert merged.exit_code == 0, merged.stderr
    gradhesion("run", study, "-o", whole, "--quiet")
    with xarray.open_dataset(output) as one, xarray.open_dataset(whole) as other:
        np.testing.assert_array_equal(one["pull_off_force"], other["pull_off_force"])


@pytest.mark.slow
def test_a_million_rows_are_read_in_seconds(tmp_path: Path) -> None:
    """In no more than a few times what it takes to cut the text into numbers."""
    import time

    rows = 10**6
    columns = {
        "modulus": np.linspace(100, 900, rows),
        "A": np.linspace(0, 0.1, rows),
        "lambda_over_R": np.full(rows, 0.1),
    }
    text = "\n".join(
        [
            ",".join(columns),
            *(f"{m!r},{a!r},{w!r}" for m, a, w in zip(*(values.tolist() for values in columns.values()), strict=True)),
        ]
    )
    (tmp_path / "samples.csv").write_text(text)
    parameters = {"points": "samples.csv", "k": 0.0, "nu": 0.3}
    start = time.process_time()
    sum(len([float(cell) for cell in line.split(",")]) for line in text.split("\n")[1:])
    plain = time.process_time() - start
    start = time.process_time()
    study = study_from({"outputs": ["pull_off_force"], "parameters": parameters}, folder=tmp_path)
    assert time.process_time() - start < 5 * plain
    assert study.scenes == rows
    assert len(study.text) < 1000


def test_what_a_file_holds_may_be_known(study: Path) -> None:
    data = tomllib.loads(load_study(study).text)
    columns = {name: np.array(values) for name, values in LISTS.items()}
    assert points_of(data, Path("/nowhere"), columns).columns is columns
    assert study_from(data, folder="/nowhere", columns=columns).scenes == 3
