"""A study is read as it is written: numbers, lists, ranges, overrides, and its text."""

import hashlib
import math
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from gradhesion.cli.study.reading import load_study, study_from
from gradhesion.cli.study.rules.axes import expanded
from gradhesion.cli.study.rules.keys import Range
from gradhesion.cli.study.study import Study
from gradhesion.cli.study.text.written import lines_of
from gradhesion.cli.study.tiling import Tiling, size_of
from tests.cli.conftest import Made


def same(one: Study, other: Study) -> bool:
    """Whether two studies ask for the same."""
    parameters = all(np.array_equal(one.parameters[name], other.parameters[name]) for name in one.parameters)
    rest = ("title", "kind", "layout", "outputs", "method", "sizes")
    return parameters and all(getattr(one, name) == getattr(other, name) for name in rest)


def test_the_text_and_its_fingerprint(study_file: Path, data: dict[str, Any]) -> None:
    text = "# a comment stays\n" + study_file.read_text()
    study_file.write_text(text)
    study = load_study(study_file)
    assert study.text == text
    assert study.sha256 == hashlib.sha256(text.encode()).hexdigest()
    assert same(study, study_from(data, name="study"))


def test_the_text_of_an_overridden_study_gives_the_same_study(study_file: Path, write_study: Made) -> None:
    overrides = [
        "parameters.A=[0.2, 0.1]",
        "parameters.lambda_over_R.num=7",
        'title="A \\"quoted\\" title"',
        'method.solver="exact"',
        "parameters.a_max_over_R=inf",
        "outputs=['delta_max']",
        "parameters.nu={start=0, stop=0.4, num=3}",
    ]
    study = load_study(study_file, overrides)
    assert study.sizes == {"k": 2, "nu": 3, "lambda_over_R": 7, "A": 2}
    assert study.title == 'A "quoted" title'
    assert study.parameters["A"].tolist() == [0.2, 0.1], "an axis keeps its order"
    assert same(study, load_study(write_study(study.text)))


def test_an_axis_rises_or_falls(data: dict[str, Any]) -> None:
    data["parameters"] |= {"k": [0.5, 0.1, 0.3], "A": [0.3, 0.2], "a_max_over_R": [float("inf"), 1.0, 2.0]}
    study = study_from(data)
    assert study.parameters["k"].tolist() == [0.1, 0.3, 0.5]
    assert study.parameters["A"].tolist() == [0.3, 0.2]
    assert study.parameters["a_max_over_R"].tolist() == [1.0, 2.0, float("inf")]


def test_windows_text_is_text(study_file: Path) -> None:
    plain = load_study(study_file)
    study_file.write_bytes(b"\xef\xbb\xbf" + study_file.read_bytes().replace(b"\n", b"\r\n"))
    assert same(load_study(study_file), plain)


def test_what_python_gives_and_what_is_left_out(data: dict[str, Any]) -> None:
    del data["title"]
    data["outputs"] = ["delta_max", "pull_off_force"]
    data["parameters"] |= {"k": np.array([0.1, 0.2]), "nu": np.float64(0.3), "A": (0.1,)}
    study = study_from(data, name="mine")
    assert (study.title, study.kind, study.layout, study.method.solver) == ("mine", "map", "grid", "exact")
    assert study.outputs == ("pull_off_force", "delta_max"), "in the order of the dataset"
    assert (study.sizes["k"], study.sizes["A"]) == (2, 1), "an axis of one value stays an axis"


def test_points_broadcast_what_is_fixed(data: dict[str, Any]) -> None:
    data["layout"] = "points"
    data["parameters"] |= {"lambda_over_R": [0.1, 0.1], "A": 0.3, "a_max_over_R": {"start": 1, "stop": 2, "num": 2}}
    study = study_from(data)
    assert study.sizes == {"scene": 2}
    block = study.parameters_of((slice(1, 2),))
    assert {name: float(values.item()) for name, values in block.items()} == {
        "k": 0.31, "nu": 0.27, "modulus": 430.0, "c0_over_R": 0.013, "lambda_over_R": 0.1, "A": 0.3, "a_max_over_R": 2.0,
    }  # fmt: skip
    data["parameters"] |= {"k": 0.1, "lambda_over_R": 0.1, "a_max_over_R": 1.0}
    assert study_from(data).sizes == {"scene": 1}


