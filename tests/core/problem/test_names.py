"""Names cost no compiler, and are those that the rest of the core goes by."""

import subprocess
import sys

import pytest

import gradhesion.core
from gradhesion.core.problem.names import CURVES, OUTPUTS, PULL_OFF, REPORTS, SOLVERS

LIGHT = {"CONTROLS", "CURVES", "DOUBTFUL", "FAILED", "FLAGS", "OUTPUTS", "PARAMETERS", "REPORTS", "SOLVERS"}
LIGHT |= {"Harmonic", "Loading", "Profile", "doubts_about"}


@pytest.mark.parametrize(
    "code",
    [
        f"from gradhesion.core import {', '.join(sorted(LIGHT))}",
        "from gradhesion.core.problem.profile import Profile",
        "from gradhesion.core.problem.control import Loading",
        "import gradhesion.core; dir(gradhesion.core)",
    ],
)
def test_light_names_import_no_compiler(code: str) -> None:
    show = f"{code}\nimport sys; print({{'numba', 'llvmlite', 'scipy', 'platformdirs'}} & sys.modules.keys())"
    done = subprocess.run([sys.executable, "-c", show], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_every_name_is_there_and_no_other() -> None:
    for name in gradhesion.core.__all__:
        assert getattr(gradhesion.core, name) is not None
        assert name in dir(gradhesion.core)
    with pytest.raises(AttributeError, match="has no attribute 'solv'"):
        gradhesion.core.solv  # noqa: B018


def test_the_order_is_that_of_the_rows() -> None:
    from gradhesion.core.problem import results
    from gradhesion.core.scene import cosine_report as report
    from gradhesion.core.scene import solvers

    assert [OUTPUTS.index(name) for name in PULL_OFF] == [results.FORCE, results.RADIUS]
    assert OUTPUTS.index("dissipated_energy") == results.ENERGY
    assert OUTPUTS.index("delta_jump_out") == results.LAST
    assert OUTPUTS.index("unloading_energy") == results.UNLOADED
    assert REPORTS.index("energy_gain") == report.ENERGY_GAIN
    assert {*solvers.LOOPS, "asymptotic"} == {*SOLVERS}
    assert "jump_energy" in CURVES["jumps"]
