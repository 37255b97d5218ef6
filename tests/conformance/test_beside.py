"""A scene has the values that it has alone: beside any others, in any order, by any number of threads and blocks."""

from typing import Any

import numpy as np
import pytest

from .kinds import BY_NAME, KINDS, Kind, at, drawn, name_of, rng_of, some
from .promises import CLOSE, agree

EVERY = pytest.mark.parametrize("kind", KINDS, ids=name_of)


def same_status(found: Any, other: Any) -> None:
    """Bits are equal; `close_to_a_jump` may differ, for a tie within 1e-10 may be 1e-10 and an ulp."""
    assert ((found["status"] ^ other["status"]) & ~CLOSE == 0).all(), (found["status"], other["status"])


@EVERY
def test_alone_and_beside_others(kind: Kind) -> None:
    scenes, found = drawn(kind)
    for i in rng_of(f"alone {kind.name}").choice(found["status"].size, 12, replace=False):
        one = {name: values[i] for name, values in scenes.items()}
        alone = kind.solve(one)
        agree(kind, some(scenes, [i]), {n: np.reshape(v, 1) for n, v in alone.items()}, some(found, [i]))
        same_status(alone, some(found, i))


@EVERY
def test_in_any_order_and_in_pieces(kind: Kind) -> None:
    scenes, found = drawn(kind)
    order = rng_of(f"order {kind.name}").permutation(found["status"].size)
    for piece in np.array_split(order, 5):
        other = kind.solve(some(scenes, piece))
        agree(kind, some(scenes, piece), other, some(found, piece))
        same_status(other, some(found, piece))


@EVERY
def test_threads_change_no_bit(kind: Kind) -> None:
    scenes, _ = drawn(kind)
    first, second = (kind.solve(some(scenes, slice(60)), threads=threads) for threads in (1, 2))
    for name in first:
        np.testing.assert_array_equal(first[name], second[name])


@EVERY
def test_two_neighbours(kind: Kind) -> None:
    """Pairs that differ in one parameter alone, against both alone: what a solver shares between them is not mixed."""
    scenes, found = drawn(kind)
    rng = rng_of(f"pairs {kind.name}")
    for name in scenes:
        i, j = rng.choice(found["status"].size, 2, replace=False)
        first = {n: v[i] for n, v in scenes.items()}
        if name in ("k", "nu") and (scenes["k"][j] > 0.98 or first["k"] > 0.98):
            continue  # only nu = 1/2 has a value there
        second = first | {name: scenes[name][j]}
        pair = {n: np.array([first[n], second[n]]) for n in scenes}
        alone = [kind.solve(one) for one in (first, second)]
        expected = {n: np.array([one[n] for one in alone]) for n in alone[0]}
        for order in ([0, 1], [1, 0]):
            agree(kind, some(pair, order), kind.solve(some(pair, order)), some(expected, order))


@EVERY
def test_a_grid_is_its_points(kind: Kind) -> None:
    """Rims along the last axis share a trace, and other parameters stand before or behind them."""
    scenes, found = drawn(kind)
    rng = rng_of(f"grid {kind.name}")
    i = rng.integers(found["status"].size)
    one = {name: values[i] for name, values in scenes.items()}
    rims = one["a_max_over_R"] * np.array([1.0, 0.4, 1.3, 0.7]) if not kind.unbounded else np.array([0.5, np.inf, 0.2, 1.0])
    first = "closing_ratio" if kind.ratio else "machine_stiffness" if kind.control == "machine" else "A"
    values = np.array([0.0, 1.0, 0.37]) if kind.ratio else one[first] * np.array([1.0, 0.5, 1.2])
    columns = [axis.ravel() for axis in np.meshgrid(values, rims, indexing="ij")]
    points = {n: np.full(12, v) for n, v in one.items()} | {first: columns[0], "a_max_over_R": columns[1]}
    expected = kind.solve(points)
    for shape in ((values[:, None], rims), (values, rims[:, None])):
        grid = kind.solve(one | dict(zip((first, "a_max_over_R"), shape, strict=True)))
        flat = {n: (v if shape[0].ndim == 2 else v.T).ravel() for n, v in grid.items()}
        agree(kind, points, flat, expected)
        same_status(flat, expected)


@pytest.mark.parametrize("name", ["cosine", "sines, machine", "exponent 1.5", "cosine, two works"])
def test_an_exponent_of_its_own_in_every_scene(name: str) -> None:
    kind = BY_NAME[name]
    rng = rng_of(f"exponents {name}")
    scenes = kind.draw(rng, 40, list(np.append(rng.uniform(0.0, 0.97, 60), [0.0, 1.0, 1e-9])))
    found = kind.solve(scenes)
    for i in rng.choice(40, 6, replace=False):
        alone = kind.solve({n: v[i] for n, v in scenes.items()})
        agree(kind, some(scenes, [i]), {n: np.reshape(v, 1) for n, v in alone.items()}, some(found, [i]))


@EVERY
def test_what_is_asked_for_changes_no_value(kind: Kind) -> None:
    scenes, found = drawn(kind)
    rng = rng_of(f"asked {kind.name}")
    for _ in range(4):
        names = [str(name) for name in rng.permutation(kind.outputs)[: rng.integers(1, 4)]]
        asked = kind.solve(some(scenes, slice(50)), names)
        assert set(asked) == {*names, "status"}
        agree(kind, some(scenes, slice(50)), dict(found) | {n: found[n][:50] for n in found} | asked, some(found, slice(50)), names)


@pytest.mark.parametrize("ratio", [0.0, 0.2, 0.5, 0.97])
@pytest.mark.parametrize("name", ["cosine", "two harmonics", "sines, machine", "cosine, load"])
def test_a_ratio_beside_1_and_0(name: str, ratio: float) -> None:
    """An array of ratios that holds 1 or 0 once gave every scene the values of its opening curve."""
    kind = at(BY_NAME[name], ratio=True)
    scenes = some(drawn(BY_NAME[name])[0], slice(30))
    alone = kind.solve(scenes | {"closing_ratio": np.full(30, ratio)})
    for other in (1.0, 0.0, 0.9):
        both = kind.solve(scenes | {"closing_ratio": np.array([[ratio], [other]])})
        agree(kind, scenes | {"closing_ratio": np.full(30, ratio)}, {n: v[0] for n, v in both.items()}, alone)


def test_the_scene_whose_ratio_was_forgotten_beside_1() -> None:
    scene = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.1, "lambda_over_R": 0.1, "A": 0.03}
    kind = Kind("forgotten", ratio=True)
    for ratios in ([0.5], [0.5, 0.9], [0.5, 1.0], [0.5, 0.0, 1.0]):
        found = kind.solve(scene | {"a_max_over_R": 0.5, "closing_ratio": ratios}, ["delta_max", "loading_jumps"])
        assert float(found["delta_max"][0]) == pytest.approx(0.14582587, abs=5e-9)
        assert found["loading_jumps"][0] == 4
