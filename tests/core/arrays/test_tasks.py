"""Tasks of one exponent each: all curves once, a few in memory, and an error ends them."""

import threading
import tracemalloc

import numpy as np
import pytest

from gradhesion.core.arrays.tasks import Task, groups_of, run_one_by_one, tasks_of


@pytest.mark.parametrize("size", [1, 3, 100])
@pytest.mark.parametrize("workers", [1, 2, 5])
def test_each_curve_is_in_one_task_of_its_exponent(size: int, workers: int) -> None:
    k = np.random.default_rng(3).choice([0.0, 0.1, 0.7, np.nextafter(0.7, 1.0), np.nan], 57)
    tasks, seen, lock = tasks_of(k, size), list[tuple[float, list[int]]](), threading.Lock()

    def work(task: Task) -> None:
        exponent, index = task
        with lock:
            seen.append((exponent, index.tolist()))

    run_one_by_one(tasks, work, workers)
    assert len(seen) == len(tasks) == sum(1 for _ in tasks)
    assert sorted(i for _, index in seen for i in index) == list(range(57))
    for exponent, index in seen:
        assert len(index) <= size
        assert np.array_equal(k[index], np.full(len(index), exponent), equal_nan=True)


def test_none() -> None:
    tasks = tasks_of(np.array([]), 4)
    assert len(tasks) == 0
    run_one_by_one(tasks, lambda *_: pytest.fail("there is no task"), 3)


def test_what_one_raises_ends_all() -> None:
    done = []

    def work(task: Task) -> None:
        exponent, _ = task
        done.append(exponent)
        if exponent > 10.0:
            raise MemoryError(f"no room at {exponent}")

    with pytest.raises(MemoryError, match="no room at 1"):
        run_one_by_one(tasks_of(np.arange(10_000.0), 1), work, 2)
    assert len(done) < 10_000


@pytest.mark.parametrize("workers", [1, 4])
def test_tasks_are_not_held(workers: int) -> None:
    """10^5 exponents of their own: 16 bytes each in two arrays of integers, where a future takes 2 kB."""
    tasks = tasks_of(np.arange(100_000.0), 16)
    tracemalloc.start()
    run_one_by_one(tasks, lambda *_: None, workers)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(tasks) == 100_000
    assert peak < 2**20 + 100_000 * 8, f"{peak} bytes"


@pytest.mark.parametrize("repeated", [0, 1, 300])
def test_the_order_is_stable(repeated: int) -> None:
    rng = np.random.default_rng(8)
    k = rng.uniform(0.0, 1.0, 1000)
    k[600 : 600 + repeated] = k[0]
    order, begins = groups_of(k)
    np.testing.assert_array_equal(order, np.argsort(k, kind="stable"))
    assert begins.size == 1000 - repeated


@pytest.mark.parametrize("others", [[], [0.3 + 1e-9], [-1.0, 2.0, np.inf, -np.inf], [np.nan]])
def test_few_exponents_are_in_stable_order(others: list[float]) -> None:
    """Those that are too close to be told apart by counting, or no exponents, are sorted too."""
    rng = np.random.default_rng(9)
    k = rng.choice([0.0, 5e-324, 0.3, np.nextafter(1.0, 0.0), 1.0, *others], 3000)
    order, begins = groups_of(k)
    np.testing.assert_array_equal(order, np.argsort(k, kind="stable"))
    numbers = np.unique(k[~np.isnan(k)]).size
    assert begins.size == numbers + np.count_nonzero(np.isnan(k))
