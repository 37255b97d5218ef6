"""What the tests of the core share: the reference of the universal pair, tables, and a slow pair of any precision."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from tests.core.slow_truth import Truth

REFERENCE = Path(__file__).parents[1] / "reference"


@pytest.fixture(scope="session")
def table_of() -> Callable[[float], Any]:
    """Give the table of an exponent, made once."""
    from gradhesion.core.arrays.tables import table_of

    return table_of


@pytest.fixture(scope="session")
def struve_rows() -> NDArray[np.float64]:
    """7,676 rows: k, x, the four functions as high and low doubles, the amplitudes of S0 and S1."""
    with np.load(REFERENCE / "struve.npz") as file:
        rows: NDArray[np.float64] = file["table"]
    return rows


@pytest.fixture(scope="session")
def pair_error(struve_rows: NDArray[np.float64]) -> Callable[..., NDArray[np.float64]]:
    """Give the amplitude-relative errors, of shape (4, points), of values at the points x of one k."""

    def error(k: float, x: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        of_k = struve_rows[struve_rows[:, 0] == k]
        rows = of_k[np.argsort(of_k[:, 1])]
        rows = rows[np.searchsorted(rows[:, 1], x)]
        assert np.array_equal(rows[:, 1], x)
        z = 2.0 * math.pi * x
        with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
            sizes = np.array(
                [
                    rows[:, 10],
                    rows[:, 11],
                    z * rows[:, 11] / (k + 1.0),
                    ((k + 1.0) * rows[:, 10] + (k + 2.0) * rows[:, 11]) / z,
                ]
            )
        high, low = rows[:, 2:10:2].T, rows[:, 3:11:2].T
        sizes = np.where(z < 1.5, np.abs(high), np.maximum(np.abs(high), sizes))
        difference = np.abs((values - high) - low)
        relative: NDArray[np.float64] = np.divide(difference, sizes, out=difference.copy(), where=sizes > 0.0)
        return relative

    return error


def _s0(k: mpmath.mpf, z: mpmath.mpf) -> mpmath.mpf:
    return z / (1 + k) * mpmath.hyp1f2(1, mpmath.mpf(3) / 2, (3 + k) / 2, -z * z / 4)


def _s1(k: mpmath.mpf, z: mpmath.mpf) -> mpmath.mpf:
    return _s0(k + 2, z)


@pytest.fixture(scope="session")
def slow_pair() -> Callable[[float, float], tuple[mpmath.mpf, mpmath.mpf]]:
    """Give S0 and S1 by hypergeometric series, S_j(k, z) = S_0(k + 2 j, z), at the precision of mpmath."""

    def pair(k: float, z: float) -> tuple[mpmath.mpf, mpmath.mpf]:
        return _s0(mpmath.mpf(k), mpmath.mpf(z)), _s1(mpmath.mpf(k), mpmath.mpf(z))

    return pair


@pytest.fixture(autouse=True)
def digits() -> Any:
    """Every test starts at 30 digits."""
    with mpmath.workdps(30):
        yield


@pytest.fixture
def scene() -> dict[str, float]:
    """A scene off every round number, with several jumps both ways."""
    return {
        "k": 0.31,
        "nu": 0.27,
        "modulus": 1730.0,
        "c0_over_R": 0.037,
        "lambda_over_R": 0.043,
        "A": 0.0137,
        "a_max_over_R": 0.47,
    }


@pytest.fixture(scope="session")
def truth() -> type[Truth]:
    """Give the slow truth about the contact of any profile."""
    return Truth
