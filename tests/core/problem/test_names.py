"""Names cost no compiler, and are those that the rest of the core goes by."""

import subprocess
import sys

import pytest

import gradhesion.core

LIGHT = "CONTROLS, CURVES, DOUBTFUL, FAILED, FLAGS, OUTPUTS, PARAMETERS, REPORTS, SOLVERS, Harmonic, Loading, Profile"


def test_light_names_import_no_compiler() -> None:
    show = f"from gradhesion.core import {LIGHT}, doubts_about\nimport gradhesion.core, sys; dir(gradhesion.core)\n"
    show += "print({'numba', 'llvmlite', 'scipy', 'platformdirs'} & sys.modules.keys())"
    done = subprocess.run([sys.executable, "-c", show], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


def test_every_name_is_there_and_no_other() -> None:
    for name in gradhesion.core.__all__:
        assert getattr(gradhesion.core, name) is not None
        assert name in dir(gradhesion.core)
    with pytest.raises(AttributeError, match="has no attribute 'solv'"):
        gradhesion.core.solv  # noqa: B018
