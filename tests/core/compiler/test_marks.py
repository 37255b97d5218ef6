"""What is kept of the kinds of work that have been compiled."""

from pathlib import Path

import pytest

from gradhesion.core.compiler import cache, marks


def test_kinds_are_kept_one_by_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "place", lambda: cache.Place(tmp_path))
    monkeypatch.setattr(marks, "_here", set())
    marks.note_compiled("force")
    assert [marks.compiled_before(kind) for kind in ("force", "energy")] == [True, False]
    marks._here.clear()  # as in another process
    assert [marks.compiled_before(kind) for kind in ("force", "energy")] == [True, False]
    cache.machine.cache_clear()
    monkeypatch.setattr(cache.numba, "__version__", "0.0")
    assert not marks.compiled_before("force"), "another numba compiles anew"
    cache.machine.cache_clear()


def test_kinds_without_a_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "place", lambda: cache.Place(None))
    monkeypatch.setattr(marks, "_here", set())
    assert not marks.compiled_before("force")
    marks.note_compiled("force")
    assert marks.compiled_before("force")
