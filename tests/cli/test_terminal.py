"""What a user meets in a terminal: the list of commands, examples that work, what was written, and what was meant."""

import io
import re
import shlex
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from gradhesion.cli.errors import EXIT_CODES
from gradhesion.cli.main import cli
from gradhesion.cli.terminal.progress import progress

Call = Callable[..., Result]


def test_help_fits_a_screen_with_all_commands_in_the_order_of_the_work_and_all_exit_codes() -> None:
    text = CliRunner().invoke(cli, ["--help"], terminal_width=80).output
    assert len(text.splitlines()) <= 30
    work, _, last = text.partition("Set up:")
    listed = re.findall(r"^  (\w+) +(\S.*)$", work.partition("Study and run:")[2], flags=re.MULTILINE)
    set_up, _, codes = last.partition("Exit codes:")
    assert [name for name, _ in listed] + re.findall(r"\w+", set_up) == list(cli.commands)
    assert [name for name, _ in listed][:5] == ["init", "validate", "plan", "run", "status"]
    assert all(words.endswith(".") and not words.endswith("...") for _, words in listed), "none is cut"
    assert [*map(int, re.findall(r"\d+", codes))] == [*EXIT_CODES]


@pytest.mark.parametrize("name", cli.commands)
def test_every_command_has_an_example_that_it_takes(name: str, gradhesion: Call) -> None:
    shown = gradhesion(name, "--help").stdout.partition("Example")[2]
    calls = re.findall(r"^  +gradhesion (.*)$", shown, flags=re.MULTILINE)
    assert calls
    for call in calls:
        first, *arguments = shlex.split(call.partition(" > ")[0])
        assert first == name
        cli.commands[name].make_context(name, arguments)  # raises what is wrong with options and arguments


GIVEN_UP = ["run --dry-run", "run --chunk 7", "run --fail-fast", "run --log-json", "merge --chunk 7", "verify --digits"]


@pytest.mark.parametrize("words", GIVEN_UP)
def test_what_was_given_up_is_refused_with_what_to_use(words: str, gradhesion: Call) -> None:
    command, *option = words.split()
    result = gradhesion(command, "x.toml", *option)
    assert result.exit_code == 2
    assert f"{option[0]} was given up" in result.stderr


@pytest.mark.parametrize(("command", "ending"), [("plot", ".png"), ("explore", ".html")])
def test_pictures_and_pages_say_what_they_wrote_and_where_a_value_is_another(
    command: str, ending: str, gradhesion: Call, dataset_file: Path
) -> None:
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


def test_what_is_suggested_for_a_key_without_its_table_works(gradhesion: Call, study_file: Path) -> None:
    value = "{ start = 0.1, stop = 0.5, num = 3 }"
    wrong = gradhesion("validate", study_file, "--set", f"lambda_over_R={value}")
    (suggested,) = re.findall(r"parameters\.lambda_over_R", wrong.stderr)
    assert wrong.exit_code == 2
    assert gradhesion("validate", study_file, "--set", f"{suggested}={value}").exit_code == 0


class Terminal(io.StringIO):
    """A terminal that keeps what is written."""

    def isatty(self) -> bool:
        return True


def test_progress_is_a_plain_line_every_ten_seconds(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    seconds = iter([0.0, 4.0, 11.0, 19.0, 22.0, 40.0])
    monkeypatch.setattr("time.monotonic", lambda: next(seconds))
    with progress(5000, quiet=False) as advance:
        for _ in range(5):
            advance(1000)
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.splitlines() == [
        "2,000 of 5,000 scenes (40%), 180 per s, 16 s left",
        "4,000 of 5,000 scenes (80%), 180 per s, 6 s left",
    ]


@pytest.mark.parametrize("quiet", [False, True])
def test_on_a_terminal_progress_is_a_bar_and_nothing_where_it_is_to_be_quiet(
    quiet: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr("gradhesion.cli.terminal.progress.PERIOD", 0.0)
    for name, value in (("TERM", "xterm"), ("COLUMNS", "100")):
        monkeypatch.setenv(name, value)
    with progress(5000, quiet=quiet) as advance:
        advance(2000)
    said = terminal.getvalue()
    assert [words in said for words in ("2,000 of 5,000 scenes", "40%", "per s")] == 3 * [not quiet]
