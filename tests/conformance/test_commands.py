"""The same values by `gradhesion.solve` and by the commands, in blocks and by any number of threads."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import gradhesion as gr
from gradhesion.core import PARAMETERS

from .kinds import BY_NAME, COUNTS, DEPTH, LOAD, Kind, drawn, rng_of, some
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


def study(kind: Kind, folder: Path, parameters: Any) -> Path:
    """Write a study of a grid: lists are axes."""
    waves = ", ".join(f"{{ n = {n}, cos = {even!r}, sin = {odd!r} }}" for n, even, odd in kind.waves)
    lines = [f"{name} = {np.asarray(values).tolist()!r}" for name, values in parameters.items()]
    path = folder / "study.toml"
    path.write_text(
        f"""title = "Scenes"
outputs = {list(NAMES)}
[parameters]
{chr(10).join(lines)}
[profile]
exponent = {kind.exponent!r}
harmonics = [{waves}]
[loading]
control = "{kind.control}"
""",
        encoding="utf-8",
    )
    return path


def grid_of(kind: Kind) -> dict[str, Any]:
    """Parameters of a drawn scene, with axes of several exponents, wavelengths, amplitudes and rims."""
    scenes, found = drawn(kind)
    i = rng_of(f"grid of {kind.name}").choice(np.flatnonzero((scenes["A"] > 0) & (found["loading_jumps"] > 1)))
    one = {name: float(values[i]) for name, values in scenes.items()}
    grid = one | {"k": [0.0, 0.2, 0.63], "nu": 0.3, "A": [0.0, 0.5 * one["A"], one["A"]]}
    grid |= {"lambda_over_R": [one["lambda_over_R"], 1.7 * one["lambda_over_R"]]}
    grid |= {"a_max_over_R": [0.6 * one["a_max_over_R"], one["a_max_over_R"]]}
    return grid | ({"closing_ratio": [0.0, 0.4, 1.0]} if kind.ratio else {})


def read(out: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Scenes and values of a dataset, in one dimension."""
    with gr.open(out) as dataset:
        like = dataset["pull_off_force"]
        names = [name for name in dataset.coords if name in (*PARAMETERS, "closing_ratio", "machine_stiffness", DEPTH, LOAD)]
        scenes = {str(n): dataset[n].broadcast_like(like).transpose(*like.dims).to_numpy().ravel() for n in names}
        return scenes, {name: dataset[name].to_numpy().ravel() for name in (*NAMES, "status")}


@EVERY
def test_by_command_in_blocks(name: str, gradhesion: Callable[..., Any], tmp_path: Path) -> None:
    """One thread and two, and shards that are merged, have the values of one call."""
    kind = BY_NAME[name]
    path = study(kind, tmp_path, grid_of(kind))
    outputs = [tmp_path / f"{threads}.nc" for threads in (1, 2)]
    for threads, out in enumerate(outputs, 1):
        assert gradhesion("run", path, "-o", out, "--threads", threads, "--quiet").exit_code == 0
    outputs.append(tmp_path / "shards.nc")
    for part in (1, 2):
        assert gradhesion("run", path, "-o", outputs[2], "--shard", f"{part}/2", "--quiet").exit_code == 0
    assert gradhesion("merge", outputs[2], "--quiet").exit_code == 0
    expected = None
    for out in outputs:
        own, values = read(out)
        expected = expected or kind.solve(own)
        agree(kind, own, dict(expected) | values, expected, NAMES)


def test_a_file_with_values_of_another_solver_is_found(gradhesion: Callable[..., Any], tmp_path: Path) -> None:
    """`verify` recomputes: it passes what is right, and finds one count or energy that is not."""
    out = tmp_path / "right.nc"
    grid = {"k": [0.0, 0.4], "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.1, "lambda_over_R": 0.1, "A": [0.02, 0.03]}
    path = study(Kind("verified"), tmp_path, grid | {"a_max_over_R": [0.3, 0.5]})
    assert gradhesion("run", path, "-o", out, "--quiet").exit_code == 0
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
