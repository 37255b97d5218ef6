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
    "another name": (of_units(work_of_adhesion=None, gamma="50 mJ/m^2"), '"work_of_adhesion"'),
    "a synonym": ({"parameters": {**{key: one for key, one in PUNCH.items() if key != "nu"}, "poisson": 0.3}}, '"nu"'),
    "another table": ({"parameters": PUNCH | {"radius": 1.0}}, '"R", under [physical]'),
    "a step": ({"parameters": PUNCH | {"k": {"start": 0.0, "stop": 1.0, "step": 0.1}}}, "num"),
    "a scale": ({"parameters": PUNCH | {"k": {"start": 0.0, "stop": 1.0, "num": 3, "scale": "log"}}}, '"spacing"'),
    "an uncertain ratio": (of_units(None, amplitude="1 nm") | {"uncertainty": {"A": 0.01}}, '"amplitude"'),
    "an uncertain number": (of_units(None, amplitude="1 nm") | {"uncertainty": {"amplitude": 0.1}}, 'amplitude = "5 %"'),
    "a decimal comma": (of_units(wavelength="300,5 nm"), "300.5"),
    "a comma of either kind": (of_units(wavelength="1,000 nm"), "1.000 or 1000"),
    "thousands": (of_units(wavelength="1,234,567.5 nm"), "1234567.5"),
    "no preload": (of_units(preload="0 N"), 'indentation_max = "0 nm"'),
    "no load": ({"parameters": PUNCH | {"load_max": 0.0}}, "indentation_max_over_R = 0.0"),
    "American": (search("maximize"), '"maximise"'),
}  # fmt: skip
"""Studies with one mistake, and what its remedy names."""


@pytest.mark.parametrize("name", STUDIES)
def test_what_was_meant_is_said_and_nothing_else_is_wrong(name: str) -> None:
    study, words = STUDIES[name]
    with pytest.raises(gr.StudyError) as refused:
        study_from(without_none({"outputs": ["pull_off_force"]} | study))
    (sentence,) = refused.value.mistakes
    assert words in sentence


@pytest.mark.parametrize(
    ("override", "answer"),
    [("parameters.k=0,0.1", "--set 'parameters.k=[0,0.1]'"), ("title=a, b", """--set 'title="a, b"'""")],
)
def test_several_values_of_an_option_stand_in_brackets(override: str, answer: str, study_file: Path) -> None:
    with pytest.raises(gr.StudyError, match=re.escape(answer)):
        load_study(study_file, [override])


@pytest.mark.parametrize(("name", "better"), [("foo.csv", "foo.nc"), ("foo.v2", "foo.v2.nc")])
def test_a_dataset_has_the_ending_of_one(gradhesion: Call, tmp_path: Path, name: str, better: str) -> None:
    for arguments in (("run", "study.toml"), ("merge", "a.nc", "b.nc")):
        result = gradhesion(*arguments, "-o", tmp_path / name)
        assert result.exit_code == 2
        assert result.stderr.strip().endswith(f"write -o {tmp_path / better}")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("number", ["0", "abc", ""])
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
