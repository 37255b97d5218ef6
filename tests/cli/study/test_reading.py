"""The text of a study: where its mistakes are told, with exit 2 and nothing written; overrides, included studies, its schema."""

import json
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.terminal.messages import printable_line
from gradhesion.core.problem.inputs import INPUTS
from tests.cli.conftest import Call, Made, Told
from tests.conftest import mistakes

GOOD = """\
title = "Good"
kind = "map"
layout = "grid"
outputs = ["pull_off_force"]

[parameters]
k = [0.0, 0.5]
nu = 0.3
modulus = 500.0
c0_over_R = 0.01
lambda_over_R = { start = 0.1, stop = 0.5, num = 3, spacing = "log" }
A = 0.1
a_max_over_R = inf

[method]
solver = "exact"
"""
PLACES = [  # what is replaced, by what, and where the mistake is
    ("kind = ", "kind ", "2"),
    ("nu = 0.3", "nu = 0,3", "8"),
    ("start = 0.1", "start = 0,1", "11"),
    ("nu = 0.3", "nu = 0.3\nnu = 0.4", "9"),
    ("nu = 0.3", "nu = 0.3\n[parameters]", "9"),
    ("R = inf", "R = [", ""),
    ("R = inf", "R = " + 3000 * "[", ""),
    ("R = inf", "R = " + 5000 * "1", ""),
    ("[parameters]", "[parameter]", "6: parameter"),
    ("nu = 0.3\n", "", "6: parameters.nu"),
    ("nu = 0.3", "nu = 2020-01-01", "8: parameters.nu"),
    ("modulus = 500.0", "modulus = 1" + 400 * "0", "9: parameters.modulus"),
]
OVERRIDES = {"": ("parameters.k", "=3", "parameters..k=3", "layout=points", "parameters.k=", "parameters.k=0,0.1", "parameters.k=0.1\nA=3",
                  'include="base.toml"'),
             "title": ("title.x=3",), "parameters.kk": ("parameters.kk=0.1",), "parameters.k": ("parameters.k=2",), "nothing": ("nothing.at.all=1",),
             "parameters.lambda_over_R.num": ("parameters.lambda_over_R={start=1, stop=2, num=0}", "parameters.lambda_over_R.num=0")}  # fmt: skip
"""Wrong overrides by the keys at which they are refused; empty for what is no override."""
Refused = Callable[..., list[str]]


@pytest.fixture
def refused(gradhesion: Call, write_study: Made, tmp_path: Path) -> Refused:
    """Run a text as a study that must be refused, and give the lines of the message."""

    def run(text: str, *arguments: str) -> list[str]:
        path = write_study(text)
        result = gradhesion("run", path, "-o", tmp_path / "out.nc", *arguments, code=2)
        assert not result.stdout
        assert "Traceback" not in result.stderr
        assert [item.name for item in tmp_path.iterdir()] == ["study.toml"], "nothing is written"
        return [line.replace(str(path), "study.toml") for line in result.stderr.splitlines()]

    return run


@pytest.mark.parametrize(("old", "new", "place"), PLACES)
def test_a_mistake_names_its_line_and_what_is_no_toml_is_one(old: str, new: str, place: str, refused: Refused) -> None:
    assert old in GOOD
    sentences = refused(GOOD.replace(old, new, 1))
    beginning = f"study.toml:{place}" if place else "study.toml"
    assert any(re.match(re.escape(beginning) + "[ :]", sentence) for sentence in sentences), sentences
    assert all(";" in sentence or "?" in sentence for sentence in sentences)
    assert len(sentences) == 1 or "parameter" in place


def test_all_mistakes_are_told_at_once_in_the_order_of_their_lines(refused: Refused) -> None:
    text = GOOD.replace('"map"', '"mop"').replace('"grid"', '"gird"').replace("pull_off", "pull_of")
    text = text.replace("nu = 0.3", 'nu = "0.3"').replace("num = 3", "num = 3, base = 2").replace("exact", "exakt")
    text = text.replace("A = 0.1", "A = [0.1, 0.2, 0.1]").replace("[0.0, 0.5]", "[0.0, -2.0, 7.0]")
    lines = refused(text, "--set", "parameters.modulus=-1")
    assert lines[0].startswith("--set parameters.modulus=-1: parameters.modulus = -1: out of range")
    keys = "2: kind, 3: layout, 4: outputs[0], 7: parameters.k[1], 7: parameters.k[2], 8: parameters.nu"
    keys += ", 11: parameters.lambda_over_R.base, 12: parameters.A, 16: method.solver"
    assert [line.removeprefix("study.toml:").split(" = ")[0] for line in lines[1:]] == keys.split(", ")


def test_a_thousand_mistakes_do_not_flood_the_screen(refused: Refused) -> None:
    lines = refused(GOOD.replace("[0.0, 0.5]", str([-1.0 - i for i in range(1000)])))
    assert len(lines) == 31
    assert "970 more mistakes" in lines[-1]


@pytest.mark.parametrize(("key", "override"), [(key, one) for key, own in OVERRIDES.items() for one in own])
def test_a_wrong_override_is_named_by_its_own_text(key: str, override: str, refused: Refused) -> None:
    (line,) = refused(GOOD, "--set", override)
    assert re.match(re.escape(f"--set {printable_line(override)}: {key}") + (r"(?![.\w])" if key else ""), line), line
    assert ";" in line


