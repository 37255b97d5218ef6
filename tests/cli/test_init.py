"""Studies to start from: each is written, valid, and commented; and the shell completes what is typed."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from gradhesion.cli.commands.init import studies
from tests.cli.conftest import Call, Called, Patch
from tests.conftest import ROOT


def test_the_studies_are_those_of_the_repository() -> None:
    assert studies() == {path.stem: path.read_text(encoding="utf-8") for path in (ROOT / "configs").glob("*.toml")}
    assert {"map", "curve", "physical", "fig4a"} <= studies().keys()


def test_a_map_is_written_and_runs(gradhesion: Call, tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.chdir(tmp_path)
    assert gradhesion("init").exit_code == 0
    assert Path("map.toml").read_text(encoding="utf-8") == studies()["map"]
    gradhesion("run", "map.toml", "--set=parameters.lambda_over_R=0.2", "--quiet", code=0)
    assert Path("outputs/map.nc").exists()


def test_another_name_and_place_and_an_existing_file(gradhesion: Call, tmp_path: Path) -> None:
    path = tmp_path / "new" / "mine.toml"
    assert gradhesion("init", "fig4a", "-o", path).exit_code == 0
    assert path.read_text(encoding="utf-8") == studies()["fig4a"]
    assert gradhesion("init", "-o", path).exit_code == 4
    assert path.read_text(encoding="utf-8") == studies()["fig4a"]
    assert gradhesion("init", "-o", path, "--overwrite").exit_code == 0
    assert path.read_text(encoding="utf-8") == studies()["map"]


def test_a_full_disk_leaves_what_was_there(gradhesion: Call, tmp_path: Path, on_a_full_disk: Called) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("precious")
    assert on_a_full_disk(100, "init", "-o", path, "--overwrite").returncode == 4
    assert os.listdir(tmp_path) == ["mine.toml"]
    assert path.read_text() == "precious"
    assert gradhesion("init", "-o", path, "--overwrite").exit_code == 0


def test_an_unknown_name_has_a_suggestion(gradhesion: Call) -> None:
    for name, hint in {"fig4": '"fig4', "mine.toml": "init map -o mine.toml", "curve.toml": "init curve -o"}.items():
        assert hint in gradhesion("init", name, code=2).stderr


def test_the_lists_name_them_all_those_of_figures_apart(gradhesion: Call) -> None:
    lists = (gradhesion("init", "--list", *more).stdout.splitlines() for more in ((), ["--paper"]))
    features, figures = ([line.split()[0] for line in one] for one in lists)
    assert sorted(features + figures) == sorted(studies())
    assert {"map", "curve", "fit"} <= {*features}
    assert figures == [name for name in sorted(studies()) if name.startswith(("fig", "extra_"))]
    assert gradhesion("init", "--paper").exit_code == 2


def completed(shell: str, words: str, count: int) -> list[str]:
    """Ask the command what it would complete, as the script of a shell does."""
    place = words.rsplit(maxsplit=1)[-1] if shell == "fish" else str(count)
    asked = {"_GRADHESION_COMPLETE": f"{shell}_complete", "COMP_WORDS": words, "COMP_CWORD": place}
    command = [sys.executable, "-m", "gradhesion.cli"]
    return subprocess.run(
        command, env=os.environ | asked, stdout=subprocess.PIPE, text=True, check=True
    ).stdout.splitlines()


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shells_complete_commands_and_studies(shell: str) -> None:
    commands = [line.split("\t")[0] for line in completed(shell, "gradhesion pl", 1)]
    assert {"bash": "plain,plot", "zsh": "plot", "fish": "plain,plot"}[shell] in commands
    assert any("physical" in line for line in completed(shell, "gradhesion init ph", 2))


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_script_of_a_shell_is_one(shell: str, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "gradhesion.cli", "completion", shell]
    done = subprocess.run(command, env=os.environ | {"PATH": ""}, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    assert f"_GRADHESION_COMPLETE={shell}_complete" in done.stdout
    if shutil.which(shell):
        script = tmp_path / "script"
        script.write_text(done.stdout)
        subprocess.run([shell, "-n", script], check=True)
