"""Are fits of loops right, or do they say they are not? `python -m benchmarks.loop_fits [LOOPS] [SEED] [--kind ...]`.

Loops as instruments give them (`benchmarks.measured_loops`), each fitted over wide ranges. A fit is right where every
value is within `FAR` standard deviations of the truth. One that is not says so where it is flagged: `poor_fit`, a
number on a bound, or another minimum that is named. Prints how often the 95 % intervals hold the truth, what went
wrong and unflagged, with the misfit of the truth beside that of the fit, and the time. `--only N` fits one loop.
"""

import argparse
import os
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import Any, Final

import numpy as np
from scipy.stats import binom

from benchmarks.clock import table
from benchmarks.measured_loops import POINTS, WORDS, Loop, draw_loop
from gradhesion.core.loops.fit import fit_loop
from gradhesion.core.loops.fitted import FittedLoop, Offsets
from gradhesion.core.problem.status import ANOTHER_MINIMUM, POOR_FIT

FAR: Final = 5.0
"""Standard deviations that a value is off by where a fit is wrong."""
SLACK: Final = 15.0
"""What the misfit of the truth may be above that of a fit which is another minimum as good."""


def fit(loop: Loop, intervals: str = "profile") -> FittedLoop:
    """Fit a loop."""
    offsets = Offsets(slope="load_slope" in loop.true)
    points = (loop.depth, loop.load, loop.unloading)
    return fit_loop(*points, loop.fixed, loop.free, noise=loop.noise, offsets=offsets, intervals=intervals)


def flags_of(found: FittedLoop) -> list[str]:
    """Return what a fit says against itself."""
    flags = [f"on bound: {name}" for name in found.on_bound]
    flags += ["poor fit"] if found.status & POOR_FIT else []
    flags += ["another minimum"] if found.status & ANOTHER_MINIMUM else []
    return flags if found.converged else [*flags, "not converged"]


def judged(number: int, seed: int, kind: str, points: int = POINTS, intervals: str = "profile") -> dict[str, Any]:
    """Draw a loop by its number, fit it, and judge the fit."""
    loop = draw_loop(seed, number, kind, points)
    row: dict[str, Any] = {"number": number, "true": loop.true, "fixed": loop.fixed, "turned": loop.turned}
    row |= {"best": loop.chi_square(), "size": loop.depth.size}
    start = time.perf_counter()
    try:
        found = fit(loop, intervals)
    except ValueError as error:
        return row | {"seconds": time.perf_counter() - start, "refused": str(error)}
    seconds = time.perf_counter() - start
    values, deviations = found.values, found.standard_deviations
    names = [name for name in loop.true if name in values]
    off = {name: (values[name] - loop.true[name]) / max(deviations[name], 1e-300) for name in names}
    others = [other.values for other in found.others]
    return row | {
        "seconds": seconds,
        "values": values,
        "off": off,
        "held": {name: bool(found.low[name] <= loop.true[name] <= found.high[name]) for name in names},
        "chi": found.chi_square,
        "flags": flags_of(found),
        "right": all(abs(each) < FAR for each in off.values()),
        "named": any(all(abs(one[n] - loop.true[n]) < FAR * deviations[n] for n in names) for one in others),
    }


def verdict(row: dict[str, Any]) -> str:
    """Say in a word what became of a fit."""
    if "refused" in row:
        return "refused"
    if row["right"]:
        return "right, flagged" if row["flags"] else "right"
    if row["flags"]:
        return "wrong, truth named" if row["named"] else "wrong, flagged"
    return "wrong, worse than the truth" if row["chi"] > row["best"] + SLACK else "wrong, as good as the truth"


