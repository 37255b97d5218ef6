"""Panels of Gauss's rule: they cover a jump without gaps, and each has the nodes that its waves need."""

import math

import numpy as np
import pytest

from gradhesion.core.curve.panels import (
    INNER_PLACES,
    INNER_SHARES,
    PLACES,
    SHARES,
    panel_inwards,
    panel_outwards,
    panels_to_zero,
)

EPS = np.finfo(float).eps


def _outwards(low: float, high: float, shortest: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the places and the weights of all panels between two radii."""
    places, weights = [], []
    while low < high:
        width, beyond, begin, end = panel_outwards(low, high, 0.0, shortest)
        assert beyond > low
        places.append(low + width * PLACES[begin:end])
        weights.append(width * SHARES[begin:end])
        low = beyond
    assert low == high
    return np.concatenate(places), np.concatenate(weights)


@pytest.mark.parametrize("waves", [0.3, 0.8, 1.2, 1.25, 1.8, 2.5, 3.0, 4.2, 7.0, 30.0])
@pytest.mark.parametrize("shortest", [1.0, 3.0, 8.0])
def test_the_square_of_a_wave(waves: float, shortest: float) -> None:
    low, high = 5.0, 5.0 + waves / shortest
    x, weights = _outwards(low, high, shortest)
    assert x.min() > low
    assert x.max() < high
    for phase in (0.0, 0.4, 1.1):
        angle = 4.0 * math.pi * shortest
        true = 0.5 * (high - low) + (math.sin(angle * high + phase) - math.sin(angle * low + phase)) / (2.0 * angle)
        found = float(weights @ (0.5 + 0.5 * np.cos(angle * x + phase)))
        # the phase of a place is rounded by angle * x
        assert found == pytest.approx(true, abs=(4.0 + 0.5 * angle * high) * EPS * (high - low))


def test_nodes_for_each_length() -> None:
    """Longer panels need fewer nodes a wave than short ones."""
    counts = [_outwards(9.0, 9.0 + waves, 1.0)[0].size for waves in (0.5, 1.0, 1.5, 2.0, 4.0, 8.0)]
    assert counts == [12, 16, 20, 24, 32, 64]


@pytest.mark.parametrize("power", [0.25, 0.5, 1.0, 1.7, 3.0])
def test_powers_down_to_zero(power: float) -> None:
    x = 40.0
    high, total = x, 0.0
    inner, growth = panels_to_zero(0.3, 1.0, 0.0, x, 2.0)
    while high > inner:
        low, begin, end = panel_inwards(high, growth, 2.0)
        assert 0.0 < low < high
        total += float((high - low) * SHARES[begin:end] @ (low + (high - low) * PLACES[begin:end]) ** power)
        high = low
    total += float(high * INNER_SHARES @ (high * INNER_PLACES) ** power)
    assert total == pytest.approx(x ** (1.0 + power) / (1.0 + power), rel=16.0 * EPS)


def test_panels_of_a_machine_are_shorter() -> None:
    """Its share of the stiffness has poles beside the panels."""
    inner, growth = panels_to_zero(0.3, 1.0, 0.0, 10.0, 0.0)
    beside, slower = panels_to_zero(0.3, 1.0, 1.0, 10.0, 0.0)
    assert beside < inner
    assert slower < growth
