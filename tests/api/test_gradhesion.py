"""`import gradhesion as gr`: light, whole and typed."""

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest

import gradhesion as gr


def alone(code: str) -> str:
    """What a program prints; that packages of others use what is out of date is theirs."""
    command = [sys.executable, "-W", "error", "-W", "default::DeprecationWarning", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_the_import_loads_nothing() -> None:
    before = "import sys, importlib, typing; before = {*sys.modules}; import gradhesion as gr; gr.__all__, dir(gr); "
    assert alone(before + "print(sorted({*sys.modules} - before))") == "['gradhesion']"


def test_names_alone_load_no_array() -> None:
    code = "import sys, gradhesion as gr; gr.OUTPUTS, gr.PARAMETERS, gr.CURVES, gr.StudyError, gr.__version__; "
    code += "print([name for name in ('numpy', 'xarray', 'click', 'numba', 'pydantic') if name in sys.modules])"
    assert alone(code) == "[]"


def test_what_computes_nothing_needs_no_compiler(data: dict[str, Any], tmp_path: Path) -> None:
    data["method"] = {"solver": "envelope"}
    gr.run(data).to_netcdf(tmp_path / "x.nc")
    (tmp_path / "study.toml").write_text(gr.load(data).text)
    code = f"import os, sys, gradhesion as gr; os.chdir({str(tmp_path)!r}); gr.load('study.toml'); gr.open('x.nc').gr.valid(); gr.plot('x.nc'); "
    assert alone(code + "print([name for name in ('numba', 'llvmlite') if name in sys.modules])") == "[]"


@pytest.mark.parametrize("name", gr.__all__)
def test_every_name_is_there_and_says_what_it_is(name: str) -> None:
    value = getattr(gr, name)
    assert name in dir(gr)
    if callable(value):
        assert value.__doc__


def test_a_name_that_is_not_there() -> None:
    with pytest.raises(AttributeError, match="module 'gradhesion' has no attribute 'slove'"):
        gr.slove  # noqa: B018


def test_the_package_runs_as_a_command() -> None:
    done = subprocess.run([sys.executable, "-m", "gradhesion", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.split()[-1] == gr.__version__ == version("gradhesion")


def test_what_was_imported_before_is_still_there_and_the_accessor_where_xarray_was() -> None:
    code = (
        "import xarray; from gradhesion.core import solve, Profile; from gradhesion.cli.study import load_study, study_from, Study; "
        "from gradhesion.cli.dataset import compute; from gradhesion.cli.errors import StudyError; import gradhesion; "
        "print(gradhesion.StudyError is StudyError, gradhesion.Study is Study, hasattr(xarray.Dataset, 'gr'))"
    )
    assert alone(code) == "True True True"
    accessor = "print(hasattr(xarray.Dataset, 'gr')); "
    assert alone(f"import gradhesion, xarray; {accessor} gradhesion.open; {accessor}").split() == ["False", "True"]
