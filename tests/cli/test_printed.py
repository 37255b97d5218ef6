"""What is printed is safe for a terminal, and what cannot be printed never decides over what is written."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from gradhesion.cli.terminal.messages import printable, printable_line
from tests.cli.conftest import Call, Patch

pytestmark = pytest.mark.slow

Shell = Callable[..., subprocess.CompletedProcess[bytes]]
HOSTILE = ["\x1b[2J\x1b]0;title\x07.nc", "a\nb: written.nc", "\x9b31m.nc", "\u202egpj.nc", "\x7f\x08.nc", "\r.nc"]
"""Names of files that a terminal would obey."""
READERS = ("info", "plot", "explore", "verify", "merge", "status")


@pytest.fixture
def shell(tmp_path: Path) -> Shell:
    """Run a line of a shell in which `gradhesion` is this one."""

    def call(line: str, **variables: str) -> subprocess.CompletedProcess[bytes]:
        command = ["bash", "-c", f'gradhesion() {{ {sys.executable} -m gradhesion.cli "$@"; }}; {line}']
        own = os.environ | variables
        return subprocess.run(command, cwd=tmp_path, env=own, capture_output=True, check=False, timeout=120)

    return call


@pytest.mark.parametrize("name", HOSTILE)
def test_names_reach_the_terminal_as_text(name: str, gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    path, study = tmp_path / name, tmp_path / name.replace(".nc", ".toml")
    study.write_text(study_file.read_text())
    told, more = [], ["--overwrite"] if "\n" in name else ["--variable", "k"]  # one is drawn
    for command in (
        ["info", path], ["run", study, "-o", path], ["run", study, "-o", path], ["info", path], ["status", path], ["plan", study, "-o", path],
        ["validate", study, "--set", "title=3"], ["merge", path], ["plot", path, *more], ["init", "-o", study], ["verify", path, "--sample", "1"],
    ):  # fmt: skip
        result = gradhesion(*command)
        told.append(result.stdout + result.stderr)
        assert printable(told[-1]) == told[-1], command
        assert "\n" not in name or result.exit_code not in {0, 4} or name not in told[-1], command
    assert printable_line(path.name) in told[2], "and can be recognised"


def test_text_that_is_safe_stays() -> None:
    text = "gr\u00fc\u00dfe \u2202 \U0001f600\ttab\nline"
    assert printable(text) == text
    for code in (*range(9), *range(11, 32), *range(127, 160), 0x202E, 0x2066, 0x2028, 0xDCFF):
        assert printable(chr(code)).isascii()
        assert printable(chr(code)).isprintable()


@pytest.mark.parametrize("where", ["2>/dev/full", "<&- >&- 2>&-"])
def test_messages_do_not_decide(where: str, shell: Shell, study_file: Path, gradhesion: Call, tmp_path: Path) -> None:
    done = shell(f"gradhesion run {study_file} -o out.nc {where}; echo $?")
    assert done.stdout == b"0\n", done.stderr
    assert gradhesion("info", tmp_path / "out.nc").stdout.startswith("A small study\n")
    missing = shell(f"gradhesion info none.nc {where}")
    assert (missing.returncode, missing.stderr) == (2, b"")


@pytest.mark.parametrize("command", ["--help", "info --help", "validate study.toml", "info out.nc --format csv", "verify out.nc --sample 1"])  # fmt: skip
@pytest.mark.usefixtures("dataset_file", "study_file")
def test_output_that_cannot_be_written_is_a_sentence(command: str, shell: Shell) -> None:
    for where, words in (("> /dev/full", "No space left on device"), (">&-", "is closed")):
        if where == ">&-" and command != "validate study.toml":
            continue  # all but help are printed by one function
        done = shell(f"gradhesion {command} {where}")
        assert done.returncode == 4
        last = done.stderr.decode().splitlines()[-1]
        assert last.startswith("standard output: ")
        assert words in last
        assert b"Traceback" not in done.stderr
        assert b"damaged" not in done.stderr


def test_names_of_bytes(shell: Shell, study_file: Path, gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    """One run by the shell, whose bytes Python has made text of; then with such text."""
    done = shell(rf"mv {study_file} $'s\xfe.toml'; gradhesion validate $'s\xfe.toml'")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith(b"s\\udcfe.toml: valid; ")
    done = shell("gradhesion run $'s\\xfe.toml' && gradhesion info 'outputs/s\N{REPLACEMENT CHARACTER}.nc'")
    assert done.returncode == 0, done.stderr
    assert rb"gradhesion run 's\udcfe.toml'" in done.stdout
    monkeypatch.chdir(tmp_path)
    for name in ("o\udcff.nc", "o\udcff/o.nc"):
        assert "cannot be written" in gradhesion("run", "s\udcfe.toml", "-o", name, code=4).stderr
    Path("o\udcff.nc").touch()
    for command in READERS:
        assert gradhesion(command, "o\udcff.nc").exit_code == 2


@pytest.mark.parametrize("name", ["/", ".", "..", "", "x" * 300, "x" * 250 + ".nc", "a/../.."])
def test_names_that_are_none(name: str, gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.chdir(tmp_path)
    for command in READERS:
        assert gradhesion(command, name, code=2).stderr.count("\n") == 1
    no_dataset = name in {"a/../..", "x" * 300}  # nothing stands there, and a dataset has another ending
    assert gradhesion("run", study_file, "-o", name).exit_code == (2 if no_dataset else 4)


def test_memory_that_is_not_there_is_a_sentence() -> None:
    code = (
        "import sys; from gradhesion.cli.main import cli, main; sys.argv = ['gradhesion', 'schema']\n"
        "def fail(): raise MemoryError\n"
        "cli.commands['schema'].callback = fail\nmain()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.count("\n")) == (4, 1)
    assert "not enough memory" in done.stderr


@pytest.mark.parametrize("command", ["run STUDY -o out.nc", "plan STUDY", "warmup"])
def test_without_the_compiler_there_is_a_remedy(command: str, shell: Shell, study_file: Path) -> None:
    done = shell("gradhesion " + command.replace("STUDY", str(study_file)), NUMBA_DISABLE_JIT="1")
    assert done.returncode == 2
    assert done.stderr == b"NUMBA_DISABLE_JIT is set, but the solver needs the compiler; unset it\n"
