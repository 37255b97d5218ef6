"""Where compiled kernels are kept, whatever can be written; what is removed there, and what stays."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import platformdirs
import pytest

from gradhesion.core.compiler import cache

pytestmark = pytest.mark.slow

DAY = 86400.0
NOW = 2.0e9


@pytest.fixture
def homes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user's cache and a folder for temporary files."""
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr(platformdirs, "user_cache_dir", lambda name: str(tmp_path / "home" / name))
    monkeypatch.setattr(tempfile, "gettempdir", lambda: str(tmp_path / "temporary"))
    return tmp_path


def block(folder: Path) -> None:
    """Have a file stand where a folder would be made: it cannot be written, not even by root."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    folder.touch()


def test_usually_the_cache_of_the_user(homes: Path) -> None:
    assert cache.choose("") == cache.Place(homes / "home" / "gradhesion" / cache._NAME, "")


def test_the_folder_of_numba_comes_first(homes: Path) -> None:
    assert cache.choose(str(homes / "own")) == cache.Place(homes / "own" / cache._NAME, "")
    assert not (homes / "home").exists()


def test_a_folder_of_numba_that_cannot_be_written(homes: Path) -> None:
    block(homes / "own")
    chosen = cache.choose(str(homes / "own"))
    assert chosen.folder == homes / "home" / "gradhesion" / cache._NAME
    assert chosen.why == (
        f"NUMBA_CACHE_DIR = {homes / 'own'} cannot be written; compiled kernels are kept in {homes / 'home/gradhesion'}"
    )


def test_a_home_that_cannot_be_written(homes: Path) -> None:
    block(homes / "home")
    chosen = cache.choose("")
    (folder,) = (homes / "temporary").iterdir()
    assert folder.name.startswith("gradhesion-")
    assert folder.stat().st_mode & 0o777 == 0o700
    assert chosen.folder == folder / cache._NAME
    assert chosen.why == f"{homes / 'home/gradhesion'} cannot be written; compiled kernels are kept in {folder}"
    assert cache.choose("") == chosen, "the next process finds it again"


def test_a_temporary_folder_that_others_can_write_is_not_used(homes: Path) -> None:
    block(homes / "home")
    cache.choose("")
    (folder,) = (homes / "temporary").iterdir()
    folder.chmod(0o777)
    assert cache.choose("").folder is None


def test_nor_one_that_a_link_leads_to(homes: Path) -> None:
    block(homes / "home")
    (homes / "elsewhere").mkdir(mode=0o700)
    (homes / "temporary" / f"gradhesion-{os.getuid()}").symlink_to(homes / "elsewhere")
    assert cache.choose("").folder is None


def test_nor_one_of_somebody_else(homes: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    block(homes / "home")
    assert cache.choose("").folder is not None
    (folder,) = (homes / "temporary").iterdir()
    user = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: user + 1)
    folder.rename(folder.with_name(f"gradhesion-{user + 1}"))
    assert cache.choose("").folder is None


def test_without_any_folder(homes: Path) -> None:
    block(homes / "home")
    block(homes / "own")
    (homes / "temporary").rmdir()
    chosen = cache.choose(str(homes / "own"))
    assert chosen.folder is None
    assert chosen.why.startswith(
        f"NUMBA_CACHE_DIR = {homes / 'own'} cannot be written and {homes / 'home/gradhesion'} cannot be written,"
    )
    assert chosen.why.endswith("set NUMBA_CACHE_DIR to a folder that you can write and no other user can")


@pytest.mark.parametrize("given", [True, False])
def test_an_import_never_fails(given: bool, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    blocked = str(tmp_path / "file" / "below")
    names = ["XDG_CACHE_HOME", "HOME", *(["NUMBA_CACHE_DIR"] if given else []), "TMPDIR", "TMP", "TEMP"]
    environment = {**os.environ, **dict.fromkeys(names, blocked)}
    code = (
        "import tempfile, os; tempfile._candidate_tempdir_list = lambda: []\n"
        "from gradhesion.core.compiler.cache import place\nfrom gradhesion.core import solve\n"
        "from gradhesion.core.problem.material import theta\n"
        "print(place().folder, float(theta(0.0, 0.3).round(12)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, cwd="/", capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.stderr) == ("None 1.0\n", "")


def used(folder: Path, days: float) -> Path:
    """Make a folder of kernels that was last used so many days ago."""
    inside = folder / "core_0123"
    inside.mkdir(parents=True)
    names = [inside / name for name in ("scene.solve_curve-46.py311.nbi", "scene.solve_curve-46.py311.1.nbc")]
    names += [folder / "lock", folder / "compiled-force-00"]
    for path in names:
        path.touch()
    for path in (*names, inside, folder):
        os.utime(path, (NOW - days * DAY, NOW - days * DAY))
    return folder


def test_other_versions_are_removed_after_a_month(tmp_path: Path) -> None:
    here = used(tmp_path / "kernels-00000000000000ff", 90)
    old, young = used(tmp_path / "kernels-000000000000000a", 31), used(tmp_path / "kernels-000000000000000b", 29)
    cache.remove_unused(here, NOW)
    assert [here.exists(), old.exists(), young.exists()] == [True, False, True]


@pytest.mark.parametrize("what", [".", "lock", "core_0123/scene.solve_curve-46.py311.nbi"])
def test_not_if_anything_of_them_was_used(tmp_path: Path, what: str) -> None:
    other = used(tmp_path / "kernels-000000000000000a", 90)
    os.utime(other / what, (NOW - 3 * DAY, NOW - 3 * DAY))
    cache.remove_unused(tmp_path / "kernels-00000000000000ff", NOW)
    assert other.exists()


@pytest.mark.parametrize(("years", "kept"), [(0.0, [False, True]), (70.0, [False, True]), (-70.0, [True, True])])
def test_a_clock_that_is_set_removes_nothing_that_is_used(
    tmp_path: Path, years: float, kept: list[bool], monkeypatch: pytest.MonkeyPatch
) -> None:
    here = used(tmp_path / "kernels-00000000000000ff", 0)
    others = [used(tmp_path / f"kernels-000000000000000{i}", days) for i, days in ((1, 31), (2, 28))]
    monkeypatch.setattr(cache.time, "time", lambda: NOW + years * 365 * DAY)
    cache.remove_unused(here)
    assert [other.exists() for other in others] == kept


def test_what_is_not_ours_stays(tmp_path: Path) -> None:
    names = ["kernels-old", "kernels-000000000000000", "numba", "kernels-000000000000000A"]
    others = [used(tmp_path / name, 90) for name in names]
    away = used(tmp_path / "away" / "kernels-000000000000000a", 90)
    (tmp_path / "kernels-000000000000000b").symlink_to(away)
    mixed = used(tmp_path / "kernels-000000000000000c", 90)
    (mixed / "thesis.tex").touch()
    (mixed / "link").symlink_to(away)
    for path in (mixed / "thesis.tex", mixed):
        os.utime(path, (NOW - 90 * DAY, NOW - 90 * DAY))
    os.utime(mixed / "link", (NOW - 90 * DAY,) * 2, follow_symlinks=False)
    cache.remove_unused(tmp_path / "kernels-00000000000000ff", NOW)
    assert all((other / "lock").exists() for other in (*others, away))
    assert sorted(path.name for path in mixed.iterdir()) == ["link", "thesis.tex"]


def test_a_folder_that_does_not_exist(tmp_path: Path) -> None:
    cache.remove_unused(tmp_path / "nowhere" / "kernels-00000000000000ff", NOW)


@pytest.mark.skipif(
    shutil.which("unshare") is None
    or subprocess.run(
        ["unshare", "-m", "mount", "-t", "tmpfs", "none", "/mnt"], check=False, capture_output=True
    ).returncode,
    reason="no read-only file system can be mounted here",
)
def test_a_cache_that_is_read_only_beside_an_installation_that_is_not(tmp_path: Path) -> None:
    """Kernels go among the temporary files, as a sentence says, and nothing into the installation."""
    home, temporary = tmp_path / "home", tmp_path / "temporary"
    home.mkdir()
    temporary.mkdir()
    environment = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    environment |= {"XDG_CACHE_HOME": str(home), "TMPDIR": str(temporary)}
    code = (
        "from gradhesion.core.compiler.cache import place\nfrom gradhesion.core.problem.material import theta\n"
        "print(float(theta(0.0, 0.3).round(12)), place().why, sep='\\n')"
    )
    script = f'mount -t tmpfs -o ro none {home} && exec {sys.executable} -c "{code}"'
    before = {*cache.CORE.rglob("*.nb?")}
    done = subprocess.run(
        ["unshare", "-m", "bash", "-c", script], env=environment, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    value, why = done.stdout.splitlines()
    assert float(value) == 1.0
    assert why.startswith(f"{home / 'gradhesion'} cannot be written; compiled kernels are kept in {temporary}")
    assert list(temporary.rglob("*.nbi"))
    assert {*cache.CORE.rglob("*.nb?")} == before
