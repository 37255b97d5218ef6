"""Fits of smooth punches against a script of SciPy alone: `python -m benchmarks.scipy_jkr [BRANCHES] [SEED]`.

Approach, retraction, or both of a smooth ball (`benchmarks/jkr_script.py`), contact anywhere in the data. The script
and `fit_loop` get the same points, noise and bounds: E* and the work of adhesion within two decades, the zero of depth
anywhere in the data, the zero of load within 10 pull-off forces. Both minima are compared by the misfit of the script:
one of `fit_loop` above the script's is a fit that went wrong.
"""

import argparse
import os
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import Any

import numpy as np

from benchmarks.clock import table
from benchmarks.jkr_script import BRANCHES, NAMES, Branch, Misfit, draw, refined, scipy_fit
from benchmarks.loop_fits import flags_of
from gradhesion.core.loops.fit import fit_loop
from gradhesion.core.loops.fitted import FittedLoop
from gradhesion.core.loops.paths.offsets import Offsets


def fit(branch: Branch) -> FittedLoop:
    """Fit a branch by gradhesion, with the same points, noise and bounds."""
    free = {name: (branch.low[i], branch.high[i]) for i, name in enumerate(NAMES[:2])}
    fixed = {"k": 0.0, "nu": 0.3, "R": branch.R, "A": 0.0}
    offsets = Offsets(load=(branch.low[3], branch.high[3]))
    return fit_loop(branch.depth, branch.load, branch.unloading, fixed, free, noise=branch.noise, offsets=offsets)


def compared(number: int, seed: int) -> dict[str, Any]:
    """Fit a branch both ways."""
    branch = draw(seed, number)
    misfit = Misfit(branch)
    start = time.perf_counter()
    values, sd, least = scipy_fit(branch)
    row: dict[str, Any] = {"number": number, "true": branch.true, "scipy": values, "sd": sd, "least": least}
    row["truth"] = float(np.sum(misfit.residual(misfit.vector(branch.true)) ** 2))
    middle = time.perf_counter()
    try:
        found = fit(branch)
    except ValueError as error:
        return row | {"refused": str(error), "seconds": (middle - start, time.perf_counter() - middle)}
    ours = np.array([found.values[name] for name in NAMES])
    unit = np.array([values[0], values[1], 1.0, 1.0])
    size = np.array([found.standard_deviations[name] for name in NAMES]) / unit
    again = refined(misfit, misfit.vector(ours), 400)
    return row | {
        "seconds": (middle - start, time.perf_counter() - middle),
        "ours": ours,
        "ours_sd": size,
        "apart": (ours - values) / unit / sd,
        "relative": np.abs(ours / values - 1.0),
        "stated": found.chi_square,
        "misfit": float(np.sum(misfit.residual(misfit.vector(ours)) ** 2)),
        "near": 2.0 * float(again.cost),
        "flags": flags_of(found),
    }


def lines(rows: list[dict[str, Any]]) -> Iterator[str]:
    """Report how often both agree."""
    done = [row for row in rows if "ours" in row]
    equal = [bool(np.all((row["relative"] < 0.01) | (np.abs(row["apart"]) < 0.1))) for row in done]
    above = [row for row in done if row["misfit"] > row["least"] * (1.0 + 1e-6)]
    below = [row for row in done if row["misfit"] < row["least"] * (1.0 - 1e-6)]
    stated = [abs(row["stated"] / row["misfit"] - 1.0) for row in done]
    sds = np.array([np.max(np.abs(row["ours_sd"] / row["sd"] - 1.0)) for row in done])
    yield table(
        ["branches", "refused", "equal", "misfit above SciPy's", "below", "stated misfit off, median", "largest",
         "standard deviations off, median"],
        [[len(rows), len(rows) - len(done), sum(equal), len(above), len(below), float(np.median(stated)),
          float(np.max(stated)), float(np.median(sds))]],
    )  # fmt: skip
    times = np.array([row["seconds"] for row in rows])
    yield f"Seconds, median: SciPy {np.median(times[:, 0]):.2f}, gradhesion {np.median(times[:, 1]):.2f}."
    for row in rows:
        kind = BRANCHES[row["number"] % 3]
        if "refused" in row:
            yield f"- {row['number']} ({kind}): refused: {row['refused']}"
    for row, same in zip(done, equal, strict=True):
        if not same or row["misfit"] > row["least"] * (1.0 + 1e-6):
            each = [f"{name} {t:.4g}: {s:.4g}, {o:.4g} ({d:+.2g} sd)" for name, t, s, o, d in
                    zip(NAMES, row["true"], row["scipy"], row["ours"], row["apart"], strict=True)]  # fmt: skip
            kind = BRANCHES[row["number"] % 3]
            yield f"- {row['number']} ({kind}): misfit of SciPy {row['least']:.8g}, of the fit {row['misfit']:.8g}"
            yield f"  (stated {row['stated']:.8g}; refined from there {row['near']:.8g}; truth {row['truth']:.8g})"
            yield f"  flags: {', '.join(row['flags']) or 'none'}"
            yield f"  true: SciPy, the fit: {'; '.join(each)}"


def main() -> None:
    """Compare and report."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.scipy_jkr", description=__doc__)
    parser.add_argument("branches", nargs="?", type=int, default=100)
    parser.add_argument("seed", nargs="?", type=int, default=2026)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--only", type=int, help="the number of one branch")
    chosen = parser.parse_args()
    one = partial(compared, seed=chosen.seed)
    numbers = range(chosen.branches) if chosen.only is None else [chosen.only]
    with ProcessPoolExecutor(chosen.workers) as pool:
        print(*lines(list(pool.map(one, numbers))), sep="\n")


if __name__ == "__main__":
    main()
