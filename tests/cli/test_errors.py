"""Errors are plain exceptions, for Python as for the command line, which gives each its exit code."""

import copy
import pickle
import subprocess
import sys
from collections.abc import Callable

import pytest
from click.testing import CliRunner, Result

from gradhesion.cli import errors
from gradhesion.cli.main import cli

CLASSES = [one for one in vars(errors).values() if isinstance(one, type) and issubclass(one, errors.GradhesionError)]


def test_they_need_no_click() -> None:
    code = "import sys, gradhesion.cli.errors; print('click' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"


@pytest.mark.parametrize("kind", CLASSES)
@pytest.mark.parametrize("mistakes", ["one", ["one", "two"], ("one",)])
def test_they_have_their_mistakes_wherever_they_go(
    kind: type[errors.GradhesionError], mistakes: str | list[str]
) -> None:
    error = kind(mistakes)
    for same in (error, pickle.loads(pickle.dumps(error)), copy.copy(error)):  # noqa: S301 (our own)
        assert type(same) is kind
        assert same.mistakes == (("one",) if mistakes == "one" else tuple(mistakes))
        assert str(same) == "\n".join(same.mistakes)


def test_what_is_asked_for_wrongly_is_a_value_error() -> None:
    assert {kind.__name__ for kind in CLASSES if issubclass(kind, ValueError)} == {"StudyError", "DatasetError"}


@pytest.mark.parametrize("kind", CLASSES)
def test_a_command_ends_with_the_code_and_the_message(
    kind: type[errors.GradhesionError], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise kind(["x.toml: first", "x.toml: second"])

    monkeypatch.setattr(cli.commands["validate"], "callback", fail)
    result = CliRunner().invoke(cli, ["validate", "x.toml"])
    assert result.exit_code == kind.exit_code
    assert result.stderr == "x.toml: first\nx.toml: second\n"
    assert isinstance(result.exception, SystemExit), "no traceback"


def test_a_study_that_is_none_is_said(gradhesion: Callable[..., Result]) -> None:
    result = gradhesion("validate", "none.toml")
    assert result.exit_code == errors.StudyError.exit_code == 2
    assert result.stderr == "none.toml: cannot be read (No such file or directory); name a study in TOML\n"
