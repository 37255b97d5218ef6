"""Errors are plain exceptions, for Python as for the command line, which gives each its exit code; what files are."""

import copy
import pickle
from pathlib import Path
from unittest.mock import Mock

import pytest
from click.testing import CliRunner

from gradhesion.cli import errors
from gradhesion.cli.files import kind_of
from gradhesion.cli.main import cli

CLASSES = errors.GradhesionError.__subclasses__()


@pytest.mark.parametrize("kind", CLASSES)
def test_a_command_ends_with_the_code_and_the_mistakes_wherever_they_go(
    kind: type[errors.GradhesionError], monkeypatch: pytest.MonkeyPatch
) -> None:
    for mistakes in ("one", ["one", "two"], ("one",)):
        error = kind(mistakes)
        for same in (error, pickle.loads(pickle.dumps(error)), copy.copy(error)):  # noqa: S301 (our own)
            assert (type(same), same.mistakes) == (kind, ("one",) if mistakes == "one" else tuple(mistakes))
    monkeypatch.setattr(cli.commands["validate"], "callback", Mock(side_effect=kind(["x.toml: 1", "x.toml: 2"])))
    result = CliRunner().invoke(cli, ["validate", "x.toml"])
    assert (result.exit_code, result.stderr) == (kind.exit_code, "x.toml: 1\nx.toml: 2\n")
    assert isinstance(result.exception, SystemExit), "no traceback"
    assert kind.exit_code in errors.EXIT_CODES
    assert issubclass(kind, ValueError) == (kind.__name__ in ("StudyError", "DatasetError"))


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
