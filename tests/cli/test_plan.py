"""`gradhesion plan` tells what a run then does, and writes nothing."""

import json
import os
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result

from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.tiling import Tiling, size_of
from gradhesion.cli.work import probe
from gradhesion.cli.work.estimate import FILE, estimate
from gradhesion.cli.work.parts.folder import folder_of

Call = Callable[..., Result]


@pytest.fixture(autouse=True)
def _small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut the small study of 24 scenes into 6 blocks."""
    monkeypatch.setenv("GRADHESION_CHUNK", "2")


def planned(gradhesion: Call, *arguments: str | Path) -> dict[str, Any]:
    """Read a plan."""
    result = gradhesion("plan", *arguments, "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    plan: dict[str, Any] = json.loads(result.stdout)
    return plan


@pytest.mark.parametrize("shape", [(5, 131), (2, 3, 2, 2), (7,), ()])
def test_a_block_by_its_number(shape: tuple[int, ...]) -> None:
    tiling = Tiling(shape, 2)
    assert [tiling[number] for number in range(len(tiling))] == list(tiling)


def test_nothing_is_written(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    plan = planned(gradhesion, study_file, "-o", tmp_path / "new" / "out.nc")
    assert os.listdir(tmp_path) == ["study.toml"]
    assert (plan["scenes"], plan["blocks"], plan["blocks_reused"]) == (24, 6, 0)
    assert plan["not_reused"] == {"not computed yet": 6}
    assert plan["bytes_of_parts"] == 24 * (8 + 8 + 4 + 1 + 1)
    assert plan["seconds"] > 0
    assert plan["bytes_free"] > 0
    assert plan["seconds_dask"] > plan["seconds"]
    assert 0 < 6 * plan["seconds_of_block"] < 2 * plan["seconds"] * (os.cpu_count() or 1)
    assert not plan["output_exists"]


def test_what_is_reused_and_why_not_the_rest(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/2").exit_code == 0
    folder = folder_of(output)
    folder.part(0).write_bytes(b"damaged")
    folder.part(5).write_bytes(folder.part(4).read_bytes())
    before = sorted((path.name, path.stat().st_mtime_ns) for path in folder.path.iterdir())
    plan = planned(gradhesion, study_file, "-o", output)
    assert plan["blocks_reused"] == 2
    assert plan["not_reused"] == {"damaged": 1, "of other scenes or another version": 1, "not computed yet": 2}
    assert plan["bytes_of_parts"] == 16 * 22
    told = gradhesion("plan", study_file, "-o", output).stdout
    assert "blocks    6; 2 reused; 1 damaged; 1 of other scenes or another version; 2 not computed yet" in told
    assert sorted((path.name, path.stat().st_mtime_ns) for path in folder.path.iterdir()) == before
    assert "reused 2 blocks, computed 4" in gradhesion("run", study_file, "-o", output).stderr
    assert planned(gradhesion, study_file, "-o", output)["output_exists"]


def test_that_another_study_would_be_refused(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/2").exit_code == 0
    plan = planned(gradhesion, study_file, "-o", output, "--set=parameters.nu=0.3")
    assert plan["differences"] == ["parameters.nu is 0.27 there and 0.3 here"]
    assert plan["not_reused"] == {"of another study": 3, "not computed yet": 3}
    told = gradhesion("plan", study_file, "-o", output, "--set=parameters.nu=0.3").stdout
    assert "run would refuse: parameters.nu is 0.27 there and 0.3 here" in told


def test_dry_run_is_the_plan(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    result = gradhesion("run", study_file, "-o", tmp_path / "out.nc", "--dry-run")
    assert result.exit_code == 0
    assert "blocks    6; 0 reused; 6 not computed yet\n" in result.stdout
    assert "time      about " in result.stdout
    assert re.search(
        r"engines   with --engine dask about .* on N workers elsewhere .* / N, .* per block\n", result.stdout
    )
    assert os.listdir(tmp_path) == ["study.toml"]


def test_a_curve_study_has_no_probe(gradhesion: Call, root: Path, tmp_path: Path) -> None:
    plan = planned(gradhesion, root / "configs" / "curve.toml", "-o", tmp_path / "out.nc")
    assert (plan["kind"], plan["seconds"], plan["bytes_of_parts"]) == ("curve", None, 0)
    assert "no parts, no estimate of time" in gradhesion("plan", root / "configs" / "curve.toml").stdout


def test_the_time_is_that_of_the_scenes(data: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """On a clock that knows the cost of each scene, the estimate is the mean cost, within its uncertainty."""
    data["parameters"]["A"] = {"start": 0.0, "stop": 0.5, "num": 600}
    study = study_from(data)
    clock = 0.0

    def cost_of(block: tuple[slice, ...]) -> float:
        waves = np.arange(block[2].start, block[2].stop)
        return float(np.sum(1e-6 * (1 + waves))) * size_of(block) / waves.size

    def solve_block(_study: object, block: tuple[slice, ...], _threads: int) -> dict[str, Any]:
        nonlocal clock
        clock += cost_of(block)
        return {"status": np.zeros(size_of(block), np.int8)}

    monkeypatch.setattr(probe, "solve_block", solve_block)
    monkeypatch.setattr(probe, "clock", lambda: clock)
    monkeypatch.setattr(probe.time, "monotonic", lambda: clock)
    count = len(study.tiling)
    found = probe.probe(study, range(count))
    assert found is not None
    exact = sum(map(cost_of, study.tiling)) / study.scenes
    assert abs(found.solving - exact) < found.uncertainty < 0.5 * exact


def test_tables_of_exponents_are_in_the_estimate(data: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """On a clock that knows what a table costs, and that it is made once, the estimate has all of them."""
    data["parameters"] |= {"k": {"start": 0.0, "stop": 0.9, "num": 400}, "A": {"start": 0.0, "stop": 0.5, "num": 6000}}
    study = study_from(data)
    clock = 0.0
    made: set[float] = set()

    def solve_block(_study: object, block: tuple[slice, ...], _threads: int) -> dict[str, Any]:
        nonlocal clock
        exponents = {*study.parameters_of(block)["k"].ravel().tolist()}
        clock += 1e-6 * size_of(block) + 3e-4 * len(exponents - made)
        made.update(exponents)
        return {"status": np.zeros(size_of(block), np.int8)}

    monkeypatch.setattr(probe, "solve_block", solve_block)
    monkeypatch.setattr(probe, "clock", lambda: clock)
    found = probe.probe(study, range(len(study.tiling)))
    assert found is not None
    assert 8 < len(made) < 40, "most of them are not made for it"
    assert abs(found.tables - 400 * 3e-4) < 1e-9
    assert abs(found.solving - 1e-6) < 1e-9


@pytest.mark.parametrize("parts", [True, False])
def test_the_parts_of_several_blocks_are_in_the_estimate(
    parts: bool, data: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On a clock that knows nothing but what the digest of a byte costs; a map of one block has no part."""
    data["parameters"]["A"] = {"start": 0.0, "stop": 0.5, "num": 600}
    study = study_from(data).chunked(1000 if parts else 131_072)
    clock = 0.0

    def digest_of(pieces: Iterable[memoryview]) -> str:
        nonlocal clock
        clock += sum(1e-9 * piece.nbytes for piece in pieces)
        return ""

    monkeypatch.setattr(probe, "digest_of", digest_of)
    monkeypatch.setattr(probe, "clock", lambda: clock)
    found = estimate(study, tmp_path / "out.nc", 2)
    assert found.seconds is not None
    bytes_of_parts = study.scenes * (8 + 8 + 4 + 1 + 1) if parts else 0
    assert found.bytes_of_parts == bytes_of_parts
    assert abs(found.seconds - FILE - 1e-9 * bytes_of_parts) < 1e-12


def test_every_scene_is_as_likely_in_a_piece() -> None:
    block, counts = (slice(5, 10), slice(0, 12)), np.zeros((10, 12), int)
    for place in np.arange(0.0, 1.0, 1 / 240):
        counts[probe._piece(block, 4, float(place))] += 1
    assert np.all(counts[:5] == 0)
    assert np.all(counts[5:] == 240 // 15)


def test_values_compress_as_in_the_file(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    wide = ["--set=parameters.A={start=0, stop=0.4, num=6000}", '--set=outputs=["pull_off_force"]']
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("GRADHESION_CHUNK", "131072")
        expected = planned(gradhesion, study_file, "-o", tmp_path / "out.nc", *wide)["bytes_of_file"]
        assert gradhesion("run", study_file, "-o", tmp_path / "out.nc", *wide).exit_code == 0
    assert abs((tmp_path / "out.nc").stat().st_size / expected - 1) < 0.4


def test_nothing_is_left_to_do(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/1").exit_code == 0
    plan = planned(gradhesion, study_file, "-o", output)
    assert (plan["blocks_reused"], plan["not_reused"], plan["seconds"]) == (6, {}, None)
    assert "every block is complete" in gradhesion("plan", study_file, "-o", output).stdout
