"""Names cost no compiler, and are those that the rest of the core goes by."""

import subprocess
import sys

import pytest

import gradhesion.core

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
