"""The cost of the test whether the contact is one disc, and how many scenes need its integral."""

import math
from typing import Any

import numpy as np

from benchmarks.clock import seconds_of, table
from benchmarks.draw import mixture
from gradhesion.core import solve
from gradhesion.core.arrays.tables import table_of
from gradhesion.core.contact import disc as contact
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.curve.cosine import curve_of
from gradhesion.core.path.cosine import extent, is_long, walk
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC

BOTH = ("pull_off_force", "dissipated_energy")


def integrals(scenes: dict[str, Any]) -> float:
    """Return the share of scenes for which an integral of the gap is taken (the kernels run as plain Python)."""
    calls = [0]
    compiled, limits = contact.jump_is_one_disc, contact.limits_from

    def counted(*arguments: Any) -> bool:
        calls[0] += arguments[2] > 0.0  # from zero contact nothing is integrated
        return bool(compiled(*arguments))

    needed, number = 0, scenes["k"].size
    contact.jump_is_one_disc, contact.limits_from = counted, limits.py_func
    try:
        for i in range(number):
            one = {name: float(np.broadcast_to(values, number)[i]) for name, values in scenes.items()}
            k, wavelength = one["k"], one["lambda_over_R"]
            stretch = math.sqrt(
                2 ** (1 + k) * math.pi / float(stiffness(k, one["nu"], one["modulus"], one["c0_over_R"]))
            )
            curve, _, _ = curve_of(k, stretch, wavelength, one["A"] * wavelength)
            arches, rim = extent(table_of(k), curve), one["a_max_over_R"] / wavelength
            if curve[1] == 0.0 or is_long(table_of(k), arches, rim):
                continue
            count, trace = walk(table_of(k), curve, arches, rim, np.empty((ROWS, 400)), False)  # noqa: FBT003
            before = calls[0]
            contact.disc_limits.py_func(np.array(table_of(k)).view(np.recarray)[()], curve, count, trace, rim)
            needed += calls[0] > before
    finally:
        contact.jump_is_one_disc, contact.limits_from = compiled, limits
    return needed / number


def contact_table(number: int = 200_000, sample: int = 2000) -> str:
    """Return cost and shares on both mixtures."""
    lines = []
    for name, spacing in [("log-uniform lambda/L", "log"), ("uniform lambda/L", "linear")]:
        scenes = mixture(number, spacing)
        without, with_it = math.inf, math.inf
        for _ in range(9):  # in turns, for a machine that others use too
            without = min(
                without, seconds_of(lambda s=scenes: solve(s, BOTH, check_contact=False, threads=1), repeat=1)
            )
            with_it = min(with_it, seconds_of(lambda s=scenes: solve(s, BOTH, threads=1), repeat=1))
        flagged = np.mean((solve(scenes, BOTH)["status"] & LOADING_NOT_ONE_DISC) != 0)
        share = integrals(mixture(sample, spacing))
        lines.append([name, f"{100 * (with_it / without - 1):.0f} %", f"{100 * share:.0f} %", f"{100 * flagged:.0f} %"])
    header = ["force and energy", "the test costs", "scenes that take the integral", "not one disc on loading"]
    return table(header, lines)
