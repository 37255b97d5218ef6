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
from gradhesion.cli.main import EXITS, SECTIONS, SET_UP, cli
from gradhesion.cli.terminal.progress import progress

Call = Callable[..., Result]


def test_commands_are_listed_in_the_order_of_the_work_and_not_cut() -> None:
    text = CliRunner().invoke(cli, ["--help"], terminal_width=80).output
    listed = re.findall(r"^  (\w+) +(\S.*)$", text.partition("Study and run:")[2], flags=re.MULTILINE)
    shown = [command.name for commands in SECTIONS.values() for command in commands]
    assert [name for name, _ in listed] == shown
    assert shown[:5] == ["init", "validate", "plan", "run", "status"]
    assert [*shown, *(command.name for command in SET_UP)] == list(cli.commands)
    for _, words in listed:
        assert len(words) <= 50
        assert words.endswith(".")
        assert not words.endswith("...")


def test_help_fits_a_screen_and_ends_with_set_up_and_all_exit_codes() -> None:
    text = CliRunner().invoke(cli, ["--help"], terminal_width=80).output
    assert len(text.splitlines()) <= 30
    *_, last = text.partition("Set up:")
    assert all(str(command.name) in last.partition("Exit codes:")[0] for command in SET_UP)
    assert {code for code, _ in EXITS} == {*EXIT_CODES}
    assert all(str(code) in last.partition("Exit codes:")[2] for code in EXIT_CODES)


@pytest.mark.parametrize("name", cli.commands)
def test_every_command_has_an_example_that_it_takes(name: str, gradhesion: Call) -> None:
    shown = gradhesion(name, "--help").stdout.partition("Example")[2]
    calls = re.findall(r"^  +gradhesion (.*)$", shown, flags=re.MULTILINE)
    assert calls
    for call in calls:
        first, *arguments = shlex.split(call.partition(" > ")[0])
        assert first == name
        cli.commands[name].make_context(name, arguments)  # raises what is wrong with options and arguments


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


@pytest.mark.parametrize(
    ("override", "answer"),
    [
        ("A=0.1", "belongs under [parameters]; write --set parameters.A=0.1"),
        ("lambda_over_r=0.1", 'did you mean "lambda_over_R", under [parameters]?'),
        ("sovler='exact'", 'did you mean "solver", under [method]?'),
        ("solver='envelope'", "belongs under [method]; write --set"),
        ("R='1 mm'", "belongs under [physical]; write --set"),
        ("machine_stiffness=2.0", "write --set loading.machine_stiffness=2.0"),
        ('outputs=["energy"]', 'did you mean "dissipated_energy"?'),
        ('outputs=["force"]', 'did you mean "pull_off_force"?'),
        ('outputs=["energy_gian"]', 'did you mean "energy_gain"?'),
    ],
)
def test_a_key_or_output_that_is_nearly_right_is_answered_by_the_right_one(
    override: str, answer: str, gradhesion: Call, study_file: Path
) -> None:
    result = gradhesion("validate", study_file, "--set", override)
    assert result.exit_code == 2
    assert answer in result.stderr


def test_what_is_suggested_for_a_key_without_its_table_works(gradhesion: Call, study_file: Path) -> None:
    wrong = gradhesion("validate", study_file, "--set", "lambda_over_R={ start = 0.1, stop = 0.5, num = 3 }").stderr
    (suggested,) = re.findall(r"write (--set .*)$", wrong, flags=re.MULTILINE)
    assert gradhesion("validate", study_file, *shlex.split(suggested)).exit_code == 0


def test_one_of_something_is_no_plural(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    single = [f"--set=parameters.{key}" for key in ("k=0.3", "lambda_over_R=0.2", "A=0.02", "a_max_over_R=1.0")]
    said = [
        gradhesion("validate", study_file, *single).stdout,
        gradhesion("run", study_file, "-o", tmp_path / "one.nc", *single).stderr,
        gradhesion("info", tmp_path / "one.nc").stdout,
    ]
    assert ["1 scene" in one and "1 scenes" not in one for one in said] == 3 * [True]


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
