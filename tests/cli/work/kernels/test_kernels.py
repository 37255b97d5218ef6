"""One process compiles at a time; those that find all compiled do not wait for each other."""

import os
import pickle
import re
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from gradhesion.cli.locks import closing, try_lock
from gradhesion.cli.study import study_from
from gradhesion.cli.work.kernels import compiling, kernels
from gradhesion.core import KINDS, MANY_SMOOTH, NEEDS
from gradhesion.core.compiler.cache import Place
from gradhesion.core.compiler.probe import LAZY
from gradhesion.core.warmup import SCENE

MANY = {"start": 1.0, "stop": 100.0, "num": MANY_SMOOTH}
SMOOTH: dict[str, Any] = {"parameters": SCENE | {"A": [0.0, 0.1], "modulus": MANY}}
"""A study half of whose scenes are smooth."""
TWO = {"harmonics": [{"n": 1, "cos": 1.0}, {"n": 2, "cos": 0.1}]}


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """The kinds of work that are compiled, none at first."""
    kinds: list[str] = []
    monkeypatch.setattr("gradhesion.core.compile_kind", kinds.append)
    monkeypatch.setattr(kernels, "compiled_before", lambda kind: kind in kinds)
    for module in (kernels, compiling):
        monkeypatch.setattr(module, "place", lambda: Place(tmp_path))
    monkeypatch.setattr(kernels, "PAUSE", 0.01)
    monkeypatch.setattr("gradhesion.core.processors.processors", lambda: 1)
    return kinds


def test_the_second_waits_for_the_first(compiled: list[str], tmp_path: Path) -> None:
    handle = try_lock(tmp_path / "lock")
    assert handle is not None
    with closing(handle):
        thread = threading.Thread(target=kernels.compile_kinds, args=[["force"]])
        thread.start()
        time.sleep(0.1)
        assert compiled == []
    thread.join(60)
    assert compiled == ["tables", "force"]
    handle = try_lock(tmp_path / "lock")
    assert handle is not None
    with closing(handle):
        kernels.compile_kinds(["force"])
    assert compiled == ["tables", "force"], "all is compiled, and nobody waits"


def test_each_kind_comes_once_and_after_those_that_it_needs(compiled: list[str]) -> None:
    kernels.compile_kinds(KINDS[::-1])
    assert sorted(compiled) == sorted(KINDS)
    for place, kind in enumerate(compiled):
        assert {*NEEDS[kind]} <= {*compiled[:place]}


@pytest.mark.parametrize(
    ("changes", "kinds"),
    [
        ({"outputs": ["pull_off_force"]}, ("force",)),
        ({}, ("energy", "long")),
        ({"parameters": SCENE | {"a_max_over_R": [0.3, 0.5]}}, ("energy",)),
        ({"parameters": SCENE | {"a_max_over_R": [0.3, 50.0]}}, ("energy", "long")),
        ({"parameters": SCENE | {"a_max_over_R": 50.0}, "outputs": ["pull_off_force"]}, ("force",)),
        (
            {"parameters": SCENE | {"a_max_over_R": 50.0}, "outputs": ["dissipated_energy_sensitivity"]},
            ("energy", "sensitivities", "long", "long_sensitivities"),
        ),
        ({"outputs": ["pull_off_force"], "method": {"solver": ["exact", "envelope"]}}, ("force", "envelope")),
        ({"outputs": ["energy_residual"]}, ("reports", "long")),
        (SMOOTH, ("energy", "smooth")),
        (SMOOTH | {"outputs": ["energy_residual"]}, ("reports", "smooth")),
        (SMOOTH | {"method": {"solver": "envelope"}}, ("envelope",)),
        (SMOOTH | {"outputs": ["pull_off_force_sensitivity"]}, ("energy", "sensitivities")),
        ({"method": {"solver": "asymptotic"}, "profile": {"exponent": 1.5}}, ("asymptotic",)),
        (SMOOTH | {"loading": {"control": "load"}}, ("general_energy",)),
        ({"profile": {"exponent": 1.5}}, ("general_energy", "general_long")),
        ({"profile": {"exponent": 1.5}, "parameters": SCENE}, ("general_energy",)),
        ({"profile": TWO, "parameters": SCENE | {"a_max_over_R": 30.0}}, ("general_energy", "general_long")),
        ({"loading": {"control": "load"}, "outputs": ["pull_off_force"]}, ("general_force",)),
        ({"kind": "curve", "outputs": ["path"]}, ("curves",)),
    ],
)
def test_a_study_has_its_kinds(data: dict[str, Any], changes: dict[str, Any], kinds: tuple[str, ...]) -> None:
    assert kernels.kinds_of(study_from(data | changes)) == kinds


