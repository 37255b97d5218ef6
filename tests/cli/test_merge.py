"""Shards compute parts, and merge joins them to what a run in one go gives."""

import os
from collections.abc import Callable
from pathlib import Path

import netCDF4
import pytest
from click.testing import Result

from gradhesion.cli.work.folder import claimed, folder_of
from tests.faults.trials import values_of

pytestmark = pytest.mark.usefixtures("small_blocks")

Call = Callable[..., Result]


def test_shards_in_any_order_make_the_dataset(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    whole, output = tmp_path / "whole.nc", tmp_path / "data" / "out.nc"
    assert gradhesion("run", study_file, "-o", whole, "--quiet").exit_code == 0
    for shard, computed in (("4/4", 1), ("1/4", 2), ("3/4", 1)):
        result = gradhesion("run", study_file, "-o", output, "--shard", shard)
        assert result.exit_code == 0
        assert f"reused 0 blocks, computed {computed}; `gradhesion merge {output}`" in result.stderr
    early = gradhesion("merge", output)
    assert early.exit_code == 2
    assert f"{output}: 2 of 6 blocks are missing (2, 6)" in early.stderr
    assert gradhesion("run", study_file, "-o", output, "--shard", "2/4", "--quiet").exit_code == 0
    assert "reused 2 blocks, computed 0" in gradhesion("run", study_file, "-o", output, "--shard", "2/4").stderr
    assert "`gradhesion merge`" in gradhesion("status", output).stdout, "it tells what to do"
    assert not output.exists()
    result = gradhesion("merge", output)
    assert result.exit_code == 0
    assert "reused 6 blocks, computed 0" in result.stderr
    assert os.listdir(output.parent) == ["out.nc"]
    assert values_of(output) == values_of(whole)
    with netCDF4.Dataset(output) as one, netCDF4.Dataset(whole) as other:
        assert (one.study, one.title) == (other.study, other.title)


def test_run_computes_what_the_shards_have_left(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/2").exit_code == 0
    assert "reused 3 blocks, computed 3" in gradhesion("run", study_file, "-o", output).stderr


def test_a_damaged_part_is_not_merged(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/1").exit_code == 0
    part = folder_of(output) / "000004.npz"
    part.write_bytes(part.read_bytes()[:-8])
    result = gradhesion("merge", output)
    assert result.exit_code == 2
    assert f"{output}: block 5 of 6 blocks is damaged" in result.stderr
    assert not output.exists()
    assert gradhesion("run", study_file, "-o", output, "--shard", "5/6").exit_code == 0
    assert gradhesion("merge", output).exit_code == 0


@pytest.mark.slow
def test_shards_work_at_once_but_not_beside_a_run(gradhesion: Call, study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "out.nc"
    with claimed(output, "-1-of-2"):
        assert gradhesion("run", study_file, "-o", output, "--shard", "2/2").exit_code == 0
        for command in (["run", study_file, "-o", output], ["run", study_file, "-o", output, "--shard", "1/2"]):
            result = gradhesion(*command)
            assert result.exit_code == 4
            assert "another run is writing it" in result.stderr
        assert gradhesion("run", study_file, "-o", output, "--shard", "1/2", "--set=parameters.nu=0.3").exit_code == 4
    with claimed(output):
        assert gradhesion("run", study_file, "-o", output, "--shard", "2/2").exit_code == 4


def test_mistakes(gradhesion: Call, study_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    output = tmp_path / "out.nc"
    for shard in ("0/2", "3/2", "1", "a/b", "1/0"):
        result = gradhesion("run", study_file, "-o", output, "--shard", shard)
        assert result.exit_code == 2
        assert "--shard 3/8" in result.stderr
    assert gradhesion("run", study_file, "-o", output, "--shard", "1/2", "--fresh").exit_code == 2
    none = gradhesion("merge", output)
    assert none.exit_code == 2
    assert "has no blocks to join" in none.stderr
    monkeypatch.setenv("GRADHESION_CHUNK", "100")
    assert "run it without --shard" in gradhesion("run", study_file, "-o", output, "--shard", "1/2").stderr
    assert os.listdir(tmp_path) == ["study.toml"]
