"""Every wrong study is refused at its keys, all of them at once, each with a remedy."""

import copy
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.reading import any_from

TABLE = Path(__file__).with_name("wrong_studies.txt").read_text(encoding="utf-8")
"""Right studies, each followed by what makes it wrong; that of a fit names a file that is not there."""


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


def keys_of(refused: StudyError) -> list[str]:
    """Name the keys of all mistakes but that of the file that is not there."""
    found = [re.match(r"study: ([^\s:]+)", sentence) for sentence in refused.mistakes]
    return sorted(key[1] for key in found if key and key[1] != "data.file")


SCENE = {"k": 0.5, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.1}


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"nu": "0,3"}, "0.3"),
        ({"gamma": 1.0}, "work_of_adhesion"),
        ({"lamda_over_R": 0.1}, "lambda_over_R"),
        ({"k": {"start": 0, "stop": 1, "step": 0.1}}, "num"),
        ({"lambda_over_R": "5 um"}, "wavelength"),
    ],
)
def test_the_remedy_names_what_is_meant(parameters: dict[str, Any], words: str) -> None:
    with pytest.raises(StudyError) as refused:
        any_from({"outputs": ["pull_off_force"], "parameters": SCENE | parameters})
    assert any(words in sentence.partition(";")[2] + sentence.partition("?")[0] for sentence in refused.value.mistakes)


def test_a_ratio_beside_quantities_is_told_which_of_both_to_give() -> None:
    units = {"R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm"}
    for more, words in (({}, "give wavelength"), ({"wavelength": "100 nm"}, "wavelength is given")):
        with pytest.raises(StudyError, match=f"parameters.lambda_over_R = .*{words}"):
            any_from({
                "outputs": ["pull_off_force"],
                "parameters": {"k": 0.3, "nu": 0.3, "A": 0.02, "lambda_over_R": 0.1},
                "physical": units | more,
            })  # fmt: skip


@pytest.mark.parametrize("base", sorted({base for base, *_ in _rows()}))
def test_the_studies_that_are_changed_are_right(base: str, tmp_path: Path) -> None:
    data = _changed(base, "title = 'right'")
    if data.get("kind") == "fit":
        with pytest.raises(StudyError, match="cannot be read") as refused:
            any_from(data, folder=tmp_path)
        assert keys_of(refused.value) == []
    else:
        any_from(data)


@pytest.mark.parametrize(("base", "changes", "keys"), _rows())
def test_a_wrong_study_is_refused_at_its_keys(base: str, changes: str, keys: str, tmp_path: Path) -> None:
    with pytest.raises(StudyError) as refused:
        any_from(_changed(base, changes), folder=tmp_path)
    assert keys_of(refused.value) == keys.split()
    assert all(re.search(r"; |\?$|, |move it|remove", sentence) for sentence in refused.value.mistakes), "a remedy"
