"""A Pareto front holds the points that no other one excels, and no more."""

import numpy as np

from gradhesion.core.answers.optimum_front import front


def test_no_point_of_a_front_is_excelled_and_every_other_is() -> None:
    first, second = np.random.default_rng(4).normal(size=(2, 300)).round(1)
    second[7] = np.nan
    chosen = front([first, second])
    for i in range(300):
        excelled = np.any((first >= first[i]) & (second >= second[i]) & ((first > first[i]) | (second > second[i])))
        if i in chosen:
            assert not excelled
        elif i != 7:
            alike = np.any((first[chosen] == first[i]) & (second[chosen] == second[i]))
            assert excelled or alike
    assert np.all(np.diff(first[chosen]) < 0.0)
    assert np.all(np.diff(second[chosen]) > 0.0)
