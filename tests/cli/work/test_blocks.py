"""Work in blocks: what `plan` and `status` tell before, during and after a run; shards, which `merge` joins."""

import json
import os
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import pytest

from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.tiling import size_of
from gradhesion.cli.work import estimate
from gradhesion.cli.work.folder import claimed, folder_of
from gradhesion.cli.work.solve.scenes import solve as real_solve
from tests.cli.conftest import Call, Patch
from tests.faults.trials import values_of

pytestmark = pytest.mark.usefixtures("small_blocks")


def planned(gradhesion: Call, *arguments: str | Path) -> dict[str, Any]:
    result = gradhesion("plan", *arguments, "--json", code=0)
    assert result.stderr == ""
    plan: dict[str, Any] = json.loads(result.stdout)
    return plan


def dated(output: Path) -> list[tuple[str, int]]:
    """What a run keeps, with its dates; locks are dated by those who only look, too, in some versions of filelock."""
    kept = (path for path in folder_of(output).iterdir() if not path.name.startswith("lock"))
    return sorted((path.name, path.stat().st_mtime_ns) for path in kept)


def test_a_plan_writes_nothing_and_tells_what_is_kept(
    run: Call, gradhesion: Call, study_file: Path, root: Path, tmp_path: Path, output: Path
) -> None:
    plan = planned(gradhesion, study_file, "-o", output)
    assert os.listdir(tmp_path) == ["study.toml"]
    assert (plan["scenes"], plan["blocks"], plan["blocks_kept"], plan["refusal"]) == (24, 6, 0, "")
    assert (plan["bytes_of_values"], plan["output_exists"]) == (24 * 3 * 8, False)
    assert min(plan["seconds"], plan["bytes_free"]) > 0
    assert 0 < 6 * plan["seconds_of_block"] < 2 * plan["seconds"] * (os.cpu_count() or 1)
    for shard, kept in (("1/2", 3), ("2/2", 6)):
        assert run("--shard", shard).exit_code == 0
        before = dated(output)
        plan = planned(gradhesion, study_file, "-o", output)
        assert (plan["blocks_kept"], plan["seconds"] is None) == (kept, kept == 6)
        other = planned(gradhesion, study_file, "-o", output, "--set=parameters.nu=0.3")
        assert (other["blocks_kept"], "--fresh" in other["refusal"]) == (0, True)
        assert dated(output) == before
    assert gradhesion("plan", study_file, "-o", output).exit_code == 0
    curve = root / "configs" / "curve.toml"  # which has no estimate
    plan = planned(gradhesion, curve, "-o", tmp_path / "out.nc")
    assert (plan["kind"], plan["blocks"], plan["seconds"]) == ("curve", 0, None)
    assert gradhesion("plan", curve).exit_code == 0


def test_the_time_is_that_of_the_scenes(data: dict[str, Any], monkeypatch: Patch) -> None:
    """On a clock that knows the cost of each scene, the estimate is near the mean cost."""
    data["parameters"]["A"] = {"start": 0.0, "stop": 0.5, "num": 600}
    study = study_from(data)
    clock = 0.0

    def cost_of(block: tuple[slice, ...]) -> float:
        waves = np.arange(block[2].start, block[2].stop)
        return float(np.sum(1e-6 * (1 + waves))) * size_of(block) / waves.size

    def solve_block(_study: object, block: tuple[slice, ...], _threads: int) -> None:
        nonlocal clock
        clock += cost_of(block)

    monkeypatch.setattr(estimate, "solve_block", solve_block)
    monkeypatch.setattr(estimate.time, "perf_counter", lambda: clock)
    scenes, seconds = estimate.timed_scenes(study)
    exact = sum(map(cost_of, study.tiling)) / study.scenes
    assert scenes >= estimate.PIECES
    assert seconds / scenes == pytest.approx(exact, rel=0.2)


