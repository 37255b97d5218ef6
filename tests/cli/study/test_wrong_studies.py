"""Every wrong study is refused at its keys, all of them at once, each with a remedy."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from gradhesion.cli.study.reading import any_from
from tests.conftest import ROOT, mistakes

TABLE = Path(__file__).with_name("wrong_studies.txt").read_text(encoding="utf-8")
CONFIGS = ROOT / "configs"


def _rows() -> Iterator[tuple[str, str, list[str], str]]:
    """Give a right study, what makes it wrong, the keys at which it is refused, and what a sentence has."""
    for line in TABLE.splitlines():
        if line.startswith("== "):
            base = line.removeprefix("== ")
        elif line and not line.startswith("#"):
            changes, _, told = line.rpartition(" -> ")
            keys, _, words = told.partition(" : ")
            yield base, changes, keys.split(), words


def _changed(base: str, changes: str) -> dict[str, Any]:
    data = tomllib.loads(f"study = {base}")["study"]
    for change in changes.split(" ;; "):
        if change.startswith("- "):
            *tables, key = change.removeprefix("- ").split(".")
            (data[tables[0]] if tables else data).pop(key)
            continue
        for key, value in tomllib.loads(change).items():
            data[key] = data.get(key, {}) | value if change.startswith(f"{key}.") else value
    return data


@pytest.mark.parametrize("base", sorted({base for base, *_ in _rows()}))
def test_the_studies_that_are_changed_are_right(base: str) -> None:
    any_from(_changed(base, "title = 'right'"), folder=CONFIGS)


@pytest.mark.parametrize(("base", "changes", "keys", "words"), [*_rows()])
def test_a_wrong_study_is_refused_at_its_keys(base: str, changes: str, keys: list[str], words: str) -> None:
    told = mistakes(any_from, _changed(base, changes), folder=CONFIGS)
    assert sorted(re.findall(r"study: ([^\s:]+)", "\n".join(told))) == keys
    assert all(re.search(r"; |\?$|, |move it|remove", sentence) for sentence in told), "a remedy"
    assert any(words in sentence for sentence in told)
