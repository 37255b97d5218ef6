"""What a user meets in a terminal: commands and their examples, what was written or meant, and how a command ends."""

import copy
import io
import pickle
import re
import shlex
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import click
import pytest
from click.testing import CliRunner

from gradhesion.cli import errors
from gradhesion.cli.disk import kind_of
from gradhesion.cli.main import INTERRUPTED, UNHEARD, cli
from gradhesion.cli.terminal.messages import QUIET
from gradhesion.cli.terminal.progress import progress
from tests.cli.conftest import Call, Patch

CLASSES = errors.GradhesionError.__subclasses__()


def test_help_fits_a_screen_with_all_commands_in_the_order_of_the_work_and_all_exit_codes() -> None:
    text = CliRunner().invoke(cli, ["--help"], terminal_width=80).output
    assert len(text.splitlines()) <= 30
    work, _, last = text.partition("Set up:")
    listed = re.findall(r"^  (\w+) +(\S.*)$", work.partition("Study and run:")[2], flags=re.MULTILINE)
    set_up, _, codes = last.partition("Exit codes:")
    assert [name for name, _ in listed] + re.findall(r"\w+", set_up) == list(cli.commands)
    assert [name for name, _ in listed][:5] == ["init", "validate", "plan", "run", "status"]
    assert all(words.endswith(".") and not words.endswith("...") for _, words in listed), "none is cut"
    assert [*map(int, re.findall(r"\d+", codes))] == [*errors.EXIT_CODES]
    assert {*errors.EXIT_CODES} == {0, INTERRUPTED, UNHEARD, *(kind.exit_code for kind in CLASSES)}


@pytest.mark.parametrize("name", cli.commands)
def test_every_command_has_an_example_that_it_takes(name: str, gradhesion: Call) -> None:
    shown = gradhesion(name, "--help").stdout.partition("Example")[2]
    calls = re.findall(r"^  +gradhesion (.*)$", shown, flags=re.MULTILINE)
    assert calls
    for call in calls:
        first, *arguments = shlex.split(call.partition(" > ")[0])
        assert first == name
        cli.commands[name].make_context(name, arguments)  # raises what is wrong with options and arguments


GIVEN_UP = ["plot --inset 1:2", "run --dry-run", "run --chunk 7", "run --fail-fast", "run --log-json", "merge --chunk 7", "verify --digits"]  # fmt: skip


def test_what_was_given_up_is_refused_with_what_to_use(gradhesion: Call) -> None:
    for command, *option in map(str.split, GIVEN_UP):
        assert f"{option[0]} was given up" in gradhesion(command, "x.toml", *option, code=2).stderr


@pytest.mark.parametrize(("command", "ending"), [("plot", ".png"), ("explore", ".html")])
def test_pictures_and_pages_say_what_they_show(command: str, ending: str, gradhesion: Call, dataset_file: Path) -> None:
    """Where a value is another one than was asked for, and what is written."""
    path = dataset_file.with_suffix(ending)
    result = gradhesion(command, dataset_file, "--at", "k=0.2", "--at", "A=0.023")
    assert result.stdout == ""
    first, last = result.stderr.splitlines()
    assert first == "--at k=0.2: shows k = 0.31, its nearest value"
    assert re.fullmatch(rf"{re.escape(str(path))}: written, [\d.]+ [kM]B", last)
    assert gradhesion(command, dataset_file, "--overwrite", "--quiet").stderr == ""
    if command == "plot":
        between = gradhesion("plot", dataset_file, "--at", "k=0.2", "--interpolate", "--overwrite")
        assert len(between.stderr.splitlines()) == 1


def test_progress_is_a_plain_line_every_ten_seconds(capsys: pytest.CaptureFixture[str], monkeypatch: Patch) -> None:
    seconds = iter([0.0, 4.0, 11.0, 19.0, 22.0, 40.0])
    monkeypatch.setattr("time.monotonic", lambda: next(seconds))
    with progress(5000) as advance:
        for _ in range(5):
            advance(1000)
    done = ("2,000 of 5,000 scenes (40%), 180 per s, 16 s left", "4,000 of 5,000 scenes (80%), 180 per s, 6 s left")
    assert capsys.readouterr() == ("", "\n".join([*done, ""]))


