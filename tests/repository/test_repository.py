"""What the repository promises about itself: examples run, commands are told, studies work, packages are whole."""

import doctest
import importlib
import inspect
import pkgutil
import re
import subprocess
import sys
import sysconfig
import tomllib
from importlib.machinery import PathFinder
from pathlib import Path

import numpy as np
import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import gradhesion
import gradhesion.cli
import gradhesion.core
import gradhesion.twin
from gradhesion.core.problem.inputs import INPUTS
from tests.conftest import ROOT

README = (ROOT / "README.md").read_text()
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
PACKAGES = (gradhesion, gradhesion.cli, gradhesion.core, gradhesion.twin)
MODULES = {one.name for root in PACKAGES for one in pkgutil.walk_packages(root.__path__, root.__name__ + ".")}
MODULES = {"gradhesion", *(name for name in MODULES if not name.endswith("__main__"))}
HEAVY = ("bokeh", "jinja2", "numpy", "numba", "scipy", "xarray", "netCDF4", "matplotlib", "pandas", "pint", "pydantic", "rich",
         "gradhesion.core", "gradhesion.twin", "flint")  # fmt: skip
EXTRAS = PROJECT["project"]["optional-dependencies"]
CLAIMS = [*PROJECT["project"]["dependencies"], *(name for extra in EXTRAS.values() for name in extra)]


def loaded(names: tuple[str, ...], *commands: list[str]) -> str:
    """What some commands, in a process of their own, import of some modules."""
    code = f"import sys; from gradhesion.cli.main import cli\nfor words in {commands!r}:\n  "
    code += f"cli.main(words, standalone_mode=False)\nprint([name for name in {names!r} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout.splitlines()[-1]


@pytest.mark.parametrize("name", sorted(MODULES))
def test_every_module_says_what_it_is_for_and_its_examples_run(name: str) -> None:
    module = importlib.import_module(name)
    assert module.__doc__
    assert doctest.testmod(module).failed == 0


@pytest.mark.slow
def test_commands_import_only_what_they_need(tmp_path: Path) -> None:
    study, file = str(ROOT / "configs" / "smoke.toml"), str(tmp_path / "x.nc")
    compilers, extras = ("numba", "llvmlite", "flint"), ("afmformats", "cryptography", "distributed")
    assert loaded(HEAVY, ["run", "--help"], ["--version"]) == "[]"
    assert loaded(("xarray", "pandas", "matplotlib", "pint", *extras), ["run", study, "-o", file, "--quiet"]) == "[]"
    assert loaded((*compilers, "dask", "pint", "scipy", *extras), ["info", file]) == "[]"
    assert loaded((*compilers, *extras), ["validate", study], ["plot", file]) == "[]"


def test_the_picture_of_the_readme_compares_like_with_like() -> None:
    """All its punches are pressed to one contact radius, which short waves reach before their hysteresis saturates."""
    from gradhesion.core import solve

    parameters = tomllib.loads((ROOT / "configs" / "maps.toml").read_text())["parameters"]
    own = {name: parameters[name] for name in ("nu", "modulus")} | {"c0_over_R": 0.01, "A": 0.05}
    assert "--at c0_over_R=0.01 --at A=0.05 --at a_max_over_R=0.3 " in (ROOT / "Makefile").read_text()
    assert "of punches that all end at a = 0.3 R" in README
    scene = own | {"k": np.linspace(0.0, 0.9, 28)[:, None], "lambda_over_R": [0.05, 0.1, 1 / 3, 0.5]}
    found = solve(scene | {"a_max_over_R": 0.3})
    smooth = solve(scene | {"a_max_over_R": 0.3, "k": 0.0, "A": 0.0})["pull_off_force"][0]
    force, energy = (found[name] for name in ("pull_off_force", "dissipated_energy"))
    assert 4.5 < force[:, 2].max() / smooth < 5.5, "five times, at a third"
    assert 0.2 < force[:, 3].min() / smooth < 0.3, "a quarter, at a half"
    assert (energy[-1, :2] < energy[0, :2] / 3.0).all()
    unbounded = solve(scene | {"a_max_over_R": np.inf}, ["dissipated_energy", "contact_slope"])["contact_slope"]
    assert (unbounded[0, 0], unbounded[:, 0].min()) == pytest.approx((4.9, 0.34), rel=0.03), "which is why"


def test_every_dependency_is_claimed_once_by_its_lowest_version_and_pinned_to_one_that_serves() -> None:
    text = (ROOT / "constraints.txt").read_text()
    assert "://" not in text
    pins: dict[str, list[str]] = {}
    for pin in map(Requirement, text.splitlines()):
        pins.setdefault(canonicalize_name(pin.name), []).append(str(pin.specifier).removeprefix("=="))
    for claim in map(Requirement, CLAIMS):
        assert [one.operator for one in claim.specifier] == [">="], f"{claim}: one lowest version, and no highest"
        assert all(version in claim.specifier for version in pins[canonicalize_name(claim.name)]), claim
    assert len({*CLAIMS}) == len({Requirement(claim).name for claim in CLAIMS}), "claimed twice, claimed alike"


def test_the_public_names_are_all_that_is_listed_and_every_parameter_is_a_keyword() -> None:
    assert dir(gradhesion) == sorted(gradhesion.__all__)
    assert not {"Any", "Final", "importlib", "sys"} & {*dir(gradhesion)}
    for call in (gradhesion.solve, gradhesion.curves):
        assert INPUTS.keys() <= inspect.signature(call).parameters.keys()


def test_make_alone_prints_the_targets() -> None:
    done = subprocess.run(["make", "-C", ROOT], capture_output=True, text=True, check=True)
    for target in ("docs", "maps", "test"):
        assert re.search(rf"^{target}\t", done.stdout, flags=re.MULTILINE)
        assert f"make {target}" in README


def test_the_package_is_found_without_the_hook_of_an_editable_installation() -> None:
    """As mypy and pyright look for it: in folders that `.pth` files name, and in site-packages itself."""
    site = Path(sysconfig.get_path("purelib"))
    named = [line for file in sorted(site.glob("*.pth")) for line in file.read_text().splitlines()]
    folders = [str(site), *(line for line in named if not line.startswith("import"))]
    found = PathFinder.find_spec("gradhesion", folders)
    assert found is not None, "install anew: rm .venv/installed, and make"
    assert found.origin is not None
    assert Path(found.origin).with_name("py.typed").exists()
