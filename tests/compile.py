"""Compile the kernels that most tests need, each once: processes that run tests side by side would compile them twice.

`python -m tests.compile wave` and `python -m tests.compile any` share the work.
"""

import argparse
from typing import Any

import numpy as np

from gradhesion.core import OUTPUTS, REPORTS, Loading, Profile, draw_curves, solve

SCENE: dict[str, Any] = {"k": 0.3, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "lambda_over_R": 0.1, "A": 0.03}
SCENE |= {"a_max_over_R": 0.5}


def wave() -> None:
    """Compile what one cosine wave under displacement control needs."""
    solve(SCENE, (*OUTPUTS, *REPORTS))
    for solver in ("envelope", "asymptotic"):
        solve(SCENE, solver=solver)
    draw_curves(SCENE, ["equilibrium", "path", "asymptotic", "envelope", "effective", "smooth", "jumps"])


def any_profile() -> None:
    """Compile what any other profile or control needs."""
    profile, loading = Profile(exponent=2.5), Loading(control="machine")
    scene = SCENE | {"machine_stiffness": np.array(3.0)}
    solve(scene, (*OUTPUTS, *REPORTS), profile=profile, loading=loading)
    draw_curves(SCENE | {"machine_stiffness": 3.0}, ["equilibrium", "path", "smooth", "jumps"], profile, loading)


def main() -> None:
    """Compile one half."""
    parser = argparse.ArgumentParser(prog="python -m tests.compile", description=__doc__)
    parser.add_argument("half", choices=["wave", "any"])
    {"wave": wave, "any": any_profile}[parser.parse_args().half]()


if __name__ == "__main__":
    main()