def test_scenes_of_before_tell_nothing_of_the_time_that_is_left(
    capsys: pytest.CaptureFixture[str], monkeypatch: Patch
) -> None:
    seconds = iter([0.0, 11.0])
    monkeypatch.setattr("time.monotonic", lambda: next(seconds))
    with progress(5000) as advance:
        advance(1000, reused=True)
    assert capsys.readouterr().err == "1,000 of 5,000 scenes (20%), 0 per s\n"


@pytest.mark.parametrize("quiet", [False, True])
def test_on_a_terminal_progress_is_a_bar_and_nothing_where_it_is_to_be_quiet(quiet: bool, monkeypatch: Patch) -> None:
    terminal = io.StringIO()
    monkeypatch.setattr(terminal, "isatty", lambda: True)
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr("gradhesion.cli.terminal.progress.PERIOD", 0.0)
    for name, value in (("TERM", "xterm"), ("COLUMNS", "100")):
        monkeypatch.setenv(name, value)
    with click.Context(cli) as command:
        command.meta[QUIET] = quiet
        with progress(5000) as advance:
            advance(2000)
    said = terminal.getvalue()
    assert [words in said for words in ("2,000 of 5,000 scenes", "40%", "per s")] == 3 * [not quiet]


@pytest.mark.parametrize(("name", "better"), [("foo.csv", "foo.nc"), ("foo.v2", "foo.nc")])
def test_a_dataset_has_the_ending_of_one(gradhesion: Call, tmp_path: Path, name: str, better: str) -> None:
    for arguments in (("run", "study.toml"), ("merge", "a.nc", "b.nc")):
        result = gradhesion(*arguments, "-o", tmp_path / name, code=2)
        assert result.stderr.strip().endswith(f"write -o {tmp_path / better}")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("kind", CLASSES)
def test_a_command_ends_with_the_code_and_the_mistakes(kind: type[errors.GradhesionError], monkeypatch: Patch) -> None:
    for mistakes in ("one", ["one", "two"], ("one",)):
        error = kind(mistakes)
        for same in (error, pickle.loads(pickle.dumps(error)), copy.copy(error)):  # noqa: S301 (our own)
            assert (type(same), same.mistakes) == (kind, ("one",) if mistakes == "one" else tuple(mistakes))
    monkeypatch.setattr(cli.commands["validate"], "callback", Mock(side_effect=kind(["x.toml: 1", "x.toml: 2"])))
    result = CliRunner().invoke(cli, ["validate", "x.toml"])
    assert (result.exit_code, result.stderr) == (kind.exit_code, "x.toml: 1\nx.toml: 2\n")
    assert isinstance(result.exception, SystemExit), "no traceback"
    assert issubclass(kind, ValueError) == (kind.__name__ in ("StudyError", "DatasetError"))


KINDS_OF_FILES = {
    ("x.toml", b"\x89HDF\r\n\x1a\n"): "a dataset (NetCDF or HDF5)",
    ("x", b"CDF\x01"): "a dataset (NetCDF)",
    ("x.nc", b"\x89PNG\r\n"): "a picture (PNG)",
    ("x.CSV", b"k,nu"): "a table (CSV)",
    ("x.toml", b"k = 1"): "a study (TOML)",
    ("x", b"k = 1"): "",
    ("x", b""): "",
}


def test_a_file_is_told_by_first_bytes_and_name(tmp_path: Path) -> None:
    for (name, content), kind in KINDS_OF_FILES.items():
        (tmp_path / name).write_bytes(content)
        assert kind_of(tmp_path / name) == kind
    for path, kind in ((tmp_path, "a directory"), (Path("/dev/null"), "no regular file")):
        assert kind_of(path) == kind
    assert kind_of(tmp_path / "none.toml") == kind_of(tmp_path / "x\0y") == ""


SCRIPT = """\
import atexit, multiprocessing, sys
from concurrent.futures import ProcessPoolExecutor

import click
from gradhesion.cli import main


@click.command()
def pool():
    found = ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))
    click.echo(found.submit(abs, -3).result())
    found.shutdown(wait=False, cancel_futures=True)


if __name__ == "__main__":
    atexit.register(print, "tidied up")
    main.cli.add_command(pool)
    sys.argv = ["gradhesion", "pool"]
    main.main()
"""


def test_it_waits_for_no_processes_and_tidies_up(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "3\ntidied up\n", "")