def test_without_a_place_for_the_lock(compiled: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setattr(kernels, "place", lambda: Place(tmp_path / "file" / "cache"))
    kernels.compile_kinds(["force"])
    monkeypatch.setattr(kernels, "place", lambda: Place(None))
    kernels.compile_kinds(["general_force"])
    assert compiled == ["tables", "force", "general_force"]


def test_it_says_what_is_compiled_and_when_it_is_done(compiled: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    compiling.prepare(["energy"])
    lines = capsys.readouterr().err.splitlines()
    assert re.search(r"about \d+ kernels, \d+ CPU seconds of one core, for tables, cycles and energies, once", lines[0])
    assert lines[1].startswith("compiled in ")
    compiling.prepare(["energy"])
    assert capsys.readouterr().err == ""
    compiling.prepare(["general_force"], quiet=True)
    (line,) = capsys.readouterr().err.splitlines()
    assert "the pull-off force of other profiles and controls" in line
    assert compiled == ["tables", "energy", "general_force"]


def test_where_nothing_can_be_kept_it_says_so(
    compiled: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compiling, "place", lambda: Place(None, "nothing can be written"))
    compiling.prepare(["force"])
    assert capsys.readouterr().err.splitlines()[0] == "nothing can be written"
    assert compiled == ["tables", "force"]


@pytest.mark.slow
@pytest.mark.parametrize(("count", "alone"), [(1, False), (2, False), (2, True)])
def test_where_a_processor_is_free_another_process_compiles_the_tables(count: int, alone: bool, tmp_path: Path) -> None:
    code = (
        "from gradhesion.cli.work.kernels import kernels\n"
        "from gradhesion.core import processors\n"
        f"processors.processors = lambda: {count}\n"
        f"kernels.compile_kinds(['force'], print, alone={alone})\n"
        "print(kernels.missing_of(['force', 'tables']))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)},
    )
    *names, missing = done.stdout.splitlines()
    assert missing == "[]"
    assert any("solvers" in name for name in names)
    if LAZY:
        assert any("_prepare" in name for name in names) == (count == 1 or alone)


@pytest.mark.slow
def test_processes_side_by_side_keep_each_kernel_once(tmp_path: Path) -> None:
    """No index of the cache forgets a file that another process wrote, and none has two for a kernel."""
    code = (
        "from gradhesion.cli.work.kernels.warming import warm\n"
        "if __name__ == '__main__':\n"
        "    warm(['envelope', 'edge'], 2, lambda kind, names: print(kind, len(names)), kept=True)\n"
    )
    script, cache = tmp_path / "warm.py", tmp_path / "cache"
    script.write_text(code)
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache)}
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True, env=environment)
    counts = {kind: int(count) for kind, count in map(str.split, done.stdout.splitlines())}
    assert counts.keys() == {"tables", "envelope", "edge"}
    assert min(counts.values()) > 0

    listed: list[Path] = []
    for index in cache.rglob("*.nbi"):
        with index.open("rb") as file:
            pickle.load(file)  # noqa: S301 (of our own: numba's version)
            _, files = pickle.load(file)  # noqa: S301
        listed += [index.with_name(name) for name in files.values()]
    assert sorted(listed) == sorted(cache.rglob("*.nbc"))
