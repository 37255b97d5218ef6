"""Sentences that once led astray: each names what was meant."""

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.cli.terminal.room import refuse_without_threads
from gradhesion.cli.terminal.wording import CALLED, nearest

Call = Callable[..., Result]

PUNCH: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 1.0}  # fmt: skip
AFM: dict[str, Any] = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm", "wavelength": "100 nm"}  # fmt: skip
OUTPUTS = ["pull_off_force"]


def mistakes_of(**tables: Any) -> list[str]:
    """What is wrong with a study."""
    with pytest.raises(gr.StudyError) as refused:
        study_from({"outputs": OUTPUTS} | tables)
    return list(refused.value.mistakes)


def of_units(**changes: Any) -> dict[str, Any]:
    """A study with units, but for what is changed; None leaves a key out."""
    physical = {key: value for key, value in (AFM | changes).items() if value is not None}
    return {"parameters": {"k": 0.3, "nu": 0.3, "A": 0.02}, "physical": physical}


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
    known = gr.PARAMETERS
    assert all(nearest(one, [*known]) == one for one in known), "each name is its own"
    assert not any(name in others for name, others in CALLED.items())


def test_gamma_is_the_work_of_adhesion_and_nothing_else_is_wrong() -> None:
    (sentence,) = mistakes_of(**of_units(work_of_adhesion=None, gamma="50 mJ/m^2"))
    assert 'did you mean "work_of_adhesion"?' in sentence
    given = {"k": 0.3, "nu": 0.3, "A": 0.02} | AFM
    given["gamma"] = given.pop("work_of_adhesion")
    with pytest.raises(gr.StudyError) as refused:
        gr.solve(given)
    (sentence,) = refused.value.mistakes
    assert 'gamma = "50 mJ/m^2": unknown key; did you mean "work_of_adhesion"?' in sentence


def test_a_key_by_another_name_in_another_table_is_sent_there() -> None:
    sentences = mistakes_of(parameters=PUNCH | {"radius": 1.0})
    assert any('did you mean "R", under [physical]?' in sentence for sentence in sentences)


@pytest.mark.parametrize(("key", "words"), [("step", "a range has no step; give the number of its values"), ("count", 'did you mean "num"?'), ("scale", 'did you mean "spacing"?')])  # fmt: skip
def test_a_range_has_no_step(key: str, words: str) -> None:
    given = {"start": 0.0, "stop": 1.0, key: 0.1} | ({"num": 3} if key == "scale" else {})
    (sentence,) = mistakes_of(parameters=PUNCH | {"k": given})
    assert words in sentence


def test_an_uncertain_input_is_that_of_the_study() -> None:
    study = of_units(amplitude="1 nm")
    del study["parameters"]["A"]
    (sentence,) = mistakes_of(**study, uncertainty={"A": 0.01})
    assert 'use "amplitude"' in sentence
    (sentence,) = mistakes_of(**study, uncertainty={"amplitude": 0.1})
    assert 'amplitude = "5 %"' in sentence


def test_several_values_of_an_option_stand_in_brackets(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text('outputs = ["pull_off_force"]\n[parameters]\n' + "\n".join(f"{k} = {v}" for k, v in PUNCH.items()))
    with pytest.raises(gr.StudyError, match=re.escape("--set 'parameters.k=[0,0.1]'")):
        load_study(path, ["parameters.k=0,0.1"])
    with pytest.raises(gr.StudyError, match=re.escape("""--set 'title="a, b"'""")):
        load_study(path, ["title=a, b"])


def test_a_decimal_comma_is_named() -> None:
    (sentence,) = mistakes_of(**of_units(wavelength="300,5 nm"))
    assert "a decimal comma; write a point, 300.5" in sentence


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("1,000 nm", "a comma of decimals or between thousands; write 1.000 or 1000;"),
        ("1,234.5 nm", "a comma between thousands; write 1234.5;"),
        ("1,234,567 nm", "a comma between thousands; write 1234567;"),
        ("0,250 um", "a decimal comma; write a point, 0.250;"),
        ("1,0000 um", "a decimal comma; write a point, 1.0000;"),
    ],
)
def test_a_comma_between_thousands_is_not_taken_for_a_decimal_one(written: str, said: str) -> None:
    (sentence,) = mistakes_of(**of_units(wavelength=written))
    assert said in sentence


def test_no_preload_is_a_depth_of_zero() -> None:
    (sentence,) = mistakes_of(**of_units(preload="0 N"))
    assert 'indentation_max = "0 nm"' in sentence
    (sentence,) = mistakes_of(parameters=PUNCH | {"load_max": 0.0})
    assert "indentation_max_over_R = 0.0" in sentence


def test_a_goal_in_american_spelling_is_a_goal() -> None:
    searched = PUNCH | {"A": {"start": 0.01, "stop": 0.1}}
    goal = {"maximize": "pull_off_force", "over": ["A"]}
    with pytest.raises(gr.StudyError) as refused:
        study_from({"kind": "optimum", "parameters": searched, "optimum": goal})
    (sentence,) = refused.value.mistakes
    assert 'did you mean "maximise"?' in sentence


@pytest.mark.parametrize(("name", "better"), [("foo.csv", "foo.nc"), ("foo", "foo.nc"), ("foo.v2", "foo.v2.nc")])
def test_a_dataset_has_the_ending_of_one(gradhesion: Call, tmp_path: Path, name: str, better: str) -> None:
    for arguments in (("run", "study.toml"), ("merge", "a.nc", "b.nc")):
        result = gradhesion(*arguments, "-o", tmp_path / name)
        assert result.exit_code == 2
        assert result.stderr.strip().endswith(f"its name ends in .nc; write -o {tmp_path / better}")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("number", ["0", "-3", "abc", "2.0"])
def test_no_thread_for_the_compiler_is_one_sentence(
    number: str, gradhesion: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_NUM_THREADS", number)
    result = gradhesion("run", "study.toml")
    assert result.exit_code == 2
    assert result.stderr.splitlines() == [
        f"NUMBA_NUM_THREADS = {number}: the number of threads is a whole number from 1 on; change it, or unset it"
    ]


def test_an_empty_number_of_threads_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_NUM_THREADS", "")
    refuse_without_threads()
    assert "NUMBA_NUM_THREADS" not in os.environ
