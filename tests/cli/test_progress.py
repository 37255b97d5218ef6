"""Progress: a bar on a terminal, plain lines elsewhere, and nothing at all when it is to be quiet."""

import io
import json
import subprocess
import sys
from pathlib import Path

import pytest

from gradhesion.cli.terminal.progress import progress


class Terminal(io.StringIO):
    """A terminal that keeps what is written."""

    def isatty(self) -> bool:
        return True


def test_a_plain_line_every_ten_seconds(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
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


def test_a_bar_with_rate_and_time_left(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "100")
    with progress(5000, quiet=False) as advance:
        advance(2000)
    assert "2,000 of 5,000 scenes" in terminal.getvalue()
    assert "40%" in terminal.getvalue()
    assert "per s" in terminal.getvalue()


def test_quiet(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gradhesion.cli.terminal.progress.PERIOD", 0.0)
    with progress(10, quiet=True) as advance:
        advance(5)
    assert capsys.readouterr() == ("", "")


def test_json_lines(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gradhesion.cli.terminal.messages.in_json", lambda: True)
    seconds = iter([0.0, 0.5, 2.0, 3.0])
    monkeypatch.setattr("time.monotonic", lambda: next(seconds))
    with progress(4000, quiet=False) as advance:
        advance(1000, reused=True)
        advance(1000)
        advance(2000)
    (line,) = capsys.readouterr().err.splitlines()
    told = json.loads(line)
    assert {name: told[name] for name in ("event", "done", "scenes", "rate", "seconds_left")} == {
        "event": "progress",
        "done": 2000,
        "scenes": 4000,
        "rate": 500.0,
        "seconds_left": 4.0,
    }


BY_SPEED = ("compile", "compiled", "progress")
"""What is reported of a run that has to compile, or of one on a busy machine."""


@pytest.mark.parametrize(
    ("arguments", "code", "events"),
    [
        (["STUDY"], 0, ["done"]),
        (["STUDY", "--quiet"], 0, []),
        (["STUDY", "--set=parameters.nu=7"], 2, ["error"]),
        (["STUDY", "--shard=1/2"], 2, ["error"]),
        (["NONE"], 2, ["error"]),
    ],
)
def test_all_that_is_told_is_json(
    arguments: list[str], code: int, events: list[str], study_file: Path, tmp_path: Path
) -> None:
    given = [str(study_file) if one == "STUDY" else one for one in arguments]
    command = [sys.executable, "-m", "gradhesion.cli", "run", *given, "-o", tmp_path / "out.nc", "--log-json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    told = [json.loads(line) for line in done.stderr.splitlines()]
    assert done.returncode == code
    assert [line["event"] for line in told if line["event"] not in BY_SPEED] == events
    assert all(line.get("exit_code", code) == code for line in told)
