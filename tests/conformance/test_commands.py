"""The same values by `gradhesion.solve` and by the commands, in blocks and by any number of threads."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.core import PARAMETERS

from .kinds import BY_NAME, COUNTS, Kind, drawn, rng_of, some
from .promises import agree

OVER_CLI = ("cosine", "sines, machine", "cosine, two works", "exponent 4, series, turned at a load")
EVERY = pytest.mark.parametrize("name", OVER_CLI)
NAMES = ("pull_off_force", "pull_off_radius", "dissipated_energy", "loading_jumps", "delta_max", "turning_radius")


def of_points(kind: Kind, scenes: Any) -> dict[str, Any]:
    """Scenes as arrays over one named dimension."""
    return {name: xarray.DataArray(values, dims="scene") for name, values in scenes.items()}


@EVERY
def test_from_python(name: str) -> None:
    kind = BY_NAME[name]
    scenes, found = drawn(kind)
    own = some(scenes, slice(50))
    profile = kind.how["profile"]
    dataset = gr.solve(of_points(kind, own), NAMES, profile=profile, control=kind.control, threads=1)
    values = {output: dataset[output].to_numpy() for output in (*NAMES, "status")}
    agree(kind, own, {n: v[:50] for n, v in found.items()} | values, some(found, slice(50)), NAMES)


def study(kind: Kind, folder: Path, scenes: Any) -> Path:
    """Write a study of points: a table beside it, one row a scene."""
    table = folder / "scenes.csv"
    rows = np.array([scenes[name] for name in scenes]).T
    lines = [",".join(scenes), *(",".join(repr(float(value)) for value in row) for row in rows)]
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")
    waves = ", ".join(f"{{ n = {n}, cos = {even!r}, sin = {odd!r} }}" for n, even, odd in kind.waves)
    path = folder / "study.toml"
    path.write_text(
        f"""title = "Scenes"
outputs = {list(NAMES)}
[parameters]
points = "scenes.csv"
[profile]
exponent = {kind.exponent!r}
harmonics = [{waves}]
[loading]
control = "{kind.control}"
""",
        encoding="utf-8",
    )
    return path


@EVERY
def test_by_command_in_blocks(name: str, gradhesion: Callable[..., Any], tmp_path: Path) -> None:
    """One process with one thread and with two, and shards that are merged, have the values of one call."""
    kind = BY_NAME[name]
    own = some(drawn(kind)[0], rng_of(f"command {name}").permutation(160)[:40])
    expected = kind.solve(own)
    path = study(kind, tmp_path, own)
    outputs = []
    for threads in (1, 2):
        out = tmp_path / f"{threads}.nc"
        result = gradhesion("run", path, "-o", out, "--threads", threads, "--quiet")
        assert result.exit_code == 0, result.output
        outputs.append(out)
    sharded = tmp_path / "shards.nc"
    for part in (1, 2):
        assert gradhesion("run", path, "-o", sharded, "--shard", f"{part}/2", "--quiet").exit_code == 0
    assert gradhesion("merge", sharded, "--quiet").exit_code == 0
    for out in (*outputs, sharded):
        with gr.open(out) as dataset:
            values = {output: dataset[output].to_numpy() for output in (*NAMES, "status")}
        agree(kind, own, dict(expected) | values, expected, NAMES)


def test_a_file_with_values_of_another_solver_is_found(gradhesion: Callable[..., Any], tmp_path: Path) -> None:
    """`verify` recomputes: it passes what is right, and finds one count or energy that is not."""
    kind = BY_NAME["cosine"]
    own = some(drawn(kind)[0], slice(8))
    own["a_max_over_R"] = np.minimum(own["a_max_over_R"], 8 * own["lambda_over_R"])
    out = tmp_path / "right.nc"
    assert gradhesion("run", study(kind, tmp_path, own), "-o", out, "--quiet").exit_code == 0
    assert gradhesion("verify", out, "--sample", "8").exit_code == 0
    for name, change in (("dissipated_energy", 1e-6), ("loading_jumps", 1)):
        with xarray.open_dataset(out) as dataset:
            wrong = dataset.load()
        wrong[name] = wrong[name] + (change if name in COUNTS else change * wrong[name])
        wrong[name].attrs = dataset[name].attrs
        other = tmp_path / f"{name}.nc"
        wrong.to_netcdf(other)
        assert gradhesion("verify", other, "--sample", "8").exit_code != 0, name


def test_the_parameters_are_those_of_the_package() -> None:
    assert tuple(gr.PARAMETERS)[:7] == PARAMETERS
