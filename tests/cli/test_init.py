"""What is met first: studies to start from, what the shell completes, and installations whose packages do not serve or lack what others have."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from gradhesion.cli.commands.plan import studies
from gradhesion.cli.errors import MissingExtraError
from gradhesion.cli.installation import checked, misfit, refuse_without_threads, unmet
from gradhesion.cli.main import cli
from tests.cli.conftest import Call, Called, Patch, Told
from tests.conftest import ROOT

COMMAND = (sys.executable, "-m", "gradhesion")
PROGRAM = (sys.executable, "-c")
TOO_OLD = [
    ("numba", "0.60.0", "numba>=0.62", (*COMMAND, "warmup"), 2),
    ("click", "7.1", "click>=8.2", (*COMMAND, "--help"), 2),
    ("numba", "0.60.0", "numba>=0.62", (*PROGRAM, "from gradhesion import solve"), 1),
    ("bokeh", "3.4.0", "bokeh>=3.6", (*PROGRAM, "import gradhesion as gr; gr.explore('none.nc')"), 1),
]
"""A package, its version, the one that is needed, by what, and the code with which that ends."""


def test_a_study_is_written_and_runs_and_an_existing_file_stays(
    gradhesion: Call, tmp_path: Path, monkeypatch: Patch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert gradhesion("init").exit_code == 0
    assert Path("map.toml").read_text(encoding="utf-8") == studies()["map"]
    gradhesion("run", "map.toml", "--set=parameters.lambda_over_R=0.2", "--quiet", code=0)
    assert Path("outputs/map.nc").exists()
    path = tmp_path / "new" / "mine.toml"
    assert gradhesion("init", "fig4a", "-o", path).exit_code == 0
    assert path.read_text(encoding="utf-8") == studies()["fig4a"]
    assert gradhesion("init", "-o", path).exit_code == 4
    assert path.read_text(encoding="utf-8") == studies()["fig4a"]
    assert gradhesion("init", "-o", path, "--overwrite").exit_code == 0
    assert path.read_text(encoding="utf-8") == studies()["map"]


def test_a_full_disk_leaves_what_was_there(tmp_path: Path, on_a_full_disk: Called) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("precious")
    assert on_a_full_disk(100, "init", "-o", path, "--overwrite").returncode == 4
    assert os.listdir(tmp_path) == ["mine.toml"]
    assert path.read_text() == "precious"


def test_an_unknown_name_has_a_suggestion(gradhesion: Call) -> None:
    for name, hint in {"fig4": '"fig4', "mine.toml": "init map -o mine.toml", "curve.toml": "init curve -o"}.items():
        assert hint in gradhesion("init", name, code=2).stderr


def test_the_studies_are_those_of_the_repository_and_listed_those_of_figures_apart(gradhesion: Call) -> None:
    assert studies() == {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "configs").glob("*.toml")}
    lists = (gradhesion("init", "--list", *more).stdout.splitlines() for more in ((), ["--paper"]))
    features, figures = ([line.split()[0] for line in one] for one in lists)
    assert sorted(features + figures) == sorted(studies())
    assert {"map", "curve", "fit"} <= {*features}
    assert figures == [name for name in sorted(studies()) if name.startswith(("fig", "extra_"))]
    assert gradhesion("init", "--paper").exit_code == 2


def completed(shell: str, words: str, count: int) -> list[str]:
    """Ask the command what it would complete, as the script of a shell does: of bash in a process of its own."""
    place = words.rsplit(maxsplit=1)[-1] if shell == "fish" else str(count)
    asked = {"_GRADHESION_COMPLETE": f"{shell}_complete", "COMP_WORDS": words, "COMP_CWORD": place}
    if shell == "bash":
        return subprocess.check_output(COMMAND, env=os.environ | asked, text=True).splitlines()
    return CliRunner().invoke(cli, [], prog_name="gradhesion", env=asked).stdout.splitlines()


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shells_complete_commands_and_studies_by_a_script(
    shell: str, gradhesion: Call, tmp_path: Path, monkeypatch: Patch
) -> None:
    commands = [line.split("\t")[0] for line in completed(shell, "gradhesion pl", 1)]
    assert {"bash": "plain,plot", "zsh": "plot", "fish": "plain,plot"}[shell] in commands
    assert any("physical" in line for line in completed(shell, "gradhesion init ph", 2))
    script, there = tmp_path / "script", shutil.which(shell)
    monkeypatch.setenv("PATH", "")
    done = gradhesion("completion", shell, code=0)
    assert done.stderr == ""
    assert f"_GRADHESION_COMPLETE={shell}_complete" in done.stdout
    script.write_text(done.stdout)
    assert not there or subprocess.run([there, "-n", script], check=False).returncode == 0


def of_another_version(folder: Path, name: str, version: str, code: str, needs: str = "") -> None:
    """Make a package that is found before the installed one."""
    (folder / name).mkdir(parents=True)
    (folder / name / "__init__.py").write_text(code)
    about = folder / f"{name}-{version}.dist-info"
    about.mkdir()
    metadata = f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n"
    (about / "METADATA").write_text(metadata + (f"Requires-Dist: {needs}\n" if needs else ""))


def ends(folder: Path, *command: str) -> tuple[int, list[str]]:
    """How a command ends, and the lines that it writes to stderr, with the packages of a folder before the others."""
    environment = os.environ | {"PYTHONPATH": str(folder), "PYTHONWARNINGS": "ignore"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stderr.splitlines()


@pytest.mark.parametrize(("package", "version", "needed", "command", "code"), TOO_OLD)
def test_a_package_too_old_is_named(
    package: str, version: str, needed: str, command: tuple[str, ...], code: int, tmp_path: Path
) -> None:
    of_another_version(tmp_path, package, version, "")
    found, lines = ends(tmp_path, *command)
    assert found == code
    assert len(lines) <= 2 if code == 2 else lines[-1].startswith("gradhesion.cli.errors.MissingExtraError: ")
    assert f"{needed} ({version} is installed)" in lines[-1]
    assert lines[-1].endswith(f'{sys.executable} -m pip install "{needed}"')


def test_what_does_not_need_it_works(tmp_path: Path) -> None:
    of_another_version(tmp_path, "numba", "0.60.0", "")
    of_another_version(tmp_path, "bokeh", "3.4.0", "")
    assert ends(tmp_path, *COMMAND, "--help") == (0, [])


def test_what_a_package_needs_of_another_is_looked_at(tmp_path: Path) -> None:
    """As numba, which refuses a numpy that is newer than itself."""
    refuses = "raise ImportError('Numba needs NumPy 1.9 or less')"
    of_another_version(tmp_path, "numba", "0.68.0", refuses, "numpy<1.10")
    code, lines = ends(tmp_path, *COMMAND, "warmup")
    assert code == 2
    assert lines[-1].startswith("Numba needs NumPy 1.9 or less: numba needs numpy<1.10 (")
    assert lines[-1].endswith('-m pip install "numpy<1.10"')


def test_where_all_packages_serve_an_error_stays_what_it_is() -> None:
    assert unmet() == []
    error = ImportError("no library")
    assert misfit(error) is None
    assert issubclass(MissingExtraError, ImportError)
    with pytest.raises(ImportError, match=r"^no library$") as raised, checked():
        raise error
    assert raised.value is error


def test_no_thread_for_the_compiler_is_one_sentence(refusal: Told, monkeypatch: Patch) -> None:
    for number in ("0", "abc"):
        monkeypatch.setenv("NUMBA_NUM_THREADS", number)
        assert refusal("run", "study.toml").startswith(f"NUMBA_NUM_THREADS = {number}: ")
    monkeypatch.setenv("NUMBA_NUM_THREADS", "")
    refuse_without_threads()
    assert "NUMBA_NUM_THREADS" not in os.environ


WITHOUT = """
import builtins, importlib, json, os, pkgutil, signal, sys

