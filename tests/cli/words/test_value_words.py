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


def test_each_scene_has_a_line_with_its_parameters_and_each_value_once(told: Callable[..., str]) -> None:
    values = told(gr.solve(TIP, "pull_off_force", k=[0.0, 0.3], wavelength="1 um"))
    forces = [(3 + k) / 2 * math.pi * 1e-6 * 0.05 for k in (0.0, 0.3)]  # of a smooth punch
    assert values.splitlines()[0] == "  pull_off_force_si: pull-off force F, in N", "in place of the ratio"
    assert table_of(values) == [
        ["k", "pull_off_force_si"], ["0", f"{forces[0]:.7g}"], ["0.3", f"{forces[1]:.7g}"]
    ]  # fmt: skip


def test_scenes_are_in_the_order_of_the_axes(told: Callable[..., str]) -> None:
    found = gr.solve(PUNCH, ["loading_jumps"], k=[0.0, 0.3], A=[0.01, 0.02, 0.05])
    assert table_of(told(found))[1:7] == [
        [f"{k:g}", f"{A:g}", str(int(found["loading_jumps"].sel(k=k, A=A)))]
        for k in (0.0, 0.3)
        for A in (0.01, 0.02, 0.05)
    ]


def test_the_status_is_there_where_a_scene_has_a_flag(told: Callable[..., str]) -> None:
    found = gr.solve(PUNCH, "dissipated_energy", A=[0.0, 0.1])
    names, *rows = table_of(told(found))
    assert names == ["A", "dissipated_energy", "status"]
    assert [int(row[-1]) for row in rows if row] == found["status"].values.tolist()
    assert "status" not in told(gr.solve(PUNCH, "dissipated_energy", A=[0.0, 0.01]))


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


def test_points_and_solvers_are_told_apart(gradhesion: Call, tmp_path: Path) -> None:
    study = tmp_path / "points.toml"
    study.write_text(
        'title = "t"\nlayout = "points"\noutputs = ["pull_off_force"]\n[parameters]\nk = [0.0, 0.3]\nnu = 0.3\n'
        "modulus = [500.0, 600.0]\nc0_over_R = 0.01\nlambda_over_R = 0.1\nA = 0.0\n"
        '[method]\nsolver = ["exact", "envelope"]\n',
        encoding="utf-8",
    )
    gradhesion("run", study, "-o", tmp_path / "points.nc", "--quiet")
    values = gradhesion("info", tmp_path / "points.nc").stdout.partition("\nvalues\n")[2].partition("\nstatus: ")[0]
    assert table_of(values) == [
        ["solver", "k", "modulus", "pull_off_force"],
        *([solver, k, E, force] for solver in ("exact", "envelope") for k, E, force in (("0", "500", "1"), ("0.3", "600", "1.1"))),
    ]  # fmt: skip


def test_what_has_no_value_a_scene_has_no_table(told: Callable[..., str]) -> None:
    assert not told(gr.curves(PUNCH, "path", A=[0.0, 0.01]))
    assert not told(gr.solve(PUNCH, ["pull_off_force_sensitivity"], A=[0.0, 0.01]))


def test_a_single_scene_has_a_line_for_each_output(told: Callable[..., str]) -> None:
    newtons = (3 + 0.3) / 2 * math.pi * 1e-6 * 0.05
    values = told(gr.solve(TIP, "pull_off_force", k=0.3, wavelength="1 um"))
    assert values.splitlines() == [f"  pull_off_force_si  {newtons:.7g} N  pull-off force F"]
    both = gr.solve(PUNCH, ["pull_off_force", "pull_off_force_sensitivity"], A=0.02)
    assert [line.split()[0] for line in told(both).splitlines()] == ["pull_off_force"]
