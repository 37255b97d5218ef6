"""The kinds of work: which one a call is, and which kernels it compiles."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gradhesion.core import KINDS, NEEDS, OUTPUTS, REPORTS, Harmonic, Loading, Profile
from gradhesion.core.kinds import MANY_WAVES, kind_of_curves, kind_of_map
from gradhesion.core.path import cosine, general_middle


@pytest.mark.parametrize(
    ("outputs", "kind"),
    [
        ((), "force"),
        (("pull_off_radius", "pull_off_force"), "force"),
        (("pull_off_force", "dissipated_energy"), "energy"),
        (("delta_max",), "energy"),
        (("pull_off_force", "adhesion_gain"), "reports"),
    ],
)
def test_by_outputs(outputs: tuple[str, ...], kind: str) -> None:
    assert kind_of_map(outputs) == kind
    assert kind_of_map(outputs, profile=Profile(exponent=1.5)) == f"general_{kind}"
    assert kind_of_map(outputs, loading=Loading(control="load")) == f"general_{kind}"


@pytest.mark.parametrize(("solver", "other"), [("asymptotic", "asymptotic"), ("envelope", "general_envelope")])
def test_by_solver(solver: str, other: str) -> None:
    assert kind_of_map(OUTPUTS, solver) == solver
    assert kind_of_map(OUTPUTS, solver, Profile(exponent=1.5)) == other


def test_another_profile_may_be_one_wave() -> None:
    assert kind_of_map(["pull_off_force"], profile=Profile(harmonics=(Harmonic(n=3),))) == "force"
    assert kind_of_curves() == "curves"
    assert kind_of_curves(Profile(harmonics=(Harmonic(n=3),))) == "general_curves", "it is drawn as any profile"
    assert kind_of_curves(loading=Loading(control="machine")) == "general_curves"


def test_every_kind_comes_after_those_that_it_needs() -> None:
    for place, kind in enumerate(KINDS):
        assert set(NEEDS[kind]) <= set(KINDS[:place])
    kinds = {kind_of_map(outputs) for outputs in (["pull_off_force"], OUTPUTS, REPORTS)}
    assert kinds | {"general_" + kind for kind in kinds} <= set(KINDS)


def compiled_by(folder: Path, *codes: str) -> list[list[str]]:
    """Names of the kernels that a process compiles, by each line of code."""
    script = (
        "from gradhesion.core import compile_kind, solve, watch_compilation\nfrom gradhesion.core.warmup import SCENE\n"
    )
    for code in codes:
        script += f"names = []\nwith watch_compilation(names.append):\n    {code}\nprint(*names)\n"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder)}
    done = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True)
    return [line.split() for line in done.stdout.splitlines()]


@pytest.mark.slow
def test_a_force_compiles_what_a_force_needs(tmp_path: Path) -> None:
    tables, force = compiled_by(tmp_path, "compile_kind('tables')", "compile_kind('force')")
    assert "scene.cosine.solve_pull_off" in force
    cycle = {
        "scene.cosine.solve_curve",
        "path.cosine.walk",
        "path.cosine_long.stride",
        "curve.cosine_energy.jump_energy",
        "contact.disc.disc_limits",
    }
    assert not cycle & {*tables, *force}
    assert len({*force}) == len(force), "no kernel for two types"
    assert compiled_by(tmp_path, "solve(SCENE, ['pull_off_radius'])") == [[]], "all of it is kept"


@pytest.mark.slow
def test_a_plain_interface_compiles_nothing_of_patterns(tmp_path: Path) -> None:
    kinds = compiled_by(tmp_path, "compile_kind('general_turning')", "compile_kind('general_reports')")
    names = {name for kind in kinds for name in kind}
    assert {"scene.general.solve_scenes", "turning.general.turn_scenes", "scene.general_report.report_scenes"} <= names
    assert {name for name in names if "pattern" in name} == set()


def test_rims_without_long_curves_are_those_that_are_walked() -> None:
    """What is announced needs no kernel: the numbers stand in core/kinds.py once more."""
    assert MANY_WAVES == {"": 0.5 * cosine.LONGEST_WALK, "general_": general_middle.LONGEST_WALK}
