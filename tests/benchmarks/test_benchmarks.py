"""The benchmarks run, and drawn loops are what their page says; what they measure is never asserted."""

import importlib
import re
import subprocess
import sys

import numpy as np
import pytest

from benchmarks import measured_loops as loops
from tests.conftest import ROOT

SCRIPTS = sorted(path.stem for path in (ROOT / "benchmarks").glob("*.py") if "\ndef main(" in path.read_text("utf-8"))


def python(*arguments: str) -> str:
    return subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("name", SCRIPTS)
def test_every_script_has_help(name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "argv", ["benchmark", "--help"])
    with pytest.raises(SystemExit, match=r"^0$"):
        importlib.import_module(f"benchmarks.{name}").main()
    assert "usage" in capsys.readouterr().out


def test_a_part_runs_alone() -> None:
    printed = python("-m", "benchmarks", "one_scene")
    assert re.findall("^#.*", printed, re.MULTILINE) == ["# Benchmarks", "### One scene in Python"]
    assert "| ratio | " in printed


GRID = """
from benchmarks.dense_grid import solve_on_grid
from benchmarks.error import scenes_of_twin
for scene in scenes_of_twin(3):
    for points in (3000, 30000):
        force, energy = solve_on_grid(scene, points)
        print(max(abs(force / scene['pull_off_force'] - 1), abs(energy / scene['dissipated_energy'] - 1)))
"""
EXPERT = """
import numba, numpy as np
from benchmarks.error import BOTH, scenes_of_twin
from gradhesion.core.problem.material import stiffness
numba.config.DISABLE_JIT = True  # compiling takes longer
from benchmarks.expert_script import LARGEST, Effort, solve, table_of
numba.config.DISABLE_JIT = False
for scene in scenes_of_twin(6):
    k, M = scene["k"], stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"])
    row = np.array([[k, M, scene["lambda_over_R"], scene["A"], scene["a_max_over_R"]]])
    if 2 * np.pi * row[0, 4] / row[0, 2] < LARGEST:
        for output in BOTH:
            for effort in (Effort(8, 1e-1, 3), Effort(48, 1e-6, 12)):
                value = solve(output, np.array([table_of(k)]), np.array([0]), row, effort)
                print(abs(value[0] / scene[output] - 1))
"""


@pytest.mark.parametrize(("code", "fewest", "least"), [(GRID, 3, 1e-4), (EXPERT, 6, 1e-9)], ids=["grid", "expert"])
def test_what_is_compared_with_tends_to_the_exact_values(code: str, fewest: int, least: float) -> None:
    errors = [float(line) for line in python("-c", code).splitlines()]
    assert len(errors) >= 2 * fewest
    for coarse, fine in zip(errors[::2], errors[1::2], strict=True):
        assert fine < least
        assert fine <= coarse or coarse < 1e-12


@pytest.mark.parametrize("kind", ["smooth", "wavy", "wavy+works", "smooth+works+tilt+retract"])
def test_points_lie_about_the_path_as_far_as_noise_has_them(kind: str) -> None:
    for number in range(3):
        loop, again = (loops.draw_loop(5, number, kind) for _ in range(2))
        count = loop.depth.size
        assert abs(loop.chi_square() / count - 1.0) < 6.0 * np.sqrt(2.0 / count)
        assert (loop.number, loop.kind) == (number, kind)
        assert np.array_equal([loop.depth, loop.load], [again.depth, again.load])
    assert loop.true != loops.draw_loop(5, 0, kind).true
