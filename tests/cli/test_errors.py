"""Errors are plain exceptions, for Python as for the command line, which gives each its exit code; what files are."""

import copy
import pickle
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from gradhesion.cli import errors
from gradhesion.cli.files import kind_of
from gradhesion.cli.main import cli

CLASSES = [one for one in vars(errors).values() if isinstance(one, type) and issubclass(one, errors.GradhesionError)]


@pytest.mark.parametrize("kind", CLASSES)
def test_a_command_ends_with_the_code_and_the_mistakes_wherever_they_go(
    kind: type[errors.GradhesionError], monkeypatch: pytest.MonkeyPatch
) -> None:
    for mistakes in ("one", ["one", "two"], ("one",)):
        error = kind(mistakes)
        for same in (error, pickle.loads(pickle.dumps(error)), copy.copy(error)):  # noqa: S301 (our own)
            assert type(same) is kind
            assert same.mistakes == (("one",) if mistakes == "one" else tuple(mistakes))
            assert str(same) == "\n".join(same.mistakes)

    def fail(*_: object, **__: object) -> None:
        raise kind(["x.toml: first", "x.toml: second"])

    monkeypatch.setattr(cli.commands["validate"], "callback", fail)
    result = CliRunner().invoke(cli, ["validate", "x.toml"])
    assert result.exit_code == kind.exit_code
    assert result.stderr == "x.toml: first\nx.toml: second\n"
    assert isinstance(result.exception, SystemExit), "no traceback"


def test_what_is_asked_for_wrongly_is_a_value_error(gradhesion: Callable[..., Result]) -> None:
    assert {kind.__name__ for kind in CLASSES if issubclass(kind, ValueError)} == {"StudyError", "DatasetError"}
    result = gradhesion("validate", "none.toml")
    assert result.exit_code == errors.StudyError.exit_code == 2
    assert result.stderr == "none.toml: cannot be read (No such file or directory); name a study in TOML\n"


@pytest.mark.parametrize(
    ("name", "content", "kind"),
    [
        ("x.toml", b"\x89HDF\r\n\x1a\n", "a dataset (NetCDF or HDF5)"),
        ("x", b"CDF\x01", "a dataset (NetCDF)"),
        ("x.nc", b"\x89PNG\r\n", "a picture (PNG)"),
        ("x.CSV", b"k,nu", "a table (CSV)"),
        ("x.toml", b"k = 1", "a study (TOML)"),
        ("x", b"k = 1", ""),
        ("x", b"", ""),
        ("folder", None, "a directory"),
        ("/dev/null", None, "no regular file"),
        ("none.toml", None, ""),
        ("x\0y", None, ""),
    ],
)
def test_a_file_is_told_by_how_it_begins_and_by_its_name(
    name: str, content: bytes | None, kind: str, tmp_path: Path
) -> None:
    (tmp_path / "folder").mkdir()
    if content is not None:
        (tmp_path / name).write_bytes(content)
    assert kind_of(tmp_path / name) == kind
