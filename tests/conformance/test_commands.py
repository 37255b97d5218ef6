"""The same values by `gradhesion.solve` and by the commands, in blocks and by any number of threads."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import gradhesion as gr

from .kinds import Kind, drawn, for_kinds, one_of, rng_of
from .promises import agree

EVERY = for_kinds(["sines, machine, two works, turned"])
NAMES = ("pull_off_force", "pull_off_radius", "dissipated_energy", "loading_jumps", "delta_max", "turning_radius")


def study(kind: Kind, folder: Path, parameters: dict[str, Any]) -> Path:
    """Write a study of a grid: lists are axes."""
    waves = ", ".join(f"{{ n = {n}, cos = {even!r}, sin = {odd!r} }}" for n, even, odd in kind.waves)
    lines = {name: f"{name} = {values!r}" for name, values in parameters.items()}
    stiffness = lines.pop("machine_stiffness", "")
    text = ['title = "Scenes"', f"outputs = {list(NAMES)}", "[parameters]", *lines.values(), "[profile]"]
    text += [f"exponent = {kind.exponent!r}", f"harmonics = [{waves}]", "[loading]", f'control = "{kind.control}"']
    path = folder / "study.toml"
    path.write_text("\n".join([*text, stiffness]), encoding="utf-8")
    return path


def read(out: Path, names: Any) -> tuple[dict[str, Any], ...]:
    """Scenes and values of a dataset, in one dimension."""
    with gr.open(out) as dataset:
        rows = dataset.to_dataframe().reset_index()
    return tuple({name: rows[name].to_numpy() for name in columns} for columns in (names, (*NAMES, "status")))


@EVERY
def test_by_command_in_blocks(kind: Kind, gradhesion: Callable[..., Any], tmp_path: Path) -> None:
    """One thread and two, and two studies that are merged, have the values of one call."""
    scenes, found = drawn(kind)
    many = np.flatnonzero((scenes["A"] > 0) & (found["loading_jumps"] > 1))
    one = one_of(scenes, rng_of(f"grid of {kind.name}").choice(many))
    axes: dict[str, Any] = {"k": [0.0, 0.2, 0.63], "A": [0.0, 0.5 * one["A"], one["A"]]}
    axes |= {name: [0.6 * one[name], one[name]] for name in ("lambda_over_R", "a_max_over_R")}
    grid = one | {"nu": 0.3} | axes | ({"closing_ratio": [0.0, 0.4, 1.0]} if kind.ratio else {})
    parts = {"1": grid, "2": grid, "low": grid | {"A": grid["A"][:1]}, "high": grid | {"A": grid["A"][1:]}}
    for name, part in parts.items():
        threads = 2 if name == "2" else 1
        path = study(kind, tmp_path, part)
        assert gradhesion("run", path, "-o", tmp_path / f"{name}.nc", "--threads", threads, "--quiet").exit_code == 0
    both = [tmp_path / "low.nc", tmp_path / "high.nc", "-o", tmp_path / "all.nc"]
    assert gradhesion("merge", *both, "--quiet").exit_code == 0
    expected = kind.solve(read(tmp_path / "1.nc", grid)[0])
    for name in ("1", "2", "all"):
        own, values = read(tmp_path / f"{name}.nc", grid)
        agree(kind, own, expected | values, expected, NAMES)
