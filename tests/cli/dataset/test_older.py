"""Datasets as earlier versions wrote them (`tests/reference/older`) open, are drawn, verified and run again."""

import gzip
import shutil
from pathlib import Path

import numpy as np
import pytest

import gradhesion as gr
from gradhesion.core.problem.names import GIVEN_UP
from tests.cli.conftest import Call
from tests.conftest import ROOT

OLDER = sorted((ROOT / "tests" / "reference" / "older").glob("*.nc.gz"))


@pytest.fixture(params=OLDER, ids=lambda path: path.name.removesuffix(".nc.gz"))
def older(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    path = tmp_path / request.param.stem
    path.write_bytes(gzip.decompress(request.param.read_bytes()))
    return path


def test_it_opens_is_drawn_and_verified(gradhesion: Call, older: Path) -> None:
    with gr.open(older) as dataset:
        is_fit = "parameter" in dataset.dims
        assert dataset.attrs["source"] == f"gradhesion {older.stem[:3]}.0"
    gradhesion("info", older, code=0)
    picture = older.with_suffix(".png")
    gradhesion("plot", older, "-o", picture, code=0)
    assert picture.read_bytes().startswith(b"\x89PNG")
    gradhesion("verify", older, "--sample", "3", code=2 if is_fit else 0)  # it takes maps alone


def test_the_study_in_it_runs_again_to_the_same_values(gradhesion: Call, older: Path) -> None:
    study, again = older.with_suffix(".toml"), older.with_name("again.nc")
    shutil.copy(ROOT / "configs" / "force_curve.csv", older.parent)
    with gr.open(older) as dataset:
        before, text = dataset.load(), dataset.attrs["study"]
    gone = [name for name in GIVEN_UP if name in before]
    study.write_text(text, encoding="utf-8")
    if gone:  # they are named, with what to do instead
        said = gradhesion("run", study, "-o", again, code=2).stderr
        assert all(f'"{name}"' in said for name in gone)
        for name in gone:
            text = text.replace(f', "{name}"', "")
        study.write_text(text, encoding="utf-8")
    gradhesion("run", study, "-o", again, code=0)
    with gr.open(again) as dataset:
        now = dataset.load()
    if "parameter" in before.dims:  # version 0.2 measured distances in another way, by far less than the noise
        assert (abs(now["value"] - before["value"]) < 0.3 * before["standard_deviation"]).all()
    else:
        kept = [name for name in before.data_vars if str(name).removesuffix("_si") not in gone]
        assert {*kept} <= {*now.data_vars}
        for name in kept:
            np.testing.assert_allclose(now[name], before[name], rtol=1e-11, atol=0, err_msg=str(name))
