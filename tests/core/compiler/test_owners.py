"""Compiled code that somebody else could have put there, or changed, is not read: by which folder, and by which route."""

import os
import shutil
import stat
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path

import pytest

from gradhesion.core.compiler import owners
from gradhesion.core.compiler.owners import changeable, make_private

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has other rights")
as_root = pytest.mark.skipif(
    sys.platform != "win32" and os.getuid() != 0, reason="files of another user are made by root alone"
)
OTHER = 12345
"""Another user."""


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


def test_what_is_ours_in_a_folder_for_all(kept: Path) -> None:
    assert changeable(kept) == ""


def test_what_is_made_is_for_this_user_alone(shared: Path) -> None:
    before = os.umask(0)
    try:
        make_private(shared / "above" / "kernels")
    finally:
        os.umask(before)
    assert [stat.S_IMODE((shared / name).stat().st_mode) for name in ("above", "above/kernels")] == [0o700, 0o700]
    assert changeable(shared / "above" / "kernels") == ""
    make_private(shared / "above" / "kernels")  # there already


@pytest.mark.parametrize("name", [".", "core", "core/one.nbi", "core/one.nbc"])
@pytest.mark.parametrize("mode", [0o775, 0o757])
def test_what_others_can_write(kept: Path, name: str, mode: int) -> None:
    (kept / name).chmod(mode)
    assert changeable(kept) == f"{kept / name} can be written by other users"
    kept.chmod(0o700)
    assert changeable(kept) == "", "they cannot enter"


@pytest.mark.parametrize(
    ("mode", "safe"), [(0o777, False), (0o775, False), (0o1777, True), (0o755, True), (0o700, True)]
)
def test_a_folder_above_in_which_others_can_rename(shared: Path, kept: Path, mode: int, safe: bool) -> None:
    shared.chmod(mode)
    assert changeable(kept) == ("" if safe else f"{shared} can be written by other users")


@as_root
@pytest.mark.parametrize("name", ["..", ".", "core", "core/one.nbi", "core/one.nbc"])
def test_what_belongs_to_another_user(shared: Path, kept: Path, name: str) -> None:
    os.chown(kept / name, OTHER, OTHER)
    path = shared if name == ".." else kept / name
    assert changeable(kept) == f"{path} belongs to another user"
    if name != ".":
        kept.chmod(0o700)  # nor does it help to close it afterwards
        assert changeable(kept) == f"{path} belongs to another user"


def test_links(shared: Path, kept: Path) -> None:
    (shared / "link").symlink_to(kept)
    assert changeable(shared / "link") == f"{shared / 'link'} is a link"
    (kept / "core" / "two.nbi").symlink_to(kept / "core" / "one.nbi")
    assert changeable(kept) == f"{kept / 'core/two.nbi'} is a link"


def test_what_another_process_removes_meanwhile_is_no_reason(kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(owners.os, "walk", lambda folder: [(str(folder), [], ["one.nbi.tmp.0123"])])
    assert changeable(kept) == ""


def test_a_system_without_user_ids(kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept.chmod(0o777)
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.delattr(os, "getuid")
    assert changeable(kept) == ""


SOLVE = """
from gradhesion.core.compiler.cache import place
from gradhesion.core.problem.material import theta
print(float(theta(0.0, 0.3).round(12)), place().folder, place().why, sep="\\n")
"""
BELOW = {"NUMBA_CACHE_DIR": ".", "XDG_CACHE_HOME": "gradhesion", "TMPDIR": f"gradhesion-{os.getuid()}"}
"""Where kernels are kept in a folder that the environment names."""


def solved(route: str, folder: Path, how: str) -> list[str]:
    """Solve in a process of its own, with a cache in a folder; its value, and where it keeps kernels, and why there."""
    environment = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    environment |= {"XDG_CACHE_HOME": str(folder / "home"), "GRADHESION_LINKING": how, "GRADHESION_KERNELS": "own"}
    if route == "TMPDIR":  # where nothing else can be written: a file is in the way
        environment["XDG_CACHE_HOME"] = __file__
    environment[route] = str(folder)
    done = subprocess.run([sys.executable, "-c", SOLVE], env=environment, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


@pytest.fixture(scope="module")
def indices() -> Callable[[str], list[Path]]:
    """The names of the indices, which are pickles, from the folder of a cache on."""

    @lru_cache
    def of(how: str) -> list[Path]:
        with tempfile.TemporaryDirectory() as folder:
            solved("NUMBA_CACHE_DIR", Path(folder), how)
            return [path.relative_to(folder) for path in Path(folder).rglob("*.nbi")]

    return of


def plant(folder: Path, names: list[Path]) -> Path:
    """Have indices run a command when they are read; return the folder of the kernels."""
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(f"cposix\nsystem\n(S'touch {folder / 'run'}'\ntR.")
    return folder / names[0].parts[0]


@as_root
@pytest.mark.slow
@pytest.mark.parametrize(
    ("route", "how", "what"),
    [
        ("NUMBA_CACHE_DIR", "", "the folder"),
        ("NUMBA_CACHE_DIR", "ordinary", "the folder"),
        ("NUMBA_CACHE_DIR", "", "the files"),
        ("XDG_CACHE_HOME", "", "the folder above"),
        ("TMPDIR", "", "the files"),
        ("TMPDIR", "", "the folder above"),
    ],
)
def test_a_pickle_of_another_user_is_not_run(
    shared: Path, indices: Callable[[str], list[Path]], route: str, how: str, what: str
) -> None:
    above = shared / BELOW[route]
    folder = plant(above, indices(how))
    files = [path for path in folder.rglob("*") if path.is_file()]
    theirs = {"the files": files, "the folder": [folder, *files], "the folder above": [above, folder, *files]}[what]
    for path in theirs:
        os.chown(path, OTHER, OTHER)
    if route == "TMPDIR" and what == "the files":
        above.chmod(0o700)
    value, elsewhere, why = solved(route, shared, how)
    assert not (above / "run").exists()
    assert value == "1.0"
    assert elsewhere != str(folder)
    if route == "TMPDIR":
        assert why.endswith("set NUMBA_CACHE_DIR to a folder that you can write and no other user can")
    else:
        assert f"is not used, since {files[0] if what == 'the files' else theirs[0]} belongs to another user" in why


@pytest.mark.slow
def test_a_pickle_of_ours_is_read(shared: Path, indices: Callable[[str], list[Path]]) -> None:
    """The test above would pass as well if nothing were ever read."""
    plant(shared, indices(""))
    solved("NUMBA_CACHE_DIR", shared, "")
    assert (shared / "run").exists()
