"""Sentences that once led astray: each names what was meant."""

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.installation import refuse_without_threads
from gradhesion.cli.study import load_study, study_from
from gradhesion.cli.terminal.wording import CALLED, nearest

Call = Callable[..., Result]

PUNCH: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 1.0}  # fmt: skip
AFM: dict[str, Any] = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm", "wavelength": "100 nm"}  # fmt: skip


def without_none(table: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if value is not None}


def of_units(A: float | None = 0.02, **changes: Any) -> dict[str, Any]:
    """A study with units, but for what is changed; None leaves a key out."""
    return {"parameters": without_none({"k": 0.3, "nu": 0.3, "A": A}), "physical": without_none(AFM | changes)}


def search(word: str) -> dict[str, Any]:
    """A search for the greatest force, by the word for that."""
    goal = {word: "pull_off_force", "over": ["A"]}
    return {
        "kind": "optimum",
        "outputs": None,
        "parameters": PUNCH | {"A": {"start": 0.01, "stop": 0.1}},
        "optimum": goal,
    }


STUDIES: dict[str, tuple[dict[str, Any], str]] = {
    "another name": (of_units(work_of_adhesion=None, gamma="50 mJ/m^2"), 'did you mean "work_of_adhesion"?'),
    "another table": ({"parameters": PUNCH | {"radius": 1.0}}, 'did you mean "R", under [physical]?'),
    "a step": ({"parameters": PUNCH | {"k": {"start": 0.0, "stop": 1.0, "step": 0.1}}}, "a range has no step"),
    "a count": ({"parameters": PUNCH | {"k": {"start": 0.0, "stop": 1.0, "count": 3}}}, 'did you mean "num"?'),
    "a scale": ({"parameters": PUNCH | {"k": {"start": 0.0, "stop": 1.0, "num": 3, "scale": "log"}}}, 'did you mean "spacing"?'),
    "an uncertain ratio": (of_units(None, amplitude="1 nm") | {"uncertainty": {"A": 0.01}}, 'use "amplitude"'),
    "an uncertain number": (of_units(None, amplitude="1 nm") | {"uncertainty": {"amplitude": 0.1}}, 'amplitude = "5 %"'),
    "a decimal comma": (of_units(wavelength="300,5 nm"), "a decimal comma; write a point, 300.5"),
    "a comma of either kind": (of_units(wavelength="1,000 nm"), "write 1.000 or 1000;"),
    "thousands": (of_units(wavelength="1,234.5 nm"), "a comma between thousands; write 1234.5;"),
    "millions": (of_units(wavelength="1,234,567 nm"), "a comma between thousands; write 1234567;"),
    "no thousands": (of_units(wavelength="0,250 um"), "a decimal comma; write a point, 0.250;"),
    "four decimals": (of_units(wavelength="1,0000 um"), "a decimal comma; write a point, 1.0000;"),
    "no preload": (of_units(preload="0 N"), 'indentation_max = "0 nm"'),
    "no load": ({"parameters": PUNCH | {"load_max": 0.0}}, "indentation_max_over_R = 0.0"),
    "American": (search("maximize"), 'did you mean "maximise"?'),
}  # fmt: skip


@pytest.mark.parametrize("name", STUDIES)
def test_what_was_meant_is_said_and_nothing_else_is_wrong(name: str) -> None:
    study, words = STUDIES[name]
    with pytest.raises(gr.StudyError) as refused:
        study_from(without_none({"outputs": ["pull_off_force"]} | study))
    (sentence,) = refused.value.mistakes
    assert words in sentence


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("gamma", "work_of_adhesion"), ("dgamma", "work_of_adhesion"), ("gama", "work_of_adhesion"), ("W", "work_of_adhesion"),
        ("E*", "E_star"), ("radius", "R"), ("wavelength_over_R", "lambda_over_R"), ("lambda", "lambda_over_R"),
        ("poisson", "nu"), ("youngs_modulus", "E"), ("stiffness", "spring_constant"), ("amplitude_over_lambda", "A"),
    ],
)  # fmt: skip
def test_a_key_by_another_name_is_recognised(word: str, meant: str) -> None:
    assert nearest(word, ["k", "nu", "a_max", "amplitude", *AFM, "A", "E", "spring_constant", "lambda_over_R"]) == meant
    assert all(nearest(one, [*gr.PARAMETERS]) == one for one in gr.PARAMETERS), "each name is its own"
    assert not any(name in others for name, others in CALLED.items())


@pytest.mark.parametrize(
    ("override", "answer"),
    [("parameters.k=0,0.1", "--set 'parameters.k=[0,0.1]'"), ("title=a, b", """--set 'title="a, b"'""")],
)
def test_several_values_of_an_option_stand_in_brackets(override: str, answer: str, study_file: Path) -> None:
    with pytest.raises(gr.StudyError, match=re.escape(answer)):
        load_study(study_file, [override])


@pytest.mark.parametrize(("name", "better"), [("foo.csv", "foo.nc"), ("foo", "foo.nc"), ("foo.v2", "foo.v2.nc")])
def test_a_dataset_has_the_ending_of_one(gradhesion: Call, tmp_path: Path, name: str, better: str) -> None:
    for arguments in (("run", "study.toml"), ("merge", "a.nc", "b.nc")):
        result = gradhesion(*arguments, "-o", tmp_path / name)
        assert result.exit_code == 2
        assert result.stderr.strip().endswith(f"write -o {tmp_path / better}")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("number", ["0", "-3", "abc", "2.0", ""])
def test_no_thread_for_the_compiler_is_one_sentence(
    number: str, gradhesion: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_NUM_THREADS", number)
    if number == "":
        refuse_without_threads()
        assert "NUMBA_NUM_THREADS" not in os.environ
        return
    result = gradhesion("run", "study.toml")
    assert result.exit_code == 2
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"NUMBA_NUM_THREADS = {number}: ")
