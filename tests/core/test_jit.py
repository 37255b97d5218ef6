"""Compiled kernels are found again by other processes, compiled anew when a source changes, and never taken from others."""

import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from gradhesion.core.jit import CORE, changeable

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has other rights")
as_root = pytest.mark.skipif(
    sys.platform != "win32" and os.getuid() != 0, reason="files of another user are made by root alone"
)
OTHER = 12345
"""Another user."""

KERNELS = """
import json
import numba
before = numba.config.CACHE_DIR
from gradhesion.core.jit import SOURCES, kernel, leaf, place

@leaf
def square(x):
    return x * x

@kernel
def hypotenuse_squared(x, y):
    return square(x) + square(y)

@numba.njit(cache=True)
def of_the_user(x):
    return x + 1.0

print(json.dumps({
    "value": hypotenuse_squared(3.0, 4.0), "compiled": sum(hypotenuse_squared.stats.cache_misses.values()),
    "found": sum(hypotenuse_squared.stats.cache_hits.values()), "folder": str(place().folder), "why": place().why,
    "digest": SOURCES, "untouched": numba.config.CACHE_DIR == before, "own": of_the_user.stats.cache_path,
}))
"""
"""A program with kernels, and one of its user's own."""


def ended(script: Path, tree: Path | None = None, **environment: str) -> dict[str, Any]:
    """Run the program in a process of its own, with the package of a tree if one is given."""
    script.write_text(KERNELS)
    unset = ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")
    inherited = {name: value for name, value in os.environ.items() if name not in unset}
    if tree is not None:
        environment["PYTHONPATH"] = str(tree)
    done = subprocess.run(
        [sys.executable, script], env=inherited | environment, cwd="/", capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    found: dict[str, Any] = json.loads(done.stdout)
    assert found["value"] == 25.0
    return found


@pytest.fixture
def shared() -> Iterator[Path]:
    """A folder in which everybody can write, as those for temporary files; not below one that others cannot enter."""
    folder = Path(os.path.realpath(tempfile.mkdtemp()))
    folder.chmod(0o1777)
    yield folder
    shutil.rmtree(folder)


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A copy of the core, in a package of its own."""
    package = tmp_path / "tree" / "gradhesion"
    shutil.copytree(CORE, package / "core", ignore=shutil.ignore_patterns("__pycache__"))
    (package / "__init__.py").touch()
    return package.parent


def test_a_process_finds_what_another_has_compiled_and_leaves_the_kernels_of_the_user_alone(tmp_path: Path) -> None:
    first, second = (ended(tmp_path / "program.py", NUMBA_CACHE_DIR=str(tmp_path / "cache")) for _ in range(2))
    assert (first["compiled"], first["found"]) == (1, 0)
    assert (second["compiled"], second["found"]) == (0, 1)
    assert Path(first["folder"]).parent == Path(first["own"]).parent == tmp_path / "cache", "the user's own stay there"
    assert first["untouched"]
    assert first["why"] == ""


def test_a_change_of_any_source_compiles_anew(tree: Path, tmp_path: Path) -> None:
    def again() -> dict[str, Any]:
        return ended(tmp_path / "program.py", tree, NUMBA_CACHE_DIR=str(tmp_path / "cache"))

    before = again()
    source = tree / "gradhesion" / "core" / "problem" / "names.py"  # it has no kernel
    content = source.read_bytes()
    source.write_bytes(content + b"\n")
    after = again()
    assert after["compiled"] == 1
    assert after["folder"] != before["folder"]
    assert after["digest"] != before["digest"]
    source.write_bytes(content)
    assert again() == before | {"found": 1, "compiled": 0}
    here = ended(tmp_path / "program.py", NUMBA_CACHE_DIR=str(tmp_path / "cache"))
    assert here["digest"] == before["digest"], "the same sources, wherever they stand"
    assert here["folder"] != before["folder"], "numba keeps code by the path of its source"


def test_an_import_never_fails(tmp_path: Path) -> None:
    """A file stands where each folder would be made: none can be written, not even by root."""
    (tmp_path / "file").touch()
    below = str(tmp_path / "file" / "below")
    blocked = dict.fromkeys(("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"), below)
    elsewhere = ended(tmp_path / "program.py", TMPDIR=str(tmp_path), **blocked)
    assert Path(elsewhere["folder"]).is_relative_to(tmp_path)
    assert below in elsewhere["why"]
    assert stat.S_IMODE(Path(elsewhere["folder"]).stat().st_mode) == 0o700
    (tmp_path / f"gradhesion-{os.getuid()}").rename(tmp_path / "aside")
    (tmp_path / f"gradhesion-{os.getuid()}").touch()
    nowhere = ended(tmp_path / "program.py", TMPDIR=str(tmp_path), **blocked)
    assert nowhere["folder"] == "None"
    assert nowhere["found"] == 0
    assert nowhere["why"]


def test_folders_of_other_versions_go_after_a_month(tmp_path: Path) -> None:
    days = {"kernels-000000000000000a": 31, "kernels-000000000000000b": 29, "kernels-old": 31, "numba": 31}
    for name, age in days.items():
        (tmp_path / name / "core").mkdir(parents=True)
        then = (tmp_path / name).stat().st_mtime - 86400 * age
        os.utime(tmp_path / name, (then, then))
    used = Path(ended(tmp_path / "program.py", NUMBA_CACHE_DIR=str(tmp_path))["folder"])
    then = used.stat().st_mtime - 86400 * 31
    os.utime(used, (then, then))
    again = ended(tmp_path / "program.py", NUMBA_CACHE_DIR=str(tmp_path))
    assert (again["folder"], again["compiled"]) == (str(used), 0), "its own stays, however long nobody used it"
    assert [name for name in days if not (tmp_path / name).exists()] == ["kernels-000000000000000a"]


@pytest.fixture
def kept(shared: Path) -> Path:
    """A folder of this user, two files deep, that others can read."""
    inner = shared / "kernels" / "core"
    inner.mkdir(parents=True)
    for name in ("one.nbi", "one.nbc"):
        (inner / name).touch()
    for path in (inner, inner.parent):
        path.chmod(0o755)
    return inner.parent


def test_what_is_ours_in_a_folder_for_all(kept: Path) -> None:
    assert changeable(kept) == ""


@pytest.mark.parametrize("name", [".", "core", "core/one.nbi", "core/one.nbc"])
@pytest.mark.parametrize("mode", [0o775, 0o757])
def test_what_others_can_write(kept: Path, name: str, mode: int) -> None:
    (kept / name).chmod(mode)
    assert str(kept / name) in changeable(kept)
    kept.chmod(0o700)
    assert changeable(kept) == "", "they cannot enter"


def test_what_is_closed_beside_it_protects_nothing(kept: Path) -> None:
    (kept / "aside").mkdir(mode=0o700)
    (kept / "core").chmod(0o777)
    assert str(kept / "core") in changeable(kept)


@pytest.mark.parametrize(
    ("mode", "safe"), [(0o777, False), (0o775, False), (0o1777, True), (0o755, True), (0o700, True)]
)
def test_a_folder_above_in_which_others_can_rename(shared: Path, kept: Path, mode: int, safe: bool) -> None:
    shared.chmod(mode)
    assert (changeable(kept) == "") == safe


def test_the_sticky_bit_of_the_folder_itself_is_no_help(kept: Path) -> None:
    kept.chmod(0o1777)
    assert str(kept) in changeable(kept)


@as_root
@pytest.mark.parametrize("name", ["..", ".", "core", "core/one.nbi", "core/one.nbc"])
def test_what_belongs_to_another_user(shared: Path, kept: Path, name: str) -> None:
    os.chown(kept / name, OTHER, OTHER)
    theirs = str(shared if name == ".." else kept / name)
    assert theirs in changeable(kept)
    if name != ".":
        kept.chmod(0o700)
        assert theirs in changeable(kept), "nor does it help to close it afterwards"


def test_links(shared: Path, kept: Path) -> None:
    (shared / "link").symlink_to(kept)
    assert str(shared / "link") in changeable(shared / "link")
    (kept / "core" / "two.nbi").symlink_to(kept / "core" / "one.nbi")
    assert str(kept / "core" / "two.nbi") in changeable(kept)


BELOW = {"NUMBA_CACHE_DIR": ".", "XDG_CACHE_HOME": "gradhesion", "TMPDIR": f"gradhesion-{os.getuid()}"}
"""Where kernels are kept in a folder that the environment names."""


def through(route: str, shared: Path, script: Path) -> dict[str, Any]:
    """Run the program with its cache in a folder, by a variable of the environment."""
    elsewhere = __file__ if route == "TMPDIR" else str(shared / "home")  # a file is in the way
    return ended(script, **{"XDG_CACHE_HOME": elsewhere, route: str(shared)})


@as_root
@pytest.mark.parametrize(
    ("route", "theirs"),
    [
        ("NUMBA_CACHE_DIR", "the files"),
        ("XDG_CACHE_HOME", "the folder"),
        ("TMPDIR", "the folder above"),
        ("NUMBA_CACHE_DIR", ""),  # the check of the check: what is ours is read
    ],
)
def test_a_pickle_of_another_user_is_not_run(shared: Path, tmp_path: Path, route: str, theirs: str) -> None:
    """Indices that run a command when they are read stand where the program looks for its own."""
    above, script = shared / BELOW[route], tmp_path / "program.py"
    folder = Path(through(route, shared, script)["folder"])
    assert folder.parent == above.resolve()
    planted = [*folder.rglob("*.nbi")]
    assert planted
    for path in planted:
        path.write_text(f"cposix\nsystem\n(S'touch {tmp_path / 'run'}'\ntR.")
    files = [path for path in folder.rglob("*") if path.is_file()]
    owned = {"": [], "the files": files, "the folder": [folder, *files], "the folder above": [above, folder, *files]}
    for path in owned[theirs]:
        os.chown(path, OTHER, OTHER)
    found = through(route, shared, script)
    assert (tmp_path / "run").exists() == (not theirs)
    assert (found["folder"] == str(folder)) == (not theirs)
    if theirs:
        assert str(above) in found["why"]
