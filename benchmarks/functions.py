"""The universal pair and its derivatives: time and error, against SciPy and mpmath on the same points."""

import argparse
import math
from typing import Any

import mpmath
import numpy as np
from numpy.typing import NDArray
from scipy.special import gamma, struve

from benchmarks.clock import ROOT, seconds_of, table
from gradhesion.core.struve.table import _pairs, build_table  # the loop itself, without the table of each call

RANGES = [(0.0, 1.0), (1.0, 10.0), (10.0, 40.0), (40.0, 1e3), (1e3, 6.3e6)]
EPS = float(np.finfo(float).eps)
SAMPLE = 40
"""Points a range for mpmath, which takes a millisecond for each."""

Values = NDArray[np.float64]


def by_table(k: float, x: Values) -> Values:
    """Evaluate S0, S1, S0', S1' by the table of k."""
    out = np.empty((4, x.size))
    _pairs(build_table(k), x, out)
    return out


def by_scipy(k: float, x: Values) -> Values:
    """Evaluate S0, S1 by two Struve functions."""
    z = 2 * np.pi * x
    half = math.sqrt(math.pi) / 2
    with np.errstate(all="ignore"):
        s0 = half * gamma((1 + k) / 2) * (z / 2) ** (-k / 2) * struve(k / 2, z)
        s1 = half * gamma((3 + k) / 2) * (z / 2) ** (-1 - k / 2) * struve(1 + k / 2, z)
    return np.array([s0, s1])


def by_mpmath(k: float, x: Values) -> Values:
    """Evaluate S0, S1 by two Struve functions with 16 digits, the phase exact."""
    pairs = []
    for value in x.tolist():
        with mpmath.workdps(30):
            z = 2 * mpmath.pi * value
        half = mpmath.sqrt(mpmath.pi) / 2
        s0 = half * mpmath.gamma((1 + k) / 2) * (z / 2) ** (-k / 2) * mpmath.struveh(k / 2, z)
        s1 = half * mpmath.gamma((3 + k) / 2) * (z / 2) ** (-1 - k / 2) * mpmath.struveh(1 + k / 2, z)
        pairs.append((float(s0), float(s1)))
    return np.array(pairs).T


def errors(values: Values, rows: Values, first: int = 0) -> Values:
    """Return the errors in eps: of the function below z = 1.5, of it or its amplitude, the larger, beyond."""
    k, z = rows[:, 0], 2 * np.pi * rows[:, 1]
    high, low, a0, a1 = rows[:, 2:10:2].T, rows[:, 3:10:2].T, rows[:, 10], rows[:, 11]
    with np.errstate(all="ignore"):
        amplitudes = np.array([a0, a1, z * a1 / (k + 1), ((k + 1) * a0 + (k + 2) * a1) / z])
    scale = np.maximum(np.abs(high), np.where(z >= 1.5, amplitudes, 0))
    chosen = slice(first, first + len(values))
    return np.abs((values - high[chosen]) - low[chosen]) / scale[chosen] / EPS


def solved(evaluate: Any, rows: Values) -> Values:
    """Evaluate the rows, one exponent after the other."""
    order = np.argsort(rows[:, 0], kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(rows[order, 0])) + 1)
    values = [evaluate(float(rows[group[0], 0]), np.ascontiguousarray(rows[group, 1])) for group in groups]
    return np.concatenate(values, axis=1)[:, np.argsort(order)]


def max_and_mean(error: Values) -> str:
    """Return the largest and the mean error, and the number of NaNs."""
    missing = int(np.isnan(error).any(axis=0).sum())
    found = error[np.isfinite(error)]
    return f"{found.max():.2g} ({found.mean():.2g})" + (f", {missing} NaN" if missing else "")


def error_table() -> str:
    """Return max (mean) error in eps by range of z."""
    reference = np.load(ROOT / "tests" / "reference" / "struve.npz")["table"]
    z = 2 * np.pi * reference[:, 1]
    rng = np.random.default_rng(1)
    lines = []
    for low, high in RANGES:
        rows = reference[(z > low) & (z <= high)]
        few = rows[rng.choice(len(rows), min(SAMPLE, len(rows)), replace=False)]
        ours = solved(by_table, rows)
        found = [errors(ours[:2], rows), errors(ours[2:], rows, 2), errors(solved(by_scipy, rows), rows)]
        found.append(errors(solved(by_mpmath, few), few))
        lines.append([f"{low:g} to {high:g}", len(rows), *map(max_and_mean, found)])
    ours_and_others = ["S0, S1", "S0', S1'", "SciPy S0, S1", f"mpmath S0, S1 ({SAMPLE} points)"]
    return table(["z", "points", *ours_and_others], lines)


def time_table(k: float = 0.37) -> str:
    """Return ns a point, of the four functions here and of S0 and S1 alone elsewhere, and the time of a table."""
    rng = np.random.default_rng(2)
    record = build_table(k)
    lines = []
    for name, z in [
        ("0 to 40", rng.uniform(0, 40, 100_000)),
        ("40 to 1e6", 10 ** rng.uniform(math.log10(40), 6, 100_000)),
    ]:
        x = z / (2 * np.pi)
        out = np.empty((4, x.size))
        ours = seconds_of(lambda x=x, out=out: _pairs(record, x, out), repeat=15) / x.size
        scipy = seconds_of(lambda x=x: by_scipy(k, x[:4000]), repeat=3) / 4000
        slow = seconds_of(lambda x=x: by_mpmath(k, x[:60]), repeat=1) / 60
        lines.append([name, 1e9 * ours, 1e9 * scipy, 1e9 * slow, scipy / ours, slow / ours])
    header = ["z", "gradhesion, ns", "SciPy, ns", "mpmath, ns", "SciPy/gradhesion", "mpmath/gradhesion"]
    one = seconds_of(lambda: build_table(k), repeat=25)
    return table(header, lines) + f"\nThe table of one exponent: {1e3 * one:.2f} ms, {record.nbytes / 1e3:.0f} kB.\n"


def main() -> None:
    """Print both tables."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    print(time_table())
    print(error_table())


if __name__ == "__main__":
    main()
