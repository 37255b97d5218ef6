"""What tools see of the package in an environment that the Makefile has made: types, and the public names."""

import inspect
import subprocess
import sysconfig
from importlib.machinery import PathFinder
from pathlib import Path

import gradhesion as gr
from gradhesion.core.problem.inputs import INPUTS

ROOT = Path(__file__).parents[2]


def test_the_public_names_are_all_that_is_listed() -> None:
    assert dir(gr) == sorted(gr.__all__)
    assert not {"Any", "Final", "importlib", "sys"} & {*dir(gr)}


def test_every_parameter_is_a_keyword_that_editors_complete() -> None:
    for call in (gr.solve, gr.curves):
        assert INPUTS.keys() <= inspect.signature(call).parameters.keys()


def test_both_ways_of_installing_show_the_sources_to_tools() -> None:
    """A finder hook is all that an editable installation has: to mypy, pyright and jedi it says nothing."""
    make = ["make", "--dry-run", "--always-make", ".venv/complete"]
    done = subprocess.run(make, cwd=ROOT, capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    (place,) = [line for line in lines if "gradhesion.pth" in line]
    assert str(ROOT / "build" / "types") in place
    assert any(line.startswith("ln -s") and "api/__init__.py" in line for line in lines)


def test_the_package_is_found_without_the_hook_of_an_editable_installation() -> None:
    """As mypy and pyright look for it: in folders that `.pth` files name, and in site-packages itself."""
    site = Path(sysconfig.get_path("purelib"))
    named = [line for file in sorted(site.glob("*.pth")) for line in file.read_text().splitlines()]
    folders = [str(site), *(line for line in named if not line.startswith("import"))]
    found = PathFinder.find_spec("gradhesion", folders)
    assert found is not None, "install anew: rm .venv/installed, and make"
    assert found.origin is not None
    assert Path(found.origin).with_name("py.typed").exists()
