"""The contracts of a sweep: shapes, sharing, threads, order, and scenes that have no value."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gradhesion.core import FAILED, FLAGS, OUTPUTS, PARAMETERS, SOLVERS, solve
from gradhesion.core.arrays import tables
from gradhesion.core.problem.names import RESULTS
from gradhesion.core.problem.status import NO_VALUE

EPS = 2.0**-52


def _same(first: dict[str, Any], second: dict[str, Any]) -> None:
    assert first.keys() == second.keys()
    for name, values in first.items():
        np.testing.assert_array_equal(values, second[name], err_msg=name)


@pytest.fixture(scope="module")
def mixture() -> dict[str, np.ndarray]:
    """A thousand scenes of several exponents in random order."""
    rng = np.random.default_rng(50)
    size = 1000
    k = rng.choice([0.0, 0.13, 0.5, 0.77, 1.0], size)
    return {
        "k": k,
        "nu": np.where(k == 1.0, 0.5, rng.uniform(-0.3, 0.5, size)),
        "modulus": 10.0 ** rng.uniform(1, 4, size),
        "c0_over_R": 10.0 ** rng.uniform(-2, 0, size),
        "lambda_over_R": 10.0 ** rng.uniform(-1.5, 0, size),
        "A": np.where(rng.uniform(size=size) < 0.1, 0.0, 10.0 ** rng.uniform(-4, -1, size)),
        "a_max_over_R": np.where(rng.uniform(size=size) < 0.05, math.inf, 10.0 ** rng.uniform(-1, 0.5, size)),
    }


def test_names() -> None:
    assert len(PARAMETERS) == 7
    assert (*RESULTS, "turning_radius") == OUTPUTS
    assert len(RESULTS) == 9
    assert "exact" in SOLVERS
    assert FLAGS["no_value"] == NO_VALUE
    assert FAILED & NO_VALUE


def test_one_scene(scene: dict[str, float]) -> None:
    values = solve(scene)
    assert set(values) == {"pull_off_force", "dissipated_energy", "status"}
    assert all(array.shape == () for array in values.values())
    assert values["pull_off_force"].dtype == np.float64
    assert values["status"].dtype == np.int8


def test_jumps_are_integers(scene: dict[str, float]) -> None:
    values = solve(scene, ("loading_jumps", "unloading_jumps"))
    assert values["loading_jumps"].dtype == values["unloading_jumps"].dtype == np.int32
    assert values["loading_jumps"] > 1
    assert values["unloading_jumps"] > 1


@pytest.mark.parametrize("axis", range(7))
def test_every_parameter_can_vary_along_every_axis(axis: int, scene: dict[str, float]) -> None:
    """The same grid with its axes in another order is the same study."""
    steps = {
        "k": [0.2, 0.31],
        "nu": [0.1, 0.27],
        "modulus": [900.0, 1730.0],
        "c0_over_R": [0.037, 0.11],
        "lambda_over_R": [0.043, 0.2],
        "A": [0.0, 0.0137],
        "a_max_over_R": [0.3, 0.47],
    }

    def grid(order: list[str]) -> dict[str, Any]:
        return {name: np.reshape(steps[name], [2 if name == other else 1 for other in order]) for name in steps}

    order = list(PARAMETERS)
    turned = order[axis:] + order[:axis]
    first, second = solve(grid(order), OUTPUTS), solve(grid(turned), OUTPUTS)
    for name in OUTPUTS:
        assert first[name].shape == (2,) * 7
        back = np.transpose(second[name], [turned.index(other) for other in order])
        # a trace that several rims share is the same trace, but for the order of its sums
        np.testing.assert_allclose(first[name], back, rtol=4 * EPS, atol=0 if "jumps" in name else 4 * EPS)
    corner = solve(scene | {"lambda_over_R": 0.043}, OUTPUTS)
    for name in OUTPUTS:
        np.testing.assert_allclose(first[name][1, 1, 1, 0, 0, 1, 1], corner[name], rtol=4 * EPS)


def test_broadcasting(scene: dict[str, float]) -> None:
    k, a_max = np.array([0.1, 0.31, 0.6])[:, None], np.array([0.2, 0.47])
    values = solve(scene | {"k": k, "a_max_over_R": a_max})
    assert values["pull_off_force"].shape == (3, 2)
    single = solve(scene)
    for name, array in values.items():
        np.testing.assert_allclose(array[1, 1], single[name], rtol=4 * EPS)


def test_empty(scene: dict[str, float]) -> None:
    values = solve(scene | {"A": np.empty((0, 3))})
    assert values["pull_off_force"].shape == (0, 3)
    assert values["status"].shape == (0, 3)


def test_lists_and_integers_are_arrays(scene: dict[str, float]) -> None:
    _same(solve(scene | {"a_max_over_R": [1, 2]}), solve(scene | {"a_max_over_R": np.array([1.0, 2.0])}))


def test_shared_rims_equal_single_ones(mixture: dict[str, np.ndarray]) -> None:
    """All rims of a curve on one trace, and each for itself."""
    rims = np.concatenate([np.geomspace(0.01, 3.0, 60), [math.inf]])
    for i in range(0, 200, 7):
        curve = {name: float(values[i]) for name, values in mixture.items()}
        together = solve(curve | {"a_max_over_R": rims}, OUTPUTS)
        alone = [solve(curve | {"a_max_over_R": float(rim)}, OUTPUTS) for rim in rims]
        for name in OUTPUTS:
            single = np.array([values[name] for values in alone])
            np.testing.assert_allclose(together[name], single, rtol=8 * EPS, atol=0 if "jumps" in name else 2 * EPS)


def test_order_of_rims_does_not_matter(scene: dict[str, float]) -> None:
    rims = np.geomspace(0.01, 3.0, 80)
    shuffled = np.random.default_rng(51).permutation(80)
    first = solve(scene | {"a_max_over_R": rims}, OUTPUTS)
    second = solve(scene | {"a_max_over_R": rims[shuffled]}, OUTPUTS)
    for name in OUTPUTS:
        np.testing.assert_allclose(first[name][shuffled], second[name], rtol=4 * EPS, atol=2 * EPS)


@pytest.mark.parametrize(
    "asked", [OUTPUTS[:1], OUTPUTS[2:3], OUTPUTS[3:5], OUTPUTS[5:6], OUTPUTS[6:], OUTPUTS[::-1], ()]
)
def test_what_is_asked_for_changes_no_bit(asked: tuple[str, ...], mixture: dict[str, np.ndarray]) -> None:
    everything, some = solve(mixture, OUTPUTS), solve(mixture, asked)
    assert set(some) == {*asked, "status"}
    # what the status tells of the path it tells only where that is followed
    for result in (everything, some):
        result["status"] = result["status"] & FAILED
    _same({name: everything[name] for name in some}, some)


@pytest.mark.parametrize("threads", [2, 3, None])
def test_threads_change_no_bit(threads: int | None, mixture: dict[str, np.ndarray]) -> None:
    _same(solve(mixture, OUTPUTS, threads=1), solve(mixture, OUTPUTS, threads=threads))


def test_threads_change_no_bit_of_a_grid(scene: dict[str, float]) -> None:
    grid = scene | {"A": np.geomspace(1e-4, 0.03, 90)[:, None], "a_max_over_R": np.geomspace(0.02, 1.0, 70)}
    _same(solve(grid, OUTPUTS, threads=1), solve(grid, OUTPUTS, threads=2))


def test_order_of_scenes_does_not_matter(mixture: dict[str, np.ndarray]) -> None:
    shuffled = np.random.default_rng(52).permutation(mixture["k"].size)
    first = solve(mixture, OUTPUTS)
    second = solve({name: values[shuffled] for name, values in mixture.items()}, OUTPUTS)
    _same({name: values[shuffled] for name, values in first.items()}, second)


def test_neighbours_do_not_matter(mixture: dict[str, np.ndarray]) -> None:
    """A part of a study is that part of its results, to the bit."""
    part = slice(100, 300)
    first = solve(mixture, OUTPUTS)
    second = solve({name: values[part] for name, values in mixture.items()}, OUTPUTS)
    _same({name: values[part] for name, values in first.items()}, second)


def test_twice_is_the_same(mixture: dict[str, np.ndarray]) -> None:
    _same(solve(mixture, OUTPUTS), solve(mixture, OUTPUTS))


WRONG = [
    ("k", -5e-324),
    ("k", float(np.nextafter(1.0, 2.0))),
    ("k", math.nan),
    ("k", math.inf),
    ("k", 1.0),  # at nu < 1/2
    ("nu", -1.0),
    ("nu", float(np.nextafter(0.5, 1.0))),
    ("nu", math.nan),
    ("modulus", 0.0),
    ("modulus", -1.0),
    ("modulus", math.nan),
    ("modulus", math.inf),
    ("c0_over_R", 0.0),
    ("c0_over_R", -1.0),
    ("c0_over_R", math.nan),
    ("lambda_over_R", 0.0),
    ("lambda_over_R", -0.1),
    ("lambda_over_R", math.nan),
    ("lambda_over_R", math.inf),
    ("A", -1e-9),
    ("A", math.nan),
    ("A", math.inf),
    ("a_max_over_R", 0.0),
    ("a_max_over_R", -0.1),
    ("a_max_over_R", math.nan),
]


@pytest.mark.parametrize(("name", "value"), WRONG)
def test_wrong_scenes_have_no_value_and_disturb_nobody(name: str, value: float, scene: dict[str, float]) -> None:
    good = solve({key: np.full(5, number) for key, number in scene.items()}, OUTPUTS)
    parameters = {key: np.full(5, number) for key, number in scene.items()}
    parameters[name][2] = value
    values = solve(parameters, OUTPUTS)
    assert values["status"].tolist() == [0, 0, NO_VALUE, 0, 0]
    for output in OUTPUTS:
        bad = values[output][2]
        assert bad == -1 if "jumps" in output else math.isnan(bad)
        np.testing.assert_array_equal(np.delete(values[output], 2), np.delete(good[output], 2))


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan])
def test_a_wrong_rim_on_a_shared_trace_disturbs_nobody(value: float, scene: dict[str, float]) -> None:
    """Other rims of the same curve keep their values."""
    good = solve(scene | {"a_max_over_R": [0.2, 0.3, 0.4]}, OUTPUTS)
    values = solve(scene | {"a_max_over_R": [0.2, value, 0.4]}, OUTPUTS)
    assert values["status"].tolist() == [0, NO_VALUE, 0]
    for output in OUTPUTS:
        np.testing.assert_allclose(values[output][[0, 2]], good[output][[0, 2]], rtol=4 * EPS)


@pytest.mark.parametrize(
    ("name", "value"),
    [("nu", float(np.nextafter(-1.0, 0.0))), ("nu", 0.5), ("k", 0.0), ("k", 1 - 2.0**-53), ("A", 0.0), ("A", 5e-324)],
)
def test_edges_of_the_ranges_are_scenes(name: str, value: float, scene: dict[str, float]) -> None:
    values = solve(scene | {name: value}, OUTPUTS)
    assert not values["status"] & FAILED
    assert all(np.isfinite(values[output]).all() for output in OUTPUTS)


@pytest.mark.parametrize("a_max", [math.inf, 1e30])
def test_unbounded_punch(a_max: float, scene: dict[str, float]) -> None:
    values = solve(scene | {"a_max_over_R": [a_max, 50.0]}, OUTPUTS)
    for name in ("pull_off_force", "pull_off_radius", "dissipated_energy", "delta_jump_out", "loading_jumps"):
        np.testing.assert_allclose(values[name][0], values[name][1], rtol=8 * EPS)
    assert values["delta_max"][0] == (math.inf if a_max == math.inf else pytest.approx(1e60 / 1.31, rel=1e-12))


@pytest.mark.parametrize(
    "call",
    [
        lambda scene: solve(scene, ("pull_off_force", "pull_off")),
        lambda scene: solve(scene, solver="magic"),
        lambda scene: solve({name: value for name, value in scene.items() if name != "A"}),
        lambda scene: solve(scene | {"A": [0.1, 0.2], "k": [0.1, 0.2, 0.3]}),
    ],
)
def test_mistakes_of_the_caller(call: Callable[..., object], scene: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=r"unknown|missing|broadcast"):
        call(scene)


def test_a_table_is_made_once(scene: dict[str, float]) -> None:
    solve(scene)
    before = tables._own.cache_info().misses
    solve(scene | {"A": np.linspace(0, 0.1, 5000)})
    assert tables._own.cache_info().misses == before


def test_inputs_are_left_alone(mixture: dict[str, np.ndarray]) -> None:
    copies = {name: values.copy() for name, values in mixture.items()}
    solve(mixture)
    for name, values in mixture.items():
        np.testing.assert_array_equal(values, copies[name])
