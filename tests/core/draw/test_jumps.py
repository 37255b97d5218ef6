"""The jumps of a cycle: stored cycles, the definition of their energies in slow arithmetic, and the path they are on."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from gradhesion.core import draw_curves, solve
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LOADING_NOT_ONE_DISC, NO_VALUE

TESTS = Path(__file__).parents[2]


def _jumps(scene: dict[str, float]) -> dict[str, Any]:
    variables, status = draw_curves(scene, ["jumps"])
    assert status & NO_VALUE == 0
    return {name.removeprefix("jump_"): values for name, values in variables.items()}


def _stored() -> list[tuple[dict[str, float], dict[str, Any]]]:
    """Scenes solved to 30 digits by other methods: all of the reference, and a part of those of the twin."""
    reference = json.loads((TESTS / "reference" / "scenes.json").read_text(encoding="utf-8"))["scenes"]
    file = json.loads((TESTS / "twin" / "scenes.json").read_text(encoding="utf-8"))
    rows = [dict(zip(file["columns"], row, strict=True)) for row in file["scenes"]]
    names = reference[0]["parameters"]
    return [(scene["parameters"], scene["expected"]) for scene in reference] + [
        ({name: math.inf if row[name] is None else row[name] for name in names}, row)
        for row in rows[7::20]
        if row["margin_jumps"] >= 1e-12
    ]


STORED = _stored()


@pytest.mark.parametrize("item", range(len(STORED)))
def test_stored_cycles_are_the_sum_of_their_jumps(item: int) -> None:
    scene, expected = STORED[item]
    jumps = _jumps(scene)
    unloading = jumps["unloading"] == 1
    assert (~unloading).sum() == expected["loading_jumps"]
    assert unloading.sum() == expected["unloading_jumps"]
    # each energy is right to some 1e-14 of itself, and they do not all have one sign
    assert abs(jumps["energy"].sum() - expected["dissipated_energy"]) <= 1e-12 * np.abs(jumps["energy"]).sum()


def test_they_sum_up_to_what_a_map_has(any_scene: dict[str, float]) -> None:
    jumps = _jumps(any_scene)
    solved = solve(any_scene, ["dissipated_energy", "loading_jumps", "unloading_jumps"])
    assert (jumps["unloading"] == 0).sum() == solved["loading_jumps"]
    assert (jumps["unloading"] == 1).sum() == solved["unloading_jumps"]
    # beyond 80 waves a map sums them without walking (waves/cosine_sum.py)
    assert abs(jumps["energy"].sum() - solved["dissipated_energy"]) <= 1e-12 * np.abs(jumps["energy"]).sum()


def test_long_curves_are_catalogued_wave_by_wave(scene: dict[str, float]) -> None:
    scene |= {"lambda_over_R": 4e-5, "A": 0.03}
    jumps = _jumps(scene)
    solved = solve(scene, ["dissipated_energy", "loading_jumps", "unloading_jumps"])
    assert jumps["energy"].size == solved["loading_jumps"] + solved["unloading_jumps"] > 10_000
    assert abs(jumps["energy"].sum() / solved["dissipated_energy"] - 1) <= 1e-12


@pytest.mark.parametrize("waviness", [{}, {"k": 0.0}, {"k": 1.0, "nu": 0.5}, {"A": 0.0}, {"A": 0.21}], ids=str)
def test_an_energy_is_the_integral_that_defines_it(
    waviness: dict[str, float], scene: dict[str, float], slow_curve: Callable[..., Any]
) -> None:
    """2 pi a [1 - ((delta_H - delta_j)/Delta)^2] from one radius to the other, in R^2 dgamma."""
    scene |= waviness
    jumps, slow = _jumps(scene), slow_curve(scene)

    def integrand(a: Any, depth: float) -> Any:
        paraboloid, wave, pull, _ = slow.terms(a)
        return 2 * mpmath.pi * a * (1 - ((paraboloid + wave - depth) / pull) ** 2)

    for i in {0, 1, jumps["energy"].size // 2, jumps["energy"].size - 1}:
        start, end = float(jumps["radius_before"][i]), float(jumps["radius_after"][i])
        places = np.linspace(start, end, 2 + int(abs(end - start) / scene["lambda_over_R"]))
        with mpmath.workdps(18):
            depth = float(jumps["indentation"][i])
            expected = mpmath.quad(lambda a, depth=depth: integrand(a, depth), places.tolist())
        # of the size of the work of adhesion alone; the ends are rounded, and 1 - (..)^2 is 0 at that which is left
        size = 2 * math.pi * max(start, end) * abs(end - start)
        assert abs(jumps["energy"][i] - float(expected)) <= 1e-12 * size


def test_they_are_the_jumps_of_the_path(any_scene: dict[str, float]) -> None:
    path = draw_curves(any_scene, ["path"])[0]
    jumps = _jumps(any_scene)
    after = np.flatnonzero(path["path_jump"])
    for name, of_path, points in (
        ("indentation", "path_indentation", after),
        ("indentation", "path_indentation", after - 1),
        ("radius_before", "path_contact_radius", after - 1),
        ("radius_after", "path_contact_radius", after),
        ("load_before", "path_load", after - 1),
        ("load_after", "path_load", after),
        ("unloading", "path_unloading", after),
    ):
        np.testing.assert_array_equal(jumps[name], path[of_path][points])


def test_loading_goes_outwards_and_unloading_inwards(any_scene: dict[str, float]) -> None:
    jumps = _jumps(any_scene)
    unloading = jumps["unloading"] == 1
    assert jumps["radius_before"][0] == jumps["indentation"][0] == jumps["load_before"][0] == 0.0
    assert (np.diff(jumps["unloading"]) >= 0).all()
    outwards = jumps["radius_after"] > jumps["radius_before"]
    np.testing.assert_array_equal(outwards, ~unloading)
    assert (np.diff(jumps["indentation"][~unloading]) > 0).all()
    assert (np.diff(jumps["indentation"][unloading]) < 0).all()
    assert (jumps["energy"][unloading] > 0).all(), "unloading never gains"
    if any_scene["k"] < 1:
        assert jumps["radius_after"][-1] == jumps["load_after"][-1] == 0.0


def test_jumps_at_the_rim_are_marked(scene: dict[str, float]) -> None:
    free = _jumps(scene | {"a_max_over_R": math.inf})
    rim = float(0.3 * free["radius_before"][2] + 0.7 * free["radius_after"][2])  # within a jump of loading
    jumps = _jumps(scene | {"a_max_over_R": rim})
    last = int((jumps["unloading"] == 0).sum()) - 1
    assert np.flatnonzero(jumps["at_rim"]).tolist() == [last, last + 1]
    assert jumps["radius_after"][last] == jumps["radius_before"][last + 1] == rim
    assert _jumps(scene | {"a_max_over_R": 0.01})["at_rim"].tolist() == [1, 1], "to the rim and back at once"
    assert not _jumps(scene | {"a_max_over_R": math.inf})["at_rim"].any()


def test_a_jump_that_gains_energy_is_told_with_its_sign() -> None:
    scene = {
        "k": 1.0,
        "nu": 0.5,
        "modulus": 900.0,
        "c0_over_R": 0.1,
        "lambda_over_R": 0.11,
        "A": 2.3,
        "a_max_over_R": 0.16,
    }
    variables, status = draw_curves(scene, ["jumps"])
    gains = variables["jump_energy"] < 0
    assert status == LOADING_NOT_ONE_DISC
    assert gains.any()
    assert (variables["jump_unloading"][gains] == 0).all()


def test_what_a_map_reports_of_the_cycle_is_told_once(scene: dict[str, float]) -> None:
    end = float(
        _jumps(scene)["radius_before"][3]
    )  # a rim at the end of a branch: an ulp further, and there is a jump more
    scene |= {"a_max_over_R": end}
    assert draw_curves(scene, ["jumps"])[1] == draw_curves(scene, ["jumps", "path"])[1] == CLOSE_TO_A_JUMP


@pytest.mark.parametrize("wrong", [{"nu": 0.6}, {"lambda_over_R": 8e-6}], ids=str)
def test_without_a_value_there_is_no_jump(wrong: dict[str, float], scene: dict[str, float]) -> None:
    variables, status = draw_curves(scene | wrong, ["jumps"])
    assert status == NO_VALUE
    assert {values.size for values in variables.values()} == {0}
