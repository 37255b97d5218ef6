"""What is built holds all of the program and nothing else, and works away from the repository."""

import ast
import os
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from importlib.metadata import packages_distributions
from pathlib import Path
from shutil import copytree, ignore_patterns

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.conftest import ROOT

pytestmark = pytest.mark.slow

CONFIGURATION = tomllib.loads((ROOT / "pyproject.toml").read_text())
PROJECT = CONFIGURATION["project"]
FOLDERS = CONFIGURATION["tool"]["setuptools"]["package-dir"]
TOPS = sorted({folder.split("/")[0] for folder in FOLDERS.values()})
LEFT_OUT = ignore_patterns(".*", "__pycache__", "build", "dist", "outputs", "*.egg-info", "figures", "images")


SOURCES = {
    path.relative_to(ROOT).as_posix()
    for top in TOPS
    for path in (ROOT / top).rglob("*")
    if path.is_file() and "__pycache__" not in path.parts
}
"""What belongs into a wheel, as it stands in the tree."""


def call(*arguments: str | Path, cwd: Path, **environment: str) -> str:
    """What Python prints in a folder."""
    command, own = [sys.executable, *arguments], os.environ | environment
    done = subprocess.run(command, cwd=cwd, env=own, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def install(wheels: Path, folder: Path) -> None:
    (wheel,) = wheels.glob("*.whl")
    call("-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", folder, wheel, cwd=folder.parent)


def build(kind: str, tree: Path, folder: Path) -> None:
    """Build from a copy: a build leaves folders behind."""
    pytest.importorskip("setuptools", minversion="77")  # as pyproject.toml asks; the extra `test` has it
    if not tree.exists():
        copytree(ROOT, tree, ignore=LEFT_OUT)
    call("-c", f"from setuptools import build_meta; build_meta.build_{kind}({str(folder)!r})", cwd=tree)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("built")
    for kind in ("sdist", "wheel"):
        build(kind, folder / "tree", folder)
    return folder


def test_the_wheel_has_the_program_and_nothing_else(built: Path) -> None:
    (wheel,) = built.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.endswith("/")}
    information = {name for name in names if ".dist-info/" in name}
    # the folder api/ is the package itself, the others are its sub-packages
    assert names - information == {f"gradhesion/{name.removeprefix('api/')}" for name in SOURCES}
    assert {name.rpartition("/")[2] for name in information} == {
        "LICENSE", "METADATA", "RECORD", "WHEEL", "entry_points.txt", "top_level.txt",
    }  # fmt: skip


def test_the_source_has_what_a_build_needs_and_no_outputs(built: Path) -> None:
    (path,) = built.glob("*.tar.gz")
    with tarfile.open(path) as archive:
        names = {member.name.partition("/")[2] for member in archive.getmembers() if member.isfile()}
    of_a_reader = {"README.md", "LICENSE", "CHANGELOG.md", "CITATION.cff"}
    assert names >= SOURCES | of_a_reader | {"pyproject.toml", "constraints.txt"}  # pip install -c constraints.txt .
    assert not [name for name in names if name.startswith(("outputs", "build", "."))]


def _imported(folder: str) -> set[str]:
    """List the top-level modules that the files of a folder import, at any depth."""
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in (ROOT / folder).rglob("*.py")]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    plain = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    named = {str(node.module) for node in nodes if isinstance(node, ast.ImportFrom) and not node.level}
    return {name.partition(".")[0] for name in plain | named}


def test_every_package_that_is_imported_is_declared() -> None:
    declared = {canonicalize_name(Requirement(each).name) for each in PROJECT["dependencies"]}
    extras = [each for name in ("afm", "cluster") for each in PROJECT["optional-dependencies"][name]]
    of_extras = {canonicalize_name(Requirement(each).name) for each in extras}
    homes = packages_distributions()
    used = {name for top in TOPS for name in _imported(top)} - {"gradhesion"} - sys.stdlib_module_names
    owners = {canonicalize_name(homes[name][0]) for name in used}
    assert owners == declared | of_extras


def test_the_installed_program_works_away_from_the_repository(built: Path, tmp_path: Path) -> None:
    installed, elsewhere = tmp_path / "installed", tmp_path / "elsewhere"
    elsewhere.mkdir()
    install(built, installed)
    assert sorted(path.name for path in installed.iterdir() if path.suffix != ".dist-info") == ["bin", "gradhesion"]

    def there(*arguments: str) -> str:
        cache = str(tmp_path / "cache")
        return call(*arguments, cwd=elsewhere, PYTHONPATH=str(installed), XDG_CACHE_HOME=cache)

    code = "import gradhesion, gradhesion.cli, gradhesion.core, gradhesion.scenes as scenes; "
    code += "print(*(one.__file__ for one in (gradhesion, gradhesion.cli, gradhesion.core, scenes)))"
    assert there("-c", code).count(str(installed)) == 4
    for program in (["-m", "gradhesion.cli"], ["-m", "gradhesion"], [str(installed / "bin" / "gradhesion")]):
        assert "run" in there(*program, "--help")
    there("-m", "gradhesion.cli", "init", "smoke")
    sets = ["parameters.k=0.5", "parameters.A=0.0", 'outputs=["pull_off_force"]']
    sets.append('method={ solver = "envelope" }')  # which compiles little
    there("-m", "gradhesion.cli", "run", "smoke.toml", "-o", "smoke.nc", *(f"--set={entry}" for entry in sets))
    assert "1.166667" in there("-m", "gradhesion.cli", "info", "smoke.nc")  # (3 + k)/3
    code = "import gradhesion as gr; print(gr.open('smoke.nc').gr.valid().all().item(), gr.load('smoke.toml').kind)"
    assert there("-c", code).split() == ["True", "map"]


def test_an_editable_installation_has_the_same_package_and_sees_new_modules(tmp_path: Path) -> None:
    tree, elsewhere, installed = tmp_path / "tree", tmp_path / "elsewhere", tmp_path / "installed"
    for folder in (elsewhere, installed):
        folder.mkdir()
    build("editable", tree, installed)
    install(installed, installed)
    (tree / "api" / "added.py").write_text('"""Added later."""\n')
    # -S, and other packages by their path alone: the editable installation of this very environment must not answer.
    code = (
        f"import sys, site; site.addsitedir({str(installed)!r}); sys.path.append({sysconfig.get_path('purelib')!r}); "
        "import gradhesion, gradhesion.added, gradhesion.core.problem.status, gradhesion.configs, gradhesion.cli.study.study; "
        "print(gradhesion.__file__, gradhesion.added.__file__, gradhesion.core.problem.status.__file__, "
        "gradhesion.cli.study.study.__file__, gradhesion.configs.__file__, gradhesion.load.__module__)"
    )
    *files, module = call("-S", "-c", code, cwd=elsewhere, PYTHONPATH="").split()
    assert [Path(file).relative_to(tree).parts[0] for file in files] == ["api", "api", "core", "cli", "configs"]
    assert module == "gradhesion.studies"
