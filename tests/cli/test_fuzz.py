"""Whatever a study file holds, it is a study or its mistakes are told; never anything else."""

import re
import tempfile
import time
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gradhesion.cli.errors import StudyError
from gradhesion.cli.study.reading import load_study, study_from
from tests.conftest import ROOT

pytestmark = pytest.mark.slow

PIECES = [
    "nan", "-inf", "inf", "true", '"x"', "[", "]", "{", "}", "=", ".", ",", "#", "\n", "'", '"""', "1e999", "-0.0", "0x1F",
    "1979-05-27", "[[1], [2]]", "{}", "[{}]", "{a = {b = 1}}", "99999999999999999999", "\\", "\u00e9", "\u2028", "\x0b",
]  # fmt: skip
SENTENCE = r"(?s)(:\d+: .*|--set .*: .*|: not valid TOML, .*|: not a study, .*|: [\w.]+: .* (required|needs this key)); .*|... and .*"
"""The place, what is wrong, and what to do about it."""
CONFIG = """\
outputs = ["pull_off_force"]
[parameters]
k = [0.0, 0.5]
modulus = 500.0
c0_over_R = 0.01
lambda_over_R = 0.1
A = 0.02
a_max_over_R = 1.0
"""
CONFIGS = [path.read_text(encoding="utf-8").splitlines() for path in sorted((ROOT / "configs").glob("*.toml"))]
pieces = st.one_of(st.sampled_from(PIECES), st.text(max_size=4))
KEYS = st.sampled_from(["parameters.k", "parameters.k.num", "title", "a.b", "", "."])
NUMBERS = ["-1", "0", "1e400", "nan", "inf", "7", "1e-300", "0.5", '"0.5"', "true", "5 m", ""]
DEEP = [".".join("a" * 20_000) + " = 1", "[" + ".".join("a" * 20_000) + "]", "x = { " + ".".join("a" * 20_000) + " = 1 }",
        "\n".join(".".join("ab" * 40) + f".c{i} = 1" for i in range(100)), f"k = {'[' * 50}{']' * 50}", f"k = {'{a=' * 50}1{'}' * 50}"]  # fmt: skip


def read(content: bytes, overrides: list[str]) -> None:
    """Read a study, and check that mistakes are told as they should be."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "study.toml"
        path.write_bytes(content)
        mistakes: tuple[str, ...] = ()
        try:
            assert load_study(path, overrides).scenes >= 1
        except StudyError as error:
            mistakes = error.mistakes
        assert all(one.startswith((str(path), "--set ", "... and ")) for one in mistakes)
        assert len(mistakes) == len(set(mistakes))
        for one in mistakes:
            assert re.fullmatch(SENTENCE, one.removeprefix(str(path))), one


@st.composite
def edited(draw: st.DrawFn) -> str:
    """One of the studies of the project after one to four slips of its author."""
    lines = [*draw(st.sampled_from(CONFIGS))]
    for _ in range(draw(st.integers(1, 4))):
        at, other = (draw(st.integers(0, len(lines) - 1)) for _ in range(2))
        key, equals, value = lines[at].partition("=")
        numbers = [*re.finditer(r"[\d.]+", value)]
        slip = draw(st.sampled_from(["drop", "twice", "value", "number", "key", "swap", "add", "letter"]))
        if slip == "drop" and len(lines) > 1:
            del lines[at]
        elif slip == "twice":
            lines.insert(other, lines[at])
        elif slip == "value" and equals:
            lines[at] = f"{key}= {draw(pieces)}"
        elif slip == "number" and numbers:
            here = draw(st.sampled_from(numbers))
            lines[at] = f"{key}={value[: here.start()]}{draw(st.sampled_from(NUMBERS))}{value[here.end() :]}"
        elif slip == "key" and equals:
            keys = [f"{key.strip()}s", key.upper(), "parameters.k", "k", "n", ""]
            lines[at] = f"{draw(st.sampled_from(keys))} ={value}"
        elif slip == "swap":
            lines[at], lines[other] = lines[other], lines[at]
        elif slip == "add":
            lines.insert(at, draw(st.sampled_from(draw(st.sampled_from(CONFIGS)))))
        else:
            place = draw(st.integers(0, len(lines[at])))
            lines[at] = lines[at][:place] + draw(pieces) + lines[at][place + 1 :]
    return "\n".join(lines)


@given(text=edited(), overrides=st.lists(st.builds("{}={}".format, KEYS, pieces), max_size=2, unique=True))
@settings(max_examples=1000)
def test_slips_in_real_studies_and_in_overrides(text: str, overrides: list[str]) -> None:
    read(text.encode("utf-8", "replace"), overrides)


@given(content=st.binary(max_size=200))
def test_random_bytes(content: bytes) -> None:
    read(content, [])


@pytest.mark.parametrize("value", ["[" * 2000, "{a=" * 500, "1" * 5000, "-" * 50, '"' * 3, "0" * 50, "\x00", "'\ud800"])
def test_hostile_values(value: str) -> None:
    read(f"outputs = {value}\n[parameters]\nk = {value}".encode("utf-8", "replace"), [f"title={value}", f"{value}=1"])


@pytest.mark.parametrize("text", DEEP)
def test_keys_however_deep_are_refused_at_once(text: str, tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(text)
    start = time.process_time()
    with pytest.raises(StudyError, match="nested more than 32 deep"):
        load_study(path)
    assert time.process_time() - start < 2.0, "it took 80 s"


def test_overrides_and_mappings_however_deep_are_refused_and_many_numbers_are_not_deep(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(CONFIG + "nu = 0.3\n")
    assert load_study(path).scenes == 2
    for override in (f"{'a.' * 5000}b=1", f"parameters.k={'[' * 50}{']' * 50}", f"{'a.' * 40}b=1"):
        with pytest.raises(StudyError, match=r"^--set .*: nested more than 32 deep"):
            load_study(path, [override])
    endless: dict[str, Any] = {"outputs": ["pull_off_force"]}
    endless["parameters"] = endless
    with pytest.raises(StudyError, match="nested more than 32 deep"):
        study_from(endless)
    numbers = ", ".join(f"{0.1 + i / 1e6:.6f}" for i in range(5000))
    path.write_text(CONFIG.replace("k = [0.0, 0.5]", "k = 0.5") + f"\nnu = [\n{numbers}\n]\n")
    assert load_study(path).sizes == {"nu": 5000}