@given(st.floats(1e-12, 1e12), st.floats(1e-12, 1e12), st.integers(2, 50), st.sampled_from(["linear", "log"]))
def test_a_range_begins_and_ends_exactly(start: float, stop: float, num: int, spacing: str) -> None:
    values = expanded(Range.model_validate({"start": start, "stop": stop, "num": num, "spacing": spacing}))
    assert isinstance(values, np.ndarray)
    assert (values[0], values[-1], values.size) == (start, stop, num)
    assert values.min() == min(start, stop)
    assert values.max() == max(start, stop)


@given(st.integers(-50, 50), st.integers(1, 40), st.integers(2, 300), st.sampled_from([1, 2, 3, 5]))
def test_an_even_range_has_the_decimals_that_one_would_write(first: int, step: int, num: int, digits: int) -> None:
    written = [float(f"{first + i * step}e-{digits}") for i in range(num)]
    values = expanded(Range(start=written[0], stop=written[-1], num=num))
    assert isinstance(values, np.ndarray)
    assert values.tolist() == written


@given(digit=st.integers(1, 9), decades=st.integers(1, 9), first=st.integers(-6, 12), each=st.sampled_from([1, 3, 7]))
@example(digit=3, decades=6, first=12, each=1)
def test_a_log_range_has_the_powers_of_ten(digit: int, decades: int, first: int, each: int) -> None:
    """Of a digit, from small numbers to those of more digits than a double has."""
    written = [float(f"{digit}e{first + i}") for i in range(decades + 1)]
    values = expanded(Range(start=written[0], stop=written[-1], num=decades * each + 1, spacing="log"))
    assert isinstance(values, np.ndarray)
    assert values[::each].tolist() == written


def test_values_that_no_short_decimal_is_near_stay() -> None:
    values = expanded(Range(start=0.02, stop=1.0, num=200, spacing="log"))
    np.testing.assert_array_equal(values[1:-1], np.geomspace(0.02, 1.0, 200)[1:-1])
    assert np.unique(expanded(Range(start=1.0, stop=1.0 + 2e-15, num=4))).size == 4


def test_no_negative_zero_reaches_the_core() -> None:
    assert np.signbit(expanded(-0.0)) == np.False_
    assert not np.signbit(expanded([-0.0, 1.0])).any()
    assert not np.signbit(expanded(Range(start=-0.0, stop=1.0))).any(), "the ends of a search"


SHAPES = st.lists(st.integers(1, 40), min_size=0, max_size=5).map(tuple).filter(lambda one: math.prod(one) <= 100_000)


@pytest.mark.slow
@given(shape=SHAPES, chunk=st.integers(1, 3000), many=st.integers(1, 9))
def test_blocks_cover_every_cell_once_in_whole_chunks(shape: tuple[int, ...], chunk: int, many: int) -> None:
    tiling = Tiling(shape, chunk, many)
    count = np.zeros(shape, dtype=int)
    for block in tiling:
        count[block] += 1
        assert size_of(block) <= chunk * many
        assert all(cut.start % part == 0 for cut, part in zip(block, tiling.chunk, strict=True))
    assert (count == 1).all()
    *first, last = [*islice(tiling, 50), tiling[len(tiling) - 1]]
    assert [tiling[number] for number in range(len(first))] == first
    assert all(cut.stop == length for cut, length in zip(last, shape, strict=True))


def test_lines_are_those_of_the_text() -> None:
    text = 'a = """\nx = 1\n]\n"""\n"b.c" = [ # [\n 1, # ]\n 2 ]\n\n[d]\n  [ d . e ]\nf.g = {h = 1, i = {j = 2}}\n[[k]]\nl=1\n'
    found = {".".join(key): line for key, line in lines_of(text).items()}
    assert found == {"a": 1, "d": 9, "d.e": 10, "d.e.f": 11, "d.e.f.g": 11, "k": 12, "k.l": 13}
