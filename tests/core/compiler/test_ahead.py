"""Code that came with the program: used where it fits, and left alone where anything is another."""

import json
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import pytest

from gradhesion.core.compiler import ahead, cache, jit, keeping, marks
from gradhesion.core.compiler.probe import LAZY

pytestmark = pytest.mark.skipif(not LAZY, reason="numba links in its own way: code is never used")


def made() -> Any:
    """An entry, as a new process would make it."""

    @jit.kernel()
    def hyperbola(x: float) -> float:
        return math.sqrt(x * x + 1.0)

    return hyperbola


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of code for floating-point numbers, as it came with the program, and an empty cache."""
    for name in ("GRADHESION_KERNELS", *(f"NUMBA_{name}" for name in ahead.OTHERS)):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(cache, "place", lambda: cache.Place(tmp_path / "cache"))
    monkeypatch.setattr(ahead, "FEATURES", ())  # the test compiles for the processor at hand
    first = made()
    assert first(0.7) == math.sqrt(1.49)
    ahead.write(tmp_path / "compiled", keeping.code_of(first._entry), ["tables"])
    for kept in (tmp_path / "cache").rglob("*.nb?"):
        kept.unlink()
    monkeypatch.setattr(ahead, "_found", lambda: ahead.fitting(tmp_path / "compiled"))
    return tmp_path / "compiled"


def times_compiled(*arguments: float) -> int:
    """How many times a new entry is compiled for arguments; its values are right anyway."""
    entry = made()
    for x in arguments:
        assert entry(x) == math.sqrt(x * x + 1.0)
    return sum(entry.stats.cache_misses.values())


def test_code_that_fits_is_used_and_nothing_is_written(folder: Path, tmp_path: Path) -> None:
    before = sorted(tmp_path.rglob("*"))
    assert times_compiled(0.7) == 0
    assert ahead.why_not() == ""
    assert sorted(tmp_path.rglob("*")) == before
    assert folder in before


@pytest.mark.usefixtures("folder")
def test_what_is_missing_is_compiled() -> None:
    assert times_compiled(0.7, 3) == 1


@pytest.mark.usefixtures("folder")
def test_kinds_that_are_complete_are_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(marks, "_here", set())
    assert [marks.compiled_before(kind) for kind in ("tables", "force")] == [True, False]
    assert [ahead.is_complete(kind) for kind in ("tables", "force")] == [True, False]


def other_needs(key: str) -> Callable[[dict[str, Any]], None]:
    def change(manifest: dict[str, Any]) -> None:
        assert manifest["needs"][key]
        manifest["needs"][key] += "0"

    return change


CHANGES: dict[str, tuple[Callable[[dict[str, Any]], Any], str]] = {
    "sources": (other_needs("sources"), "they are for other sources"),
    "python": (other_needs("python"), f"they are for python {sys.implementation.cache_tag}0, not "),
    "platform": (other_needs("platform"), "they are for platform "),
    "numba": (other_needs("numba"), f"they are for numba {numba.__version__}0, not {numba.__version__}"),
    "llvmlite": (other_needs("llvmlite"), "they are for llvmlite "),
    "numpy": (other_needs("numpy"), "they are for numpy 20, not 2"),
    "processor": (
        lambda manifest: manifest["features"].extend(["wings", "fins"]),
        "they are for processors that have wings, fins",
    ),
    "nothing": (lambda manifest: manifest.clear(), "manifest.json cannot be read"),
    "one need less": (lambda manifest: manifest["needs"].pop("numba"), "manifest.json cannot be read"),
    "kinds": (lambda manifest: manifest.update(kinds=3), "manifest.json cannot be read"),
    "kernels": (lambda manifest: manifest.update(kernels=["one", "two"]), "manifest.json cannot be read"),
}


@pytest.mark.parametrize("what", CHANGES)
def test_code_for_others_is_not_used(folder: Path, what: str) -> None:
    path = folder / ahead.MANIFEST
    manifest = json.loads(path.read_text())
    change, why = CHANGES[what]
    change(manifest)
    path.write_text(json.dumps(manifest))
    assert times_compiled(0.7) == 1
    assert ahead.why_not().startswith("the compiled kernels that came with the program are not used: ")
    assert why in ahead.why_not()


@pytest.mark.parametrize("text", ["", "[]", "null", "{", "\udc80"])
def test_a_manifest_that_is_none(folder: Path, text: str) -> None:
    (folder / ahead.MANIFEST).write_bytes(text.encode("utf-8", "surrogateescape"))
    assert ahead.shipped() is None
    assert ahead.why_not().endswith(f"{folder / ahead.MANIFEST} cannot be read")
    assert times_compiled(0.7) == 1


@pytest.mark.parametrize("name", ["GRADHESION_KERNELS", "NUMBA_CPU_NAME", "NUMBA_OPT"])
def test_the_environment_can_ask_for_own_code(folder: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert ahead.fitting(folder)[0] is not None
    monkeypatch.setenv(name, {"GRADHESION_KERNELS": "own", "NUMBA_CPU_NAME": "generic"}.get(name, "3"))
    assert ahead.fitting(folder) == (None, "")


@pytest.mark.parametrize(
    "spoil", [lambda data: data[:-1], lambda data: data[:0], lambda data: data.replace(b"hyp", b"cub")]
)
def test_a_file_that_is_not_what_was_written_is_compiled_instead(folder: Path, spoil: Callable[[bytes], bytes]) -> None:
    (code,) = folder.glob("*.code")
    code.write_bytes(spoil(code.read_bytes()))
    assert times_compiled(0.7) == 1


def test_so_is_one_that_has_gone(folder: Path) -> None:
    (code,) = folder.glob("*.code")
    code.unlink()
    assert times_compiled(0.7) == 1


def test_names_of_files_tell_kernels_types_and_constants_apart() -> None:
    def of(constant: int) -> Callable[[float], float]:
        def function(x: float) -> float:
            return constant * x

        return function

    names = {ahead.name_of(of(constant), types) for constant in (1, 2) for types in ("(float64,)", "(int64,)")}
    assert len(names) == 4
    assert ahead.name_of(of(1), "(int64,)") in names


def test_a_source_tree_has_no_code() -> None:
    assert not ahead.FOLDER.exists()
    assert ahead.fitting(ahead.FOLDER) == (None, "")