def test_running_stopped_and_complete(run: Call, gradhesion: Call, monkeypatch: Patch, output: Path) -> None:
    seen: list[dict[str, Any]] = []
    calls = 0

    def status() -> dict[str, Any]:
        assert str(output) in gradhesion("status", output).stdout
        found: dict[str, Any] = json.loads(gradhesion("status", output, "--json").stdout)
        return found

    def spying(*arguments: Any, **options: Any) -> dict[str, Any]:
        nonlocal calls
        calls += 1
        if calls == 5:
            for path in folder_of(output).glob("*.npz"):
                os.utime(path, (date := (folder_of(output) / "study.json").stat().st_mtime + 100.0, date))
            seen.append(status())
            raise KeyboardInterrupt
        return real_solve(*arguments, **options)

    with monkeypatch.context() as patch:
        patch.setattr("gradhesion.cli.work.solve.scenes.solve", spying)
        assert run().exit_code == 130
    (running,) = seen
    assert running.items() >= {"state": "running", "blocks": 6, "scenes": 24}.items()
    assert running["kept"] in {3, 4}
    assert running["seconds_left"] == pytest.approx(100.0 / running["kept"] * (6 - running["kept"]))
    assert status().items() >= {"state": "stopped", "seconds_left": None}.items()
    assert run("--quiet").exit_code == 0
    assert status()["state"] == "complete"
    for content in (output.read_bytes()[:-1000], b"", b"title = 1"):
        output.write_bytes(content)
        assert gradhesion("status", output).exit_code == 2
    output.unlink()
    assert gradhesion("status", output).exit_code == 2


@pytest.mark.parametrize("content", ["{", "[]", "null", "{}"])
def test_a_damaged_mark_is_no_error(run: Call, content: str, gradhesion: Call, output: Path) -> None:
    """Nor a part or a state, as version 0.3 kept them."""
    assert run("--shard", "1/2").exit_code == 0
    for name in ("study.json", "state.json", "000000.part"):
        (folder_of(output) / name).write_text(content)
    assert gradhesion("status", output).exit_code == 2
    assert "--fresh" in run(code=4).stderr, "nobody knows whose blocks these are"
    assert (folder_of(output) / "000000.part").exists()
    assert run("--fresh").exit_code == 0
    assert os.listdir(output.parent) == ["out.nc"]


def test_shards_in_any_order_make_the_dataset(run: Call, gradhesion: Call, tmp_path: Path, output: Path) -> None:
    """But for a damaged one."""
    whole = tmp_path / "whole.nc"
    run("-o", whole, "--quiet", code=0)
    for shard, computed in (("4/4", 1), ("1/4", 2), ("3/4", 1)):
        result = run("--shard", shard, code=0)
        assert f"reused 0 blocks, computed {computed}; `gradhesion merge {output}`" in result.stderr
    assert f"{output}: 2 of 6 blocks are missing or damaged (2, 6)" in gradhesion("merge", output, code=2).stderr
    assert run("--shard", "2/4", "--quiet").exit_code == 0
    assert "reused 2 blocks, computed 0" in run("--shard", "2/4").stderr
    assert "`gradhesion merge`" in gradhesion("status", output).stdout, "it tells what to do"
    part = folder_of(output) / "000004.npz"
    part.write_bytes(part.read_bytes()[:-8])
    assert f"{output}: 1 of 6 blocks are missing or damaged (5)" in gradhesion("merge", output, code=2).stderr
    assert not output.exists()
    assert run("--shard", "5/6").exit_code == 0
    assert "reused 6 blocks, computed 0" in gradhesion("merge", output, code=0).stderr
    assert os.listdir(output.parent) == ["out.nc"]
    assert values_of(output) == values_of(whole)
    with netCDF4.Dataset(output) as one, netCDF4.Dataset(whole) as other:
        assert (one.study, one.title) == (other.study, other.title)
    assert run("--shard", "1/2", "--overwrite").exit_code == 0
    assert "reused 3 blocks, computed 3" in run("--overwrite").stderr


@pytest.mark.slow
def test_shards_work_at_once_but_not_beside_a_run(run: Call, output: Path) -> None:
    output.parent.mkdir()
    with claimed(output, "-1-of-2"):
        assert run("--shard", "2/2").exit_code == 0
        for shard in ([], ["--shard", "1/2"]):
            assert "another run is writing it" in run(*shard, code=4).stderr
        assert run("--shard", "1/2", "--set=parameters.nu=0.3").exit_code == 4
    with claimed(output):
        assert run("--shard", "2/2").exit_code == 4


def test_wrong_shards_are_told(run: Call, gradhesion: Call, tmp_path: Path, monkeypatch: Patch, output: Path) -> None:
    for shard in ("0/2", "3/2", "1", "a/b", "1/0"):
        assert "--shard 3/8" in run("--shard", shard, code=2).stderr
    assert run("--shard", "1/2", "--fresh").exit_code == 2
    assert "has no blocks to join" in gradhesion("merge", output, code=2).stderr
    monkeypatch.setenv("GRADHESION_CHUNK", "100")
    assert "run it without --shard" in run("--shard", "1/2").stderr
    assert os.listdir(tmp_path) == ["study.toml"]
