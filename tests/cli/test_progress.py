"""Progress: a bar on a terminal, plain lines elsewhere, and nothing at all when it is to be quiet."""

import io
import sys

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
