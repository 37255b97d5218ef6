"""Messages of the command line read well in Python."""

import pytest

from gradhesion.cli.errors import DatasetError
from gradhesion.wording import in_python, without_options, without_tables


@pytest.mark.parametrize(
    ("said", "read"),
    [
        ("--variable x: not in this dataset", "variable x: not in this dataset"),
        ("choose with --at k=0.1 --at A=0", "choose with at k=0.1 at A=0"),
        ("x.html: exists; name another with -o", "x.html: exists"),
        ("choose one with --x indentation --y load", 'choose one with x="indentation", y="load"'),
        ("a --vertical line", "a --vertical line"),
    ],
)
def test_options_become_keywords(said: str, read: str) -> None:
    assert without_options(said) == read
    with pytest.raises(DatasetError) as raised, in_python():
        raise DatasetError([said, "another"])
    assert raised.value.mistakes == (read, "another")
    assert str(raised.value) == f"{read}\nanother"


def test_tables_are_left_out() -> None:
    said = "gr.solve: physical.R = 1: required; or write E_star = 1 under [physical], or remove [profile] and [loading]"
    assert without_tables(said) == "gr.solve: R = 1: required; or write E_star = 1, or remove profile and control"
