"""`gradhesion info` writes the values of few scenes as a table, and no table of many."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

import gradhesion as gr

Call = Callable[..., Result]
PUNCH: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}  # fmt: skip
TIP: dict[str, Any] = {"nu": 0.3, "A": 0.0, "R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm"}  # fmt: skip


@pytest.fixture
def told(gradhesion: Call, tmp_path: Path) -> Callable[..., str]:
    """What `info` says of a dataset, from its values to its status."""

    def tell(dataset: Any, *options: str) -> str:
        dataset.to_netcdf(path := tmp_path / "it.nc")
        result = gradhesion("info", path, *options)
        assert result.exit_code == 0, result.stderr
        return result.stdout.partition("\nvalues\n")[2].partition("\nstatus: ")[0]

    return tell


def table_of(told: str) -> list[list[str]]:
    """The table below what the values are."""
    return [line.split() for line in told.partition("\n\n")[2].splitlines()]


def test_few_scenes_have_a_line_each_with_their_parameters_and_values(told: Callable[..., str]) -> None:
    values = table_of(told(gr.solve(TIP, "pull_off_force", k=[0.0, 0.3], wavelength="1 um")))
    forces = [(3 + k) / 2 * math.pi * 1e-6 * 0.05 for k in (0.0, 0.3)]  # of a smooth punch, in place of the ratio
    assert values == [["k", "pull_off_force_si"], ["0", f"{forces[0]:.7g}"], ["0.3", f"{forces[1]:.7g}"]]
    found = gr.solve(PUNCH, ["loading_jumps"], k=[0.0, 0.3], A=[0.01, 0.02, 0.05])
    rows = [[f"{k:g}", f"{A:g}", str(int(found["loading_jumps"].sel(k=k, A=A)))] for k in (0.0, 0.3) for A in found["A"].values]  # fmt: skip
    assert table_of(told(found))[1:7] == rows
    flagged = gr.solve(PUNCH, "dissipated_energy", A=[0.0, 0.1])
    names, *lines = table_of(told(flagged))
    assert names == ["A", "dissipated_energy", "status"]
    assert [int(row[-1]) for row in lines if row] == flagged["status"].values.tolist()


def test_columns_that_do_not_fit_go_on_below(told: Callable[..., str]) -> None:
    outputs = ["pull_off_force", "pull_off_radius", "dissipated_energy", "delta_max"]
    outputs += ["delta_jump_out", "loading_jumps", "unloading_jumps", "turning_radius"]
    table = told(gr.solve(PUNCH, outputs, A=[0.0, 0.01])).partition("\n\n")[2]
    assert max(map(len, table.splitlines())) <= 100
    assert {*outputs} < {*table.split()}


@pytest.mark.parametrize(("scenes", "there"), [(12, True), (13, False)])
def test_only_few_scenes_have_a_table(scenes: int, there: bool, told: Callable[..., str]) -> None:
    found = gr.solve(PUNCH, "pull_off_force", A=[0.001 * i for i in range(scenes)])
    assert bool(told(found)) == there
    assert len(table_of(told(found, "--at", "A=0.001:0.002"))) == 3, "a part has few scenes"


def test_points_and_solvers_are_told_apart(told: Callable[..., str]) -> None:
    scenes = PUNCH | {"k": [0.0, 0.3], "modulus": [500.0, 600.0], "A": 0.0}
    method = {"solver": ["exact", "envelope"]}
    found = gr.run({"layout": "points", "outputs": ["pull_off_force"], "parameters": scenes, "method": method})
    rows = [[solver, *rest] for solver in method["solver"] for rest in (("0", "500", "1"), ("0.3", "600", "1.1"))]
    assert table_of(told(found)) == [["solver", "k", "modulus", "pull_off_force"], *rows]


def test_a_single_scene_has_a_line_for_each_value_and_none_for_what_has_several(told: Callable[..., str]) -> None:
    newtons = (3 + 0.3) / 2 * math.pi * 1e-6 * 0.05
    (line,) = told(gr.solve(TIP, "pull_off_force", k=0.3, wavelength="1 um")).splitlines()
    assert line.split()[:3] == ["pull_off_force_si", f"{newtons:.7g}", "N"]
    both = gr.solve(PUNCH, ["pull_off_force", "pull_off_force_sensitivity"], A=0.02)
    assert [line.split()[0] for line in told(both).splitlines()] == ["pull_off_force"]
    assert not told(gr.curves(PUNCH, "path", A=[0.0, 0.01]))
