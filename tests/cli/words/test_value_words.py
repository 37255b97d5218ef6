"""`gradhesion info` writes the values of few scenes as a table, and no table of many."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

import gradhesion as gr
from gradhesion.cli.words.value_words import MOST, WIDTH, value_lines

Call = Callable[..., Result]
PUNCH: dict[str, Any] = {"k": 0.0, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "a_max_over_R": 1.0}  # fmt: skip
TIP: dict[str, Any] = {"nu": 0.3, "A": 0.0, "R": "1 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "10 nm"}  # fmt: skip


def lines(dataset: Any, *varying: str) -> list[str]:
    return list(value_lines(dataset, varying))[1:]


def test_each_scene_has_a_line_with_its_parameters_and_values() -> None:
    smooth = gr.solve(TIP, "pull_off_force", k=[0.0, 0.3], wavelength="1 um")
    title, names, units, *rows = lines(smooth, "k")
    assert title == "values"
    assert names.split() == ["k", "pull_off_force_si"], "in place of the ratio"
    assert units.split() == ["N"]
    forces = [(3 + k) / 2 * 3.141592653589793 * 1e-6 * 0.05 for k in (0.0, 0.3)]  # of a smooth punch
    assert [row.split() for row in rows] == [["0", f"{forces[0]:.7g}"], ["0.3", f"{forces[1]:.7g}"]]
    assert len({len(line) for line in (names, *rows)}) == 1, "columns stand below each other"


def test_scenes_are_in_the_order_of_the_axes() -> None:
    found = gr.solve(PUNCH, ["loading_jumps"], k=[0.0, 0.3], A=[0.01, 0.02, 0.05])
    rows = [line.split() for line in lines(found, "k", "A")[2:]]
    expected = [
        [f"{k:g}", f"{A:g}", str(int(found["loading_jumps"].sel(k=k, A=A)))]
        for k in (0.0, 0.3)
        for A in (0.01, 0.02, 0.05)
    ]
    assert rows == expected


def test_the_status_is_there_where_a_scene_has_a_flag() -> None:
    found = gr.solve(PUNCH, "dissipated_energy", A=[0.0, 0.1])
    names, *rows = (line.split() for line in lines(found, "A")[1:])
    assert names == ["A", "dissipated_energy", "status"]
    assert [int(row[-1]) for row in rows] == found["status"].values.tolist()
    assert "status" not in lines(gr.solve(PUNCH, "dissipated_energy", A=[0.0, 0.01]), "A")[1]


def test_columns_that_do_not_fit_are_counted() -> None:
    outputs = ["pull_off_force", "pull_off_radius", "dissipated_energy", "delta_max"]
    outputs += ["delta_jump_out", "loading_jumps", "unloading_jumps", "turning_radius"]
    found = gr.solve(PUNCH, outputs, A=[0.0, 0.01])
    *table, rest = lines(found, "A")
    assert max(map(len, table)) <= WIDTH
    left = 1 + len(outputs) - len(table[1].split())
    assert rest == f"  and {left} more column{'s' if left > 1 else ''}: gradhesion info --format csv"
    assert left > 0


@pytest.mark.parametrize(("scenes", "there"), [(2, True), (MOST, True), (MOST + 1, False)])
def test_only_few_scenes_have_a_table(scenes: int, there: bool) -> None:
    found = gr.solve(PUNCH, "pull_off_force", A=[0.001 * i for i in range(scenes)])
    assert len(lines(found, "A")) == (2 + scenes if there else 0)


def test_points_and_solvers_are_told_apart(gradhesion: Call, tmp_path: Path) -> None:
    study = tmp_path / "points.toml"
    study.write_text(
        'title = "t"\nlayout = "points"\noutputs = ["pull_off_force"]\n[parameters]\nk = [0.0, 0.3]\nnu = 0.3\n'
        "modulus = [500.0, 600.0]\nc0_over_R = 0.01\nlambda_over_R = 0.1\nA = 0.0\n"
        '[method]\nsolver = ["exact", "envelope"]\n',
        encoding="utf-8",
    )
    gradhesion("run", study, "-o", tmp_path / "points.nc", "--quiet")
    told = gradhesion("info", tmp_path / "points.nc").stdout
    table = told.partition("\nvalues\n")[2].partition("\n\n")[0]
    assert [row.split() for row in table.splitlines()] == [
        ["solver", "k", "modulus", "pull_off_force"],
        *([solver, k, E, force] for solver in ("exact", "envelope") for k, E, force in (("0", "500", "1"), ("0.3", "600", "1.1"))),
    ]  # fmt: skip


def test_what_has_no_value_a_scene_has_no_table() -> None:
    curve = gr.curves(PUNCH, "path", A=[0.0, 0.01])
    assert lines(curve, "A") == []
    both = gr.solve(PUNCH, ["pull_off_force_sensitivity"], A=[0.0, 0.01])
    assert lines(both, "A") == []


def test_a_single_scene_has_a_line_for_each_output(gradhesion: Call, tmp_path: Path) -> None:
    study = tmp_path / "tip.toml"
    study.write_text(
        'title = "t"\noutputs = ["pull_off_force"]\n[parameters]\nk = 0.3\nnu = 0.3\nA = 0.0\n[physical]\nR = "1 um"\n'
        'E_star = "1 GPa"\nwork_of_adhesion = "50 mJ/m^2"\nc0 = "10 nm"\nwavelength = "1 um"\n',
        encoding="utf-8",
    )
    gradhesion("run", study, "-o", tmp_path / "tip.nc", "--quiet")
    told = gradhesion("info", tmp_path / "tip.nc").stdout
    newtons = (3 + 0.3) / 2 * 3.141592653589793 * 1e-6 * 0.05
    assert told.partition("\nvalues\n")[2].partition("\n\n")[0].splitlines() == [
        "  pull_off_force     1.1             pull-off force F/(1.5 pi R dgamma)",
        f"  pull_off_force_si  {newtons:.7g} N  pull-off force F",
    ]
    assert "pull_off_force: " not in told, "no extremes of one value"


def test_what_is_no_number_of_one_scene_is_told_as_of_several(gradhesion: Call, tmp_path: Path) -> None:
    found = gr.solve(PUNCH, ["pull_off_force", "pull_off_force_sensitivity"], A=0.02)
    assert [line.split()[0] for line in lines(found)] == ["values", "pull_off_force"]
    found.to_netcdf(tmp_path / "one.nc")
    assert "  strongest: " in gradhesion("info", tmp_path / "one.nc").stdout
