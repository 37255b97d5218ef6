"""A scene has the values that it has alone: beside any others, in any order, by any number of threads and blocks."""

import numpy as np
import pytest

from .kinds import KINDS, SCENES, Kind, drawn, for_kinds, one_of, rng_of, some
from .promises import NO_VALUE, agree, has

EVERY = for_kinds(KINDS)
NAMES = ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
REACH_FARTHER = {
    "waves still fold where the search for the one ends": [
        [
            (0.76, 0.3806, 243.1, 0.01414, 1.806e-05, 0.0403, 0.9732),
            (0.76, 0.01491, 6.326, 4.729, 1.429e-05, 4.256e-05, np.inf),
        ],
        [
            (0.18, 0.1775, 1.04, 1.952, 1.488e-05, 0.001846, 2.616),
            (0.18, 0.1481, 1.335, 2.572, 1.921e-05, 0.02306, np.inf),
        ],
        [
            (0.76, 0.007996, 77650.0, 0.004449, 5.813e-05, 0.05437, 1.194),
            (0.76, 0.06749, 550.9, 1.902, 1.626e-05, 7.473e-05, np.inf),
        ],
    ],
    "waves so faint that the load has a single trough": [
        [
            (0.32, 0.2972, 40400.0, 0.006701, 0.001735, 1.496e-05, np.inf),
            (0.32, 0.2918, 56740.0, 0.003083, 0.001109, 0.0003233, np.inf),
        ],
        [
            (0.46, 0.2695, 10090.0, 0.07659, 0.003054, 2.722e-05, np.inf),
            (0.46, 0.3448, 17280.0, 0.004058, 0.001156, 0.0001069, 0.3042),
        ],
    ],
}
"""Scenes and neighbours of the same exponent that must be known farther out."""


@EVERY
def test_in_any_order_in_pieces_and_alone_by_any_threads(kind: Kind) -> None:
    scenes, found = drawn(kind)
    order = rng_of(f"order {kind.name}").permutation(found["status"].size)
    for piece in (*np.array_split(order, 3), *order[:4, None]):
        other, twice = (kind.solve(some(scenes, piece), threads=threads) for threads in (1, 2))
        for name in other:
            np.testing.assert_array_equal(other[name], twice[name])  # threads change no bit
        agree(kind, some(scenes, piece), other, some(found, piece), bits=True)


@EVERY
def test_two_neighbours(kind: Kind) -> None:
    """Pairs that differ in one parameter alone, against both alone: what a solver shares between them is not mixed."""
    scenes, found = drawn(kind)
    rng = rng_of(f"pairs {kind.name}")
    for name in scenes:
        first, second = (one_of(scenes, i) for i in rng.choice(found["status"].size, 2, replace=False))
        if name in ("k", "nu") and max(first["k"], second["k"]) > 0.98:
            continue  # only nu = 1/2 has a value there
        own = {n: np.array([first[n], second[n] if n == name else first[n]]) for n in first}
        pair = kind.solve(first | {name: own[name]})
        for i in range(2):
            agree(kind, some(own, [i]), kind.solve(some(own, [i])), some(pair, [i]), bits=True)


@EVERY
def test_a_grid_is_its_points(kind: Kind) -> None:
    """Rims along the last axis share a trace, and other parameters stand before or behind them."""
    scenes, found = drawn(kind)
    one = one_of(scenes, rng_of(f"grid {kind.name}").integers(found["status"].size))
    rims = np.array([0.5, np.inf, 0.2, 1.0]) if kind.unbounded else one["a_max_over_R"] * np.array([1.0, 0.4, 1.3, 0.7])
    first = "closing_ratio" if kind.ratio else "machine_stiffness" if kind.control == "machine" else "A"
    values = np.array([0.0, 1.0, 0.37]) if kind.ratio else one[first] * np.array([1.0, 0.5, 1.2])
    columns = [axis.ravel() for axis in np.meshgrid(values, rims, indexing="ij")]
    points = {n: np.full(12, v) for n, v in one.items()} | {first: columns[0], "a_max_over_R": columns[1]}
    expected = kind.solve(points)
    for outer, inner in ((values[:, None], rims), (values, rims[:, None])):
        grid = kind.solve(one | {first: outer, "a_max_over_R": inner})
        flat = {name: (array if outer.ndim == 2 else array.T).ravel() for name, array in grid.items()}
        agree(kind, points, flat, expected, bits=True)


@EVERY
def test_what_is_asked_for_changes_no_value(kind: Kind) -> None:
    scenes, found = (some(values, slice(SCENES // 2)) for values in drawn(kind))
    names = [name for name in kind.outputs if name != "contact_slope"]  # it is that of what else is asked for
    order = [str(name) for name in rng_of(f"asked {kind.name}").permutation(names)]
    alone = ["pull_off_force", "pull_off_radius", "turning_radius"]  # need no cycle; of short waves one without value
    where = (kind.solver != "asymptotic") | ~has(found, NO_VALUE)
    for few in (order[:3], order[3:6], order[6:9], order[9:], alone):
        asked = kind.solve(scenes, few)
        assert set(asked) == {*few, "status"}
        agree(kind, scenes, found | asked, found, few, where=where)


@pytest.mark.parametrize("why", REACH_FARTHER)
def test_a_neighbour_that_reaches_farther_changes_no_bit(why: str) -> None:
    for pair in REACH_FARTHER[why]:
        scenes = dict(zip(NAMES, np.array(pair).T, strict=True))
        found, alone = KINDS[0].solve(scenes), KINDS[0].solve(some(scenes, [0]))
        for name in found:
            np.testing.assert_array_equal(alone[name], found[name][:1], err_msg=name)
