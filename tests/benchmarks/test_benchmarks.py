"""The benchmarks run; what they measure is never asserted."""

import importlib
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def python(root: Path, *arguments: str) -> str:
    return subprocess.run([sys.executable, *arguments], cwd=root, capture_output=True, text=True, check=True).stdout


SCRIPTS = [
    path.stem for path in (ROOT / "benchmarks").glob("*.py") if "\ndef main(" in path.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("name", sorted(SCRIPTS))
def test_every_script_has_help(
    root: Path, name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(root)
    monkeypatch.setattr(sys, "argv", ["benchmark", "--help"])
    with pytest.raises(SystemExit, match=r"^0$"):
        importlib.import_module(f"benchmarks.{name}").main()
    assert "usage" in capsys.readouterr().out


def test_a_script_is_run_by_its_name(root: Path) -> None:
    assert "usage" in python(root, "-m", "benchmarks.study", "--help")


def test_the_dense_grid_tends_to_the_exact_values(root: Path) -> None:
    code = (
        "from benchmarks import dense_grid as d, error as e\n"
        "for scene in e.scenes_of_twin(3):\n"
        "    for points in (3000, 30000):\n"
        "        force, energy = d.solve_on_grid(scene, points)\n"
        "        print(force / scene['pull_off_force'] - 1, energy / scene['dissipated_energy'] - 1)\n"
    )
    lines = [[abs(float(number)) for number in line.split()] for line in python(root, "-c", code).splitlines()]
    for coarse, fine in zip(lines[::2], lines[1::2], strict=True):
        assert max(fine) < 1e-4
        assert max(fine) < max(coarse)


def test_the_script_of_an_expert_tends_to_the_exact_values(root: Path) -> None:
    code = """
import numba, numpy as np
from benchmarks.error import OUTPUTS, scenes_of_twin
from gradhesion.core.problem.material import stiffness
numba.config.DISABLE_JIT = True  # compiling takes longer
from benchmarks.expert_script import LARGEST, Effort, solve, table_of
numba.config.DISABLE_JIT = False
for scene in scenes_of_twin(6):
    k, M = scene["k"], stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"])
    row = np.array([[k, M, scene["lambda_over_R"], scene["A"], scene["a_max_over_R"]]])
    if 2 * np.pi * row[0, 4] / row[0, 2] < LARGEST:
        for output in OUTPUTS:
            for effort in (Effort(8, 1e-1, 3), Effort(48, 1e-6, 12)):
                value = solve(output, np.array([table_of(k)]), np.array([0]), row, effort)
                print(value[0] / scene[output] - 1)
"""
    errors = [abs(float(line)) for line in python(root, "-c", code).splitlines()]
    assert len(errors) >= 12
    for coarse, fine in zip(errors[::2], errors[1::2], strict=True):
        assert fine < 1e-9
        assert fine <= coarse or coarse < 1e-12
