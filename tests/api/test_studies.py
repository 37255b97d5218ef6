"""`import gradhesion as gr`, light, whole and typed; and `gr.load` and `gr.run`: a study as a file, as a mapping, changed by keys."""

import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from tests.conftest import mistakes

SET = [
    ("parameters.A", 0.02), ("parameters.A", [0.0, 0.01]), ("parameters.A", np.array([0.0, 0.01])), ("parameters.k", np.float64(0.3)),
    ("parameters.a_max_over_R", float("inf")), ("parameters.A", 1e-7), ("parameters.A", {"start": 0.0, "stop": 0.1, "num": 3}),
    ("title", 'quotes " and \\ and \n a line'), ("title", "Ångström"), ("method.check_contact", False),
    ("method.solver", ("exact", "envelope")), ("profile", {"exponent": 1.7, "harmonics": [{"n": 1, "cos": 1.0}]}),
]  # fmt: skip


def alone(code: str) -> str:
    """What a program prints; that packages of others use what is out of date is theirs."""
    command = [sys.executable, "-W", "error", "-W", "default::DeprecationWarning", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_the_import_loads_nothing_and_names_alone_no_array() -> None:
    code = "import sys, importlib, typing; before = {*sys.modules}; import gradhesion as gr; gr.__all__, dir(gr)\n"
    code += "print(sorted({*sys.modules} - before)); "
    code += "gr.OUTPUTS, gr.PARAMETERS, gr.CURVES, gr.StudyError, gr.__version__\n"
    code += "print([name for name in ('numpy', 'xarray', 'click', 'numba', 'pydantic') if name in sys.modules])"
    assert alone(code).splitlines() == ["['gradhesion']", "[]"]


def test_what_computes_nothing_needs_no_compiler(data: dict[str, Any], tmp_path: Path) -> None:
    data["method"] = {"solver": "envelope"}
    gr.run(data).to_netcdf(tmp_path / "x.nc")
    (tmp_path / "study.toml").write_text(gr.load(data).text)
    code = (
        f"import os, sys, gradhesion as gr, xarray; os.chdir({str(tmp_path)!r})\nprint(hasattr(xarray.Dataset, 'gr'))\n"
    )
    code += "gr.load('study.toml'); gr.open('x.nc').gr.valid(); gr.plot('x.nc'); print(hasattr(xarray.Dataset, 'gr'))\n"
    code += "print([name for name in ('numba', 'llvmlite') if name in sys.modules])"
    assert alone(code).split() == ["False", "True", "[]"], "the accessor comes with the first dataset"


def test_every_name_is_there_and_says_what_it_is() -> None:
    for name in gr.__all__:
        assert name in dir(gr)
        assert not callable(getattr(gr, name)) or getattr(gr, name).__doc__, name
    with pytest.raises(AttributeError, match="module 'gradhesion' has no attribute 'slove'"):
        gr.slove  # noqa: B018


def test_the_package_runs_as_a_command() -> None:
    done = subprocess.run([sys.executable, "-m", "gradhesion", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.split()[-1] == gr.__version__ == version("gradhesion")


def test_what_was_imported_before_is_still_there_and_the_accessor_where_xarray_was() -> None:
    code = "import xarray; from gradhesion.core import solve, Profile; from gradhesion.cli.dataset import compute; import gradhesion\n"
    code += (
        "from gradhesion.cli.study import load_study, study_from, Study\nfrom gradhesion.cli.errors import StudyError\n"
    )
    code += "print(gradhesion.StudyError is StudyError, gradhesion.Study is Study, hasattr(xarray.Dataset, 'gr'))"
    assert alone(code) == "True True True"


def test_a_study_is_a_file_or_a_mapping_or_what_load_gave(study_file: Path, data: dict[str, Any]) -> None:
    changes, before = {"outputs": ["pull_off_force"], "title": "x"}, repr(data)
    ways = [gr.run(study, set=changes) for study in (study_file, str(study_file), data, gr.load(study_file))]
    assert all(way.drop_attrs().identical(ways[0].drop_attrs()) for way in ways)
    assert {way.attrs["title"] for way in ways} == {"x"}
    assert repr(data) == before, "a mapping stays as it is"
    assert list(ways[0].data_vars) == ["pull_off_force", "status"]


@pytest.mark.parametrize(("key", "value"), SET)
def test_a_key_is_set_alike_in_file_and_mapping(key: str, value: Any, study_file: Path, data: dict[str, Any]) -> None:
    if key == "title" and "\n" in value:
        for study in (study_file, data):
            with pytest.raises(gr.StudyError, match="a title is one line of printable characters"):
                gr.load(study, set={key: value})
        return
    one, other = gr.load(study_file, set={key: value}), gr.load(data, set={key: value})
    assert (one.sizes, one.title, one.method, one.profile) == (other.sizes, other.title, other.method, other.profile)
    for name, values in one.parameters.items():
        np.testing.assert_array_equal(values, other.parameters[name])


def test_mistakes_name_the_key_that_was_set(study_file: Path, data: dict[str, Any]) -> None:
    wrong = {"parameters.A": -1.0, "outputs": ["pull_of_force"]}
    first, second = mistakes(gr.load, study_file, set=wrong)
    assert first.startswith("set parameters.A=-1.0: parameters.A = -1.0: ")
    assert second.startswith('set outputs=["pull_of_force"]: outputs[0] = "pull_of_force": ')
    with pytest.raises(gr.StudyError, match=r"set title\.x: "):
        gr.load(data, set={"title.x": 1})
    with pytest.raises(gr.StudyError, match="threads = 0: "):
        gr.run(data, threads=0)


@pytest.mark.parametrize("changes", ["parameters.A=0.02", ["parameters.A=0.02"], {3: 0.02}, {"parameters.A": None}])
def test_what_is_set_is_a_mapping(changes: Any, study_file: Path, data: dict[str, Any]) -> None:
    for study in (study_file, data, gr.load(data)):
        with pytest.raises(gr.StudyError, match=r"^set"):
            gr.run(study, set=changes)


def test_run_is_the_command(study_file: Path, gradhesion: Callable[..., Any], tmp_path: Path) -> None:
    assert gradhesion("run", study_file, "-o", tmp_path / "x.nc", "--quiet").exit_code == 0
    with gr.open(tmp_path / "x.nc") as written:
        found = gr.run(study_file, threads=1).drop_attrs(deep=False)
        xarray.testing.assert_identical(found, written.drop_attrs(deep=False))
