"""All benchmarks, or some parts: prints them; all of them are written into docs/benchmarks.md, with two figures."""

import argparse
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime

from benchmarks import cost, draw, error, expert, loop_fits, measured_loops, one_scene, scenes, start_up, study
from benchmarks.clock import ROOT, machine

REPORT = ROOT / "docs" / "benchmarks.md"
PARTS = ("error", "expert", "scenes", "cost", "one_scene", "fits", "study", "start_up")


def sections(parts: Sequence[str], *, quick: bool) -> Iterator[str]:
    """Yield the report on some parts, section by section."""
    yield f"""# Benchmarks

Written by `make bench` on {datetime.now(UTC):%Y-%m-%d}, all numbers from one run: {machine()}
Times are minima of several samples, on one thread unless stated.
"""
    if "error" in parts:
        points = error.measure(8 if quick else 24, error.SIZES[:6] if quick else error.SIZES)
        error.picture(*points)
        yield f"""## Run time against error

The solvers and a dense grid (`benchmarks/dense_grid.py`: two SciPy Struve functions on a grid of radii, running maximum
and minimum of the depth, trapezoids) on the same random scenes, whose values are known to 30 digits (`tests/twin`).
Each solver is given copies of the scenes in one shuffled array, each solved separately. Errors are relative: median
and 90th percentile over the scenes; the time of the grid at a given error is interpolated between two sizes. The
asymptotic and envelope solvers are approximations for short waves; the scenes have waves of all lengths, so that their
errors are large here.

Aims: 10^6 times faster than the grid for the force at 1e-7, 10^4 times for the energy at 1e-4. The grid gains two
digits of the energy for one of the number of radii, while the exact energy needs an integral for each jump of the path,
to all digits: this limits the second ratio.

{error.tables(*points)}
![Run time against error](figures/time_against_error.png)
"""
    if "expert" in parts:
        yield f"""## Against the script of an expert

`benchmarks/expert_script.py` is what an expert would write: compiled by numba, one thread, polynomials of both
functions for each k, folds found by a scan and Newton's steps, Gauss's rule over the jumps. For each error it is given
the quickest setting whose worst scene of a call keeps that error (`benchmarks/expert.py`); a scan that is too coarse
misses folds. Its tables, its compilation and the stiffness of its materials are not timed; calls of gradhesion are
timed whole, with the test of whether contact is one disc. Processor time on one thread, us a scene. Aims: 1.5 times for
the force and 3 times for the energy at 1e-6 in calls of 200 scenes; 2 and 4.5 times in calls of 20,000.

{expert.expert_table(repeat=3 if quick else 9)}"""
    if "scenes" in parts:
        yield f"""## Scenes

Random scenes, each on a curve of its own, in one call of `gradhesion.core.solve`: lambda/L from 0.06 to 2, r/s from 0
to 1.5, a_max/L from 1 to 4, k one of {", ".join(map(str, draw.EXPONENTS))}. L = (R^2 dgamma/M)^(1/(3+k)) is the
length of the contact, r/s the fraction of the adhesion that short waves remove or add (`core/closed/envelope.py`).

Aims: 0.6 us for the force, 5 us for both, 0.05 us if the punch is smooth. Long waves cause few jumps, short ones
many, and the cost of the energy is that of the jumps. Of smooth scenes whose k, nu or c0 differ, most of the time is
that of the stiffness.

{scenes.mixture_table(100_000 if quick else 1_000_000)}"""
        by_waves, waves = scenes.waves_table()
        yield f"""### Growth with the number of waves

k = 0.3, nu = 0.3, E* R/dgamma = 500, c0/R = 0.01, a_max = R, the wavelength alone varied: once at fixed A, once at
fixed r/s. The folds of these scenes persist to the rim, so that the jumps grow with the waves. Aim: 3 times at most.
Short curves are traced wave by wave, long ones only in the first, the last and some waves in between.

{by_waves}"""
        by_rims, rims = scenes.rims_table()
        yield f"""### Many rims on one curve

The same scene with lambda/R = 0.02, r/s = 0.8. Aim: 100 rims cost 1.5 times one at most. The trace is
shared; its end at the rim and the last jump are computed for each rim.

{by_rims}"""
        scenes.picture(waves, rims, scenes.numbers())
        yield "![Cost against the number of waves, of scenes and of rims](figures/cost.png)\n"
    if "cost" in parts:
        yield f"""### Classes of scenes

Processor time of a scene in calls of 20,000 random scenes (`benchmarks/cost.py`; fewer of dear ones), the first row the
first mixture above: force, force and energy, and either with its sensitivities to all parameters, including k. Aims:
other controls 3 times one cosine, exponent 1.5 five times, two harmonics ten and eight 25 times; a k of its own in
every scene 3 times for the force and twice for both; sensitivities at most four times what the values cost.

{cost.cost_table(cost.measured(2000 if quick else 20_000))}"""
    if "one_scene" in parts:
        yield f"""### One scene in Python

Force and energy of one scene, processor time: plain arrays, and a dataset with its study. Aim: 3 times at most.

{one_scene.calls_table()}"""
    if "fits" in parts:
        yield f"""### Fits of measured loops

Six unknowns, {measured_loops.POINTS:,} points, one thread. Aim: 2 s.

{loop_fits.times_table(2 if quick else 12)}"""
    if "study" in parts:
        yield f"""### Studies of any size

The same five axes with more and more values, warm, from the command to the closed file, and `gradhesion.core.solve`
alone on their scenes. Aims: 20 s and 1 GiB for ten million, and memory that does not grow with their number.

{study.study_table(10**5 if quick else 10**7)}"""
    if "start_up" in parts:
        yield f"""## Start-up

Medians, except what is done once. Aims: 0.15, 0.25, 0.6, 0.4, 6, 12, 6, 40 s.

{start_up.start_up_table()}"""


def main() -> None:
    """Run all, or the parts that are named; a quick run prints the report and does not write it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("parts", nargs="*", help=f"of {', '.join(PARTS)} [all, and the report is written]")
    parser.add_argument("--quick", action="store_true", help="fewer scenes, no large study, and no report written")
    arguments = parser.parse_args()
    if unknown := {*arguments.parts} - {*PARTS}:
        parser.error(f"{', '.join(unknown)}: there is {', '.join(PARTS)}")
    written = []
    for section in sections(arguments.parts or PARTS, quick=arguments.quick):
        print(section, flush=True)
        written.append(section)
    if not (arguments.parts or arguments.quick):
        REPORT.write_text("\n".join(written))


if __name__ == "__main__":
    main()
