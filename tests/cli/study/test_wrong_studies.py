"""Every wrong study is refused at its keys, all of them at once, each with a remedy."""

import copy
import re
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

from gradhesion.cli.study.reading import any_from
from tests.conftest import mistakes

TABLE = Path(__file__).with_name("wrong_studies.txt").read_text(encoding="utf-8")
"""Right studies, each followed by what makes it wrong; that of a fit names a file that is not there."""
PUNCH: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.02, "a_max_over_R": 1.0}  # fmt: skip
AFM: dict[str, Any] = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm", "wavelength": "100 nm"}  # fmt: skip


def _rows() -> list[tuple[str, str, str]]:
    rows = []
    for line in TABLE.split("\n"):
        if line.startswith("== "):
            base = line.removeprefix("== ")
        elif " -> " in line and not line.startswith("#"):
            changes, _, keys = line.rpartition(" -> ")
            rows.append((base, changes, keys))
    return rows


def _merge(data: dict[str, Any], more: dict[str, Any]) -> None:
    for key, value in more.items():
        if isinstance(value, dict) and isinstance(data.get(key), dict) and "." not in key:
            data[key] |= value
        else:
            data[key] = value


def _changed(base: str, changes: str) -> dict[str, Any]:
    data = tomllib.loads(f"study = {base}")["study"]
    for change in changes.split(" ;; "):
        if change.startswith("- "):
            *tables, key = change.removeprefix("- ").split(".")
            (data[tables[0]] if tables else data).pop(key)
        elif re.match(r"[\w-]+\.", change):
            _merge(data, copy.deepcopy(tomllib.loads(change)))
        else:
            data |= tomllib.loads(change)
    return data


def keys_of(told: Iterable[str]) -> list[str]:
    """Name the keys of all mistakes but that of the file that is not there."""
    found = [re.match(r"study: ([^\s:]+)", sentence) for sentence in told]
    return sorted(key[1] for key in found if key and key[1] != "data.file")


def without_none(table: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if value is not None}


def of_units(A: float | None = 0.02, **changes: Any) -> dict[str, Any]:
    """A study with units, but for what is changed; None leaves a key out."""
    return {"parameters": without_none({"k": 0.3, "nu": 0.3, "A": A}), "physical": without_none(AFM | changes)}


RATIO = {"parameters": {"k": 0.3, "nu": 0.3, "A": 0.02, "lambda_over_R": 0.1}}
SEARCH = {"maximize": "pull_off_force", "over": ["A"]}
STUDIES: dict[str, tuple[dict[str, Any], str]] = {
    "another name": (of_units(work_of_adhesion=None, gamma="50 mJ/m^2"), '"work_of_adhesion"'),
    "a synonym": ({"parameters": {**{key: one for key, one in PUNCH.items() if key != "nu"}, "poisson": 0.3}}, '"nu"'),
    "another table": ({"parameters": PUNCH | {"radius": 1.0}}, '"R", under [physical]'),
    "misspelt at the top": ({"lamda_over_R": 0.1, "parameters": {key: one for key, one in PUNCH.items() if key != "lambda_over_R"}}, "[parameters]"),
    "misspelt": ({"parameters": {**{key: one for key, one in PUNCH.items() if key != "lambda_over_R"}, "lamda_over_R": 0.1}}, '"lambda_over_R"'),
    "a ratio with a unit": ({"parameters": PUNCH | {"lambda_over_R": "5 um"}}, "wavelength"),
    "a ratio for a quantity": (RATIO | {"physical": without_none(AFM | {"wavelength": None})}, "give wavelength"),
    "a ratio beside its quantity": (RATIO | {"physical": AFM}, "wavelength is given"),
    "a step": ({"parameters": PUNCH | {"k": {"start": 0.0, "stop": 1.0, "step": 0.1}}}, "num"),
    "a scale": ({"parameters": PUNCH | {"k": {"start": 0.0, "stop": 1.0, "num": 3, "scale": "log"}}}, '"spacing"'),
    "an uncertain ratio": (of_units(None, amplitude="1 nm") | {"uncertainty": {"A": 0.01}}, '"amplitude"'),
    "an uncertain number": (of_units(None, amplitude="1 nm") | {"uncertainty": {"amplitude": 0.1}}, 'amplitude = "0.5 um"'),
    "an uncertain 0": ({"parameters": {key: one for key, one in PUNCH.items() if key != "c0_over_R"} | {"k": 0.0}, "uncertainty": {"k": 0.1}}, "c0_over_R = 0.01"),
    "a decimal comma": (of_units(wavelength="300,5 nm"), "a comma"),
    "thousands": (of_units(wavelength="1,234,567.5 nm"), "a comma"),
    "no preload": (of_units(preload="0 N"), 'indentation_max = "0 nm"'),
    "no load": ({"parameters": PUNCH | {"load_max": 0.0}}, "indentation_max_over_R = 0.0"),
    "American": ({"kind": "optimum", "outputs": None, "parameters": PUNCH | {"A": {"start": 0.01, "stop": 0.1}}, "optimum": SEARCH}, '"maximise"'),
}  # fmt: skip
"""Studies with one mistake, and what its remedy names."""


@pytest.mark.parametrize("name", STUDIES)
def test_what_was_meant_is_said_and_nothing_else_is_wrong(name: str) -> None:
    study, words = STUDIES[name]
    (sentence,) = mistakes(any_from, without_none({"outputs": ["pull_off_force"]} | study))
    assert words in sentence


@pytest.mark.parametrize("base", sorted({base for base, *_ in _rows()}))
def test_the_studies_that_are_changed_are_right(base: str, tmp_path: Path) -> None:
    data = _changed(base, "title = 'right'")
    if data.get("kind") == "fit":
        (sentence,) = mistakes(any_from, data, folder=tmp_path)
        assert "cannot be read" in sentence
        assert keys_of([sentence]) == []
    else:
        any_from(data)


@pytest.mark.parametrize(("base", "changes", "keys"), _rows())
def test_a_wrong_study_is_refused_at_its_keys(base: str, changes: str, keys: str, tmp_path: Path) -> None:
    told = mistakes(any_from, _changed(base, changes), folder=tmp_path)
    assert keys_of(told) == keys.split()
    assert all(re.search(r"; |\?$|, |move it|remove", sentence) for sentence in told), "a remedy"