def test_a_file_that_is_no_study(refusal: Told, tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    assert refusal("run", path).startswith(f"{path}: ")
    for content, line in ((b'title = "\xff"', 1), (b"\x00\x01\x02", 1), (b"\n\n\nk = \n", 4)):
        path.write_bytes(content)
        assert refusal("run", path).startswith(f"{path}:{line}: ")
    assert refusal("run", tmp_path).startswith(f"{tmp_path}: ")


def test_an_endless_file_is_not_read_for_ever() -> None:
    with pytest.raises(StudyError, match="larger than 64 MiB"):
        load_study("/dev/zero")


def test_a_study_made_in_python_is_checked_alike() -> None:
    told = mistakes(study_from, {"outputs": ["delta_max"], "parameters": {"k": (0.1, 2.0)}}, name="mine")
    assert told[0] == "mine: parameters.k[1] = 2.0: out of range; choose a value with 0 <= k <= 1"
    assert len(told) == 6
    itself: list[object] = []
    itself.append(itself)
    with pytest.raises(StudyError, match="nested more than"):
        study_from({"outputs": itself})


BASE = """outputs = ["pull_off_force"]
[parameters]
k = 0.3
nu = 0.3
modulus = 500.0
c0_over_R = 0.01
lambda_over_R = { start = 0.1, stop = 1.0, num = 3 }
A = 0.1
"""


def test_a_study_may_include_another(tmp_path: Path) -> None:
    (tmp_path / "base.toml").write_text(BASE)
    below = tmp_path / "below"
    below.mkdir()
    (below / "study.toml").write_text('include = "../base.toml"\n[parameters]\nk = [0.0, 0.5]\nlambda_over_R = 0.2\n')
    study = load_study(below / "study.toml", ["parameters.A=0.02"])
    assert study.name == "study"
    assert (study.parameters["nu"], study.parameters["lambda_over_R"], study.parameters["A"]) == (0.3, 0.2, 0.02)
    assert study.sizes == {"k": 2}, "a value is replaced, a table is merged"
    (tmp_path / "again.toml").write_text(study.text)
    assert "include" not in study.text
    assert load_study(tmp_path / "again.toml").sha256 == study.sha256
    mapping = {"include": "base.toml", "parameters": {"k": [0.0, 0.5], "lambda_over_R": 0.2, "A": 0.02}}
    assert study_from(mapping, "study", folder=tmp_path).text == study.text


INCLUDING = [
    ('include = "base.toml"\n', BASE.replace("A = 0.1", "A = -1"), "base.toml:8", "parameters.A = -1"),
    ('include = "base.toml"\nlayout = "gird"\n', BASE, "study.toml:2", "layout"),
    ('include = "base.toml"\n', "include = 'study.toml'", "base.toml:1", "study.toml includes"),
    ('include = "study.toml"\n', "", "study.toml:1", "study.toml includes"),
    ('include = "other.toml"\n', "", "study.toml:1", "other.toml"),
    ("include = 3\n", "", "study.toml:1", "include = 3"),
    ('include = "base.toml"\n', "k = ", "base.toml:1", "not valid TOML"),
]


@pytest.mark.parametrize(("text", "base", "place", "words"), INCLUDING)
def test_what_is_wrong_with_an_included_study(text: str, base: str, place: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text(text)
    (tmp_path / "base.toml").write_text(base)
    (sentence,) = mistakes(load_study, tmp_path / "study.toml")
    assert sentence.startswith(f"{tmp_path / place}: ")
    assert words in sentence


def test_a_valid_study_and_all_mistakes_of_another(gradhesion: Call, study_file: Path) -> None:
    axes = "k (2), lambda_over_R (3), A (2), a_max_over_R (2)"
    outputs = "pull_off_force, dissipated_energy, loading_jumps"
    told = gradhesion("validate", study_file, code=0).stdout
    assert told == f"{study_file}: valid; a map of 24 scenes; axes: {axes}; outputs: {outputs}\n"
    result = gradhesion("validate", study_file, "--set=parameters.nu=0.7", "--set=parameters.k=-1.0")
    assert (result.exit_code, result.stdout, len(result.stderr.splitlines())) == (2, "", 2)


def test_the_schema_is_that_of_validation(gradhesion: Call, root: Path) -> None:
    told = json.loads(gradhesion("schema").stdout)
    assert told.pop("$schema").startswith("https://json-schema.org/")
    assert told == Form.model_json_schema()
    types = re.findall(r'"type": "(\w+)"', json.dumps(told))
    assert {*types} <= {"array", "boolean", "integer", "null", "number", "object", "string"}
    own = told["$defs"]["Parameters"]
    assert set(own["properties"]) == {"points", *(name for name, one in INPUTS.items() if one.table == "parameters")}
    assert own["additionalProperties"] is False
    for config in (root / "configs").glob("*.toml"):
        keys = tomllib.loads(config.read_text())
        assert keys.keys() <= told["properties"].keys()
        assert keys["parameters"].keys() <= own["properties"].keys()
