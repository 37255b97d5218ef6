"""`gradhesion plan` says what a run would do and cost, and writes nothing."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result

from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.tiling import size_of
from gradhesion.cli.work import estimate
from gradhesion.cli.work.folder import folder_of

pytestmark = pytest.mark.usefixtures("small_blocks")

Call = Callable[..., Result]


def planned(gradhesion: Call, *arguments: str | Path) -> dict[str, Any]:
    """Read a plan."""
    result = gradhesion("plan", *arguments, "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    plan: dict[str, Any] = json.loads(result.stdout)
    return plan


def test_nothing_is_written_and_what_is_kept_is_told(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "new" / "out.nc"
    plan = planned(gradhesion, study_file, "-o", output)
    assert os.listdir(tmp_path) == ["study.toml"]
    assert (plan["scenes"], plan["blocks"], plan["blocks_kept"], plan["refusal"]) == (24, 6, 0, "")
    assert (plan["bytes_of_values"], plan["output_exists"]) == (24 * 3 * 8, False)
    assert min(plan["seconds"], plan["bytes_free"]) > 0
    assert 0 < 6 * plan["seconds_of_block"] < 2 * plan["seconds"] * (os.cpu_count() or 1)
    for shard, kept in (("1/2", 3), ("2/2", 6)):
        assert gradhesion("run", study_file, "-o", output, "--shard", shard).exit_code == 0
        before = sorted((path.name, path.stat().st_mtime_ns) for path in folder_of(output).iterdir())
        plan = planned(gradhesion, study_file, "-o", output)
        assert (plan["blocks_kept"], plan["seconds"] is None) == (kept, kept == 6)
        other = planned(gradhesion, study_file, "-o", output, "--set=parameters.nu=0.3")
        assert (other["blocks_kept"], "--fresh" in other["refusal"]) == (0, True)
        assert sorted((path.name, path.stat().st_mtime_ns) for path in folder_of(output).iterdir()) == before
    assert gradhesion("plan", study_file, "-o", output).exit_code == 0


def test_curves_and_fits_have_no_estimate(gradhesion: Call, root: Path, tmp_path: Path) -> None:
    plan = planned(gradhesion, root / "configs" / "curve.toml", "-o", tmp_path / "out.nc")
    assert (plan["kind"], plan["blocks"], plan["seconds"]) == ("curve", 0, None)
    assert gradhesion("plan", root / "configs" / "curve.toml").exit_code == 0


def test_the_time_is_that_of_the_scenes(data: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
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
    scenes, seconds = estimate.timed_scenes(study, list(range(len(study.tiling))))
    exact = sum(map(cost_of, study.tiling)) / study.scenes
    assert scenes >= estimate.PIECES
    assert seconds / scenes == pytest.approx(exact, rel=0.2)
