"""Compiled kernels are found again by other processes, compiled anew when a source changes, and never taken from others."""

import ast
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
is_root = sys.platform == "win32" or os.getuid() == 0
as_root = pytest.mark.skipif(not is_root, reason="files of another user are made by root alone")
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

@kernel
def half(x):
    return 0.5 * x

@leaf
def quarter(x):
    return half(half(x))

quarter(1.0)
code = "".join(half.inspect_llvm().values()) if half.stats.cache_misses else ""

print(json.dumps({
    "inherits": "alwaysinline" in code,
    "value": hypotenuse_squared(3.0, 4.0), "compiled": sum(hypotenuse_squared.stats.cache_misses.values()),
    "found": sum(hypotenuse_squared.stats.cache_hits.values()), "folder": str(place().folder), "why": place().why,
    "digest": SOURCES, "untouched": numba.config.CACHE_DIR == before, "own": of_the_user.stats.cache_path,
}))
"""
"""A program with kernels, and one of its user's own."""
NAMES = [".", "core", "core/one.nbi", "core/one.nbc"]


def ended(script: Path, tree: Path | None = None, **environment: str) -> dict[str, Any]:
    """Run the program in a process of its own, with the package of a tree if one is given."""
    if not script.exists():  # some versions of numba compile anew what is as it was, but written again
        script.write_text(KERNELS)
    unset = ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")
    own = {name: value for name, value in os.environ.items() if name not in unset} | environment
    own |= {"PYTHONPATH": str(tree)} if tree is not None else {}
    done = subprocess.run([sys.executable, script], env=own, cwd="/", capture_output=True, text=True, check=False)
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
def kept(shared: Path) -> Path:
    """A folder of this user, two files deep, that others can read."""
    inner = shared / "kernels" / "core"
    inner.mkdir(parents=True)
    for name in ("one.nbi", "one.nbc"):
        (inner / name).touch()
    for path in (inner, inner.parent):
        path.chmod(0o755)
    return inner.parent


def test_kernels_are_found_again_compiled_anew_for_other_sources_and_kept_for_a_month(tmp_path: Path) -> None:
    cache, script = tmp_path / "cache", tmp_path / "program.py"
    days = {"kernels-000000000000000a": 31, "kernels-000000000000000b": 29, "kernels-old": 31, "numba": 31}

    def run(tree: Path | None = None) -> dict[str, Any]:
        return ended(script, tree, NUMBA_CACHE_DIR=str(cache))

    first = run()
    assert (first["compiled"], first["found"], first["why"]) == (1, 0, "")
    assert Path(first["folder"]).parent == Path(first["own"]).parent == cache, "the user's own stay there"
    assert first["untouched"]
    assert not first["inherits"], "how a kernel is compiled does not depend on who calls it first"
    for name, age in (days | {Path(first["folder"]).name: 31}).items():
        (cache / name / "core").mkdir(parents=True, exist_ok=True)
        then = (cache / name).stat().st_mtime - 86400 * age
        os.utime(cache / name, (then, then))
    assert run() == first | {"compiled": 0, "found": 1}, "its own stays, however long nobody used it"
    assert [name for name in days if not (cache / name).exists()] == ["kernels-000000000000000a"]
    package = tmp_path / "tree" / "gradhesion"
    shutil.copytree(CORE, package / "core", ignore=shutil.ignore_patterns("__pycache__"))
    (package / "__init__.py").touch()
    copied = run(package.parent)
    assert (copied["compiled"], copied["digest"]) == (1, first["digest"]), "the same sources, wherever they stand"
    assert copied["folder"] != first["folder"], "numba keeps code by the path of its source"
    with (package / "core" / "problem" / "names.py").open("a") as source:  # it has no kernel
        source.write("\n")
    changed = run(package.parent)
    assert changed["compiled"] == 1
    assert changed["folder"] != copied["folder"]
    assert changed["digest"] != copied["digest"]


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
    assert (nowhere["folder"], nowhere["found"]) == ("None", 0)
    assert nowhere["why"]


@as_root
def test_a_pickle_of_another_user_is_not_run(shared: Path, tmp_path: Path) -> None:
    """Indices that run a command when they are read stand where the program looks for its own."""
    script, where = tmp_path / "program.py", {"NUMBA_CACHE_DIR": str(shared), "XDG_CACHE_HOME": str(shared / "home")}
    folder = Path(ended(script, **where)["folder"])
    planted = [*folder.rglob("*.nbi")]
    assert planted
    for path in planted:
        path.write_text(f"cposix\nsystem\n(S'touch {tmp_path / 'run'}'\ntR.")
        os.chown(path, OTHER, OTHER)
    found = ended(script, **where)
    assert not (tmp_path / "run").exists()
    assert found["folder"] != str(folder)
    assert str(folder) in found["why"]
    for path in planted:  # the check of the check: what is ours is read
        os.chown(path, os.getuid(), -1)
    assert ended(script, **where)["folder"] == str(folder)
    assert (tmp_path / "run").exists()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("mode", [0o775, 0o757])
def test_what_others_can_write(kept: Path, name: str, mode: int) -> None:
    assert changeable(kept) == "", "what is ours in a folder for all"
    (kept / name).chmod(mode)
    (kept / "aside").mkdir(mode=0o700)
    assert str(kept / name) in changeable(kept), "what is closed beside it protects nothing"
    kept.chmod(0o700)
    assert changeable(kept) == "", "they cannot enter"


@pytest.mark.parametrize("mode", [0o777, 0o775, 0o1777, 0o755, 0o700])
def test_a_folder_above_in_which_others_can_rename_and_links(shared: Path, kept: Path, mode: int) -> None:
    shared.chmod(mode)
    assert (changeable(kept) == "") == (mode in (0o1777, 0o755, 0o700))
    kept.chmod(0o1777)
    assert (changeable(kept) == "") == (mode == 0o700), "the sticky bit of the folder itself is no help"
    (shared / "link").symlink_to(kept)
    (kept / "core" / "two.nbi").symlink_to(kept / "core" / "one.nbi")
    kept.chmod(0o755)
    if mode == 0o755:
        assert str(shared / "link") in changeable(shared / "link")
        assert str(kept / "core" / "two.nbi") in changeable(kept)


@as_root
@pytest.mark.parametrize("name", ["..", *NAMES])
def test_what_belongs_to_another_user(shared: Path, kept: Path, name: str) -> None:
    os.chown(kept / name, OTHER, OTHER)
    theirs = str(shared if name == ".." else kept / name)
    assert theirs in changeable(kept)
    if name != ".":
        kept.chmod(0o700)
        assert theirs in changeable(kept), "nor does it help to close it afterwards"


def test_kernels_that_make_no_arrays_reduce_none() -> None:
    """Numba compiles max, min and the like of an array as a kernel that makes some, which fails where none are counted.

    Unless it has been compiled before for one that counts: that depends on what is kept of earlier runs.
    """
    uncounted = {"kernel", "leaf", "inlined", "quadrature_leaf"}
    reducing = {"max", "min", "sum", "mean", "prod", "any", "all", "argmax", "argmin", "copy", "ravel", "astype"}
    seen, found = 0, []
    for path in CORE.rglob("*.py"):
        for function in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if (
                isinstance(function, ast.FunctionDef)
                and {ast.unparse(one) for one in function.decorator_list} & uncounted
            ):
                seen += 1
                calls = [one.func for one in ast.walk(function) if isinstance(one, ast.Call)]
                attributes = {one.attr for one in calls if isinstance(one, ast.Attribute)}
                found += [f"{path.name}: {function.name}"] * bool(attributes & reducing)
    assert seen > 150
    assert not found