missing = {"fcntl", "grp", "posix", "pwd", "resource", "syslog", "termios", "tty"}
plain = builtins.__import__

def without(name, globals=None, *rest, **named):
    if name in missing and str((globals or {}).get("__name__")).startswith("gradhesion."):
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)  # libraries have ways of their own
    return plain(name, globals, *rest, **named)

builtins.__import__ = without
for name in ("SIGHUP", "SIGKILL", "SIGUSR1", "SIGUSR2", "SIGPIPE", "SIGALRM", "SIGQUIT"):
    delattr(signal, name)
for name in ("O_CLOEXEC", "O_DIRECTORY", "fork", "getpgid", "killpg", "sched_getaffinity"):
    delattr(os, name)

import gradhesion.cli
from gradhesion.cli.main import cli, main

for found in pkgutil.walk_packages(gradhesion.cli.__path__, "gradhesion.cli."):
    if not found.name.startswith("gradhesion.cli.work.cluster") and not found.name.endswith("__main__"):
        importlib.import_module(found.name)
*first, last = json.loads(sys.argv[1])
for arguments in first:
    assert not cli.main(arguments, prog_name="gradhesion", standalone_mode=False), arguments
sys.argv[1:] = last
main()
"""


@pytest.mark.slow
def test_a_study_is_run_shown_and_checked_without_what_windows_lacks(root: Path, tmp_path: Path) -> None:
    """But for the engine of clusters: Dask has its own ways on each system."""
    first, last = ["run", str(root / "configs" / "smoke.toml"), "-o"], ["--sample", "2", "--seed", "1"]
    readers = [[name, "smoke.nc"] for name in ("status", "info", "plot")]
    commands = [[*first, "smoke.nc"], *readers, ["verify", "smoke.nc", *last]]
    command = [sys.executable, "-c", WITHOUT, json.dumps(commands)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, (done.stdout, done.stderr)
    assert done.stdout.endswith("values are within their stated errors\n"), "the last has come to its end"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["smoke.nc", "smoke.png"]