def lines(rows: list[dict[str, Any]]) -> Iterator[str]:
    """Report coverage, verdicts, time, and each loop that is wrong and says nothing."""
    kinds = [verdict(row) for row in rows]
    count = len(rows)
    yield table(["of", "right", *(kinds_ := sorted(set(kinds) - {"right"}))],
                [[count, kinds.count("right"), *map(kinds.count, kinds_)]])  # fmt: skip
    fitted = [row for row, kind in zip(rows, kinds, strict=True) if kind != "refused"]
    good = [row for row, kind in zip(rows, kinds, strict=True) if kind == "right"]
    names = list(dict.fromkeys(name for row in fitted for name in row["off"]))
    few, many = (binom.ppf(q, max(1, len(good)), 0.95) / max(1, len(good)) for q in (0.025, 0.975))
    yield f"Intervals that hold the truth; chance gives {few:.1%} to {many:.1%} in the {len(good)} right fits:"
    yield table(["", "all", "not flagged", "right", "mean error (sd)", "its spread (sd)"],
                [_coverage(name, fitted, good) for name in names])  # fmt: skip
    seconds = np.array([row["seconds"] for row in rows])
    half, most, longest = np.quantile(seconds, [0.5, 0.95, 1.0])
    yield f"Seconds a loop: median {half:.2f}, 95 % below {most:.2f}, longest {longest:.2f}."
    for row, kind in zip(rows, kinds, strict=True):
        if kind == "refused" or (kind.startswith("wrong") and not row["flags"]):
            yield told(row, kind)


def told(row: dict[str, Any], kind: str) -> str:
    """Return a paragraph on a loop."""
    fixed = ", ".join(f"{name} {value:.4g}" for name, value in row["fixed"].items())
    head = f"- loop {row['number']}: {kind}; {fixed}, {row['turned']:.3g} pull-off forces, {row['seconds']:.2f} s"
    if "refused" in row:
        return f"{head}\n  {row['refused']}"
    each = [f"{name} {row['true'][name]:.4g} -> {row['values'][name]:.4g} ({off:+.2g} sd)"
            for name, off in row["off"].items()]  # fmt: skip
    said = f"; {', '.join(row['flags'])}" if row["flags"] else ""
    misfits = f"chi square {row['chi']:.6g}, of the truth {row['best']:.6g}, {row['size']} points{said}"
    return f"{head}\n  {misfits}\n  {'; '.join(each)}"


def _coverage(name: str, fitted: list[dict[str, Any]], good: list[dict[str, Any]]) -> list[str]:
    """Return a row: how often the interval of a name holds the truth."""
    cells = [name]
    for rows in (fitted, [row for row in fitted if not row["flags"]], good):
        held = [row["held"][name] for row in rows if name in row["held"]]
        cells.append(f"{np.mean(held):.1%}" if held else "-")
    off = np.array([row["off"][name] for row in good if name in row["off"]])
    return [*cells, f"{off.mean():+.2f}", f"{off.std():.2f}"] if off.size else [*cells, "-", "-"]


def times_table(loops: int, seed: int = 5) -> str:
    """Return how long fits of drawn loops take, one after the other."""
    judged(0, seed, "wavy")  # compiles
    rows = []
    for kind in ("smooth", "wavy"):
        for way in ("linear", "profile"):
            times = [judged(number, seed, kind, intervals=way)["seconds"] for number in range(loops)]
            rows.append([kind, f"{way} intervals", *np.quantile(times, [0.5, 1.0]).tolist()])
    return table([f"{loops} loops of each kind", "", "median, s", "longest, s"], rows)


def main() -> None:
    """Fit loops and report."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.loop_fits", description=__doc__)
    parser.add_argument("loops", nargs="?", type=int, default=1000)
    parser.add_argument("seed", nargs="?", type=int, default=2026)
    parser.add_argument("--kind", default="wavy", help=f'words joined by "+": {", ".join(WORDS)}')
    parser.add_argument("--intervals", default="profile", choices=["profile", "linear"])
    parser.add_argument("--points", type=int, default=POINTS)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--only", type=int, help="the number of one loop")
    chosen = parser.parse_args()
    one = partial(judged, seed=chosen.seed, kind=chosen.kind, points=chosen.points, intervals=chosen.intervals)
    if chosen.only is not None:
        row = one(chosen.only)
        print(told(row, verdict(row)))
        return
    one(0)  # compiles
    with ProcessPoolExecutor(chosen.workers) as pool:
        rows = list(pool.map(one, range(chosen.loops)))
    print(f"{chosen.loops:,} loops, {chosen.kind}, seed {chosen.seed}")
    print(*lines(rows), sep="\n")


if __name__ == "__main__":
    main()
