"""Scenes in groups, and groups in tasks."""

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core import solve
from gradhesion.core.arrays.grouping import Grouped, grouped


def curves_of(k: NDArray[np.float64], rims: int = 1) -> Grouped:
    """Give curves of some exponents with as many rims each."""
    rest = {"nu": 0.3, "modulus": 100.0, "c0_over_R": 0.1, "lambda_over_R": 0.1, "A": 0.01}
    return grouped({"k": k[:, None], **rest, "a_max_over_R": np.linspace(0.1, 1.0, rims)})


@pytest.mark.parametrize("rims", [1, 100])
@pytest.mark.parametrize(
    "counts", [[5000], [3, 1, 4], [1] * 1000, [70] * 10 + [2] * 500, [1] * 100, [63] * 128 + [64] * 3]
)
def test_every_curve_is_in_one_task(counts: list[int], rims: int) -> None:
    rng = np.random.default_rng(1)
    k = rng.permutation(np.repeat(rng.uniform(0.0, 1.0, len(counts)), counts))
    tasks = curves_of(k, rims).tasks()
    found = np.concatenate([task.index for task in tasks])
    np.testing.assert_array_equal(np.sort(found), np.arange(k.size))
    for task in tasks:
        assert task.which.shape == task.index.shape
        np.testing.assert_array_equal(task.exponents[task.which], k[task.index])
        assert task.index.size * rims <= 2048 or task.exponents.size == 1
        short = k.size * rims <= 256 and task.exponents.size <= 8
        assert task.interpolated or task.exponents.size == 1 or (short and len(tasks) == 1)


@pytest.mark.parametrize("counts", [[3, 1, 4], [32] * 8])
def test_a_short_call_is_one_task_and_has_the_bits_of_a_long_one(counts: list[int]) -> None:
    rng = np.random.default_rng(6)
    k = np.repeat(rng.uniform(0.0, 1.0, len(counts)), counts)
    k[0] = np.nan
    assert len(curves_of(k).tasks()) == (1 if len(counts) < 8 else 9)  # NaN is an exponent too
    scenes = {"k": k, "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.1, "lambda_over_R": 0.05, "a_max_over_R": 0.4}
    scenes["A"] = rng.uniform(0.0, 0.05, k.size)
    turned = scenes | {"indentation_max_over_R": 0.03}
    for parameters, outputs in ((scenes, ("pull_off_force", "pull_off_force_error")), (scenes, ()), (turned, ())):
        short = solve(parameters, outputs or ("pull_off_force", "dissipated_energy"))
        for i in range(k.size):
            alone = solve({name: np.broadcast_to(v, k.shape)[i] for name, v in parameters.items()}, [*short][:-1])
            for name, value in alone.items():
                np.testing.assert_array_equal(short[name][i], value)


def test_exponents_of_few_curves_share_a_task() -> None:
    rng = np.random.default_rng(2)
    many = rng.uniform(0.0, 1.0, 10_000)
    tasks = curves_of(many).tasks()
    assert all(task.interpolated for task in tasks)
    assert len(tasks) == -(-many.size // 512)
    few = np.repeat(many[:40], 10)  # tables of their own, which are kept, cost no more
    assert not any(task.interpolated for task in curves_of(few).tasks())
    mixed = curves_of(np.concatenate([np.full(500, 0.3), many])).tasks()
    own = [task for task in mixed if not task.interpolated]
    assert [(task.exponents.tolist(), task.index.size) for task in own] == [([0.3], 500)]


def test_no_curve_no_task() -> None:
    assert curves_of(np.empty(0)).tasks() == []


def test_what_is_no_exponent_is_in_a_task_too() -> None:
    k = np.concatenate([[np.nan, np.nan, -1.0, 2.0], np.random.default_rng(3).uniform(0.0, 1.0, 300)])
    found = np.concatenate([task.index for task in curves_of(k).tasks()])
    np.testing.assert_array_equal(np.sort(found), np.arange(k.size))


@pytest.mark.parametrize("part", [False, True])
def test_curves_of_an_exponent_each_may_stay_in_their_order(part: bool) -> None:
    k = np.random.default_rng(4).uniform(0.0, 1.0, 5000)
    k[2:20] = k[1]
    some = np.flatnonzero(k > 0.3) if part else None
    tasks = curves_of(k).tasks(some, scenes=700, as_they_stand=True)
    found = np.concatenate([task.index for task in tasks])
    np.testing.assert_array_equal(found, np.arange(5000) if some is None else some)
    for task in tasks:
        assert task.interpolated
        assert task.index.size <= 700
        np.testing.assert_array_equal(task.exponents[task.which], k[task.index])


def test_curves_that_share_exponents_do_not_stay_in_their_order() -> None:
    for k in (
        np.tile(np.linspace(0.0, 1.0, 50), 100),
        np.repeat(np.linspace(0.0, 1.0, 900), 3),
        np.linspace(0.0, 1.0, 99),
    ):
        ordered, standing = (curves_of(k).tasks(as_they_stand=stand) for stand in (False, True))
        assert len(ordered) == len(standing)
        for one, other in zip(ordered, standing, strict=True):
            np.testing.assert_array_equal(one.index, other.index)
