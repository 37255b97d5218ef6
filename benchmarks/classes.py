"""The cost of other controls, profiles and exponents, and of what shares a curve: `python -m benchmarks.classes`."""

import argparse
from typing import Any

import numpy as np

from benchmarks.clock import table
from benchmarks.draw import C0, NU, Parameters, mixture
from benchmarks.scenes import BOTH, microseconds
from gradhesion.core import Harmonic, Loading, Profile, solve

MANY = 100
"""Radii, or depths, on one curve."""
PAIR = Profile(harmonics=(Harmonic(n=1), Harmonic(n=3, cos=0.2)))
PUNCHES = {
    "exponent 1.5": Profile(exponent=1.5),
    "exponent 2, series of two": PAIR,
    "exponent 3": Profile(exponent=3.0),
    "exponent 2, eight harmonics": Profile(harmonics=tuple(Harmonic(n=n, cos=n**-2.0) for n in range(1, 9))),
}


def controls_table(number: int = 4000) -> str:
    """Return the time of a scene of one cosine under each control, over that under displacement control."""
    lines = []
    for name, spacing in [("log-uniform lambda/L", "log"), ("uniform lambda/L", "linear")]:
        scenes = mixture(number, spacing)
        springs = {**scenes, "machine_stiffness": 10.0 ** np.random.default_rng(4).uniform(-3.0, 0.0, number)}
        for outputs, what in ((BOTH[:1], "force"), (BOTH, "force and energy")):
            plain = microseconds(scenes, outputs)
            load, machine = (
                microseconds(of, outputs, loading=Loading(control=control))
                for of, control in ((scenes, "load"), (springs, "machine"))
            )
            lines.append([f"{name}, {what}", plain, load / plain, machine / plain])
    return table(["one thread", "displacement, us", "load: times", "machine: times"], lines)


def exponents_table(number: int = 20_000) -> str:
    """Return the time of a scene with a k of its own, over that with one k."""
    rng, lines = np.random.default_rng(5), []
    for name, spacing in [("log-uniform lambda/L", "log"), ("uniform lambda/L", "linear")]:
        scenes: dict[str, Any] = dict(mixture(number, spacing))
        for outputs, what in ((BOTH[:1], "force"), (BOTH, "force and energy")):
            one = microseconds({**scenes, "k": 0.37}, outputs)
            own = microseconds({**scenes, "k": rng.uniform(0.0, 0.95, number)}, outputs)
            lines.append([f"{name}, {what}", one, own, own / one])
    return table([f"{number:,} scenes, one thread", "one k, us", "a k each, us", "times"], lines)


def few_waves(number: int) -> Parameters:
    """Draw punches with 3 to 10 waves."""
    rng = np.random.default_rng(6)
    rim = 10.0 ** rng.uniform(-0.5, 0.0, number)
    material = {"k": 0.3, "nu": NU, "modulus": 10.0 ** rng.uniform(2.0, 3.5, number), "c0_over_R": C0}
    waves = {"lambda_over_R": rim / rng.uniform(3.0, 10.0, number), "A": 10.0 ** rng.uniform(-2.5, -1.0, number)}
    return material | waves | {"a_max_over_R": rim}


def punches_table(number: int = 1000) -> str:
    """Return the time of a scene of other punches with 3 to 10 waves, over that of one cosine."""
    scenes = few_waves(number)
    one = microseconds(scenes)
    lines: list[list[Any]] = [["exponent 2, one cosine", one, 1.0]]
    for name, profile in PUNCHES.items():
        own = microseconds(scenes, profile=profile)
        lines.append([name, own, own / one])
    return table([f"{number:,} scenes, one thread", "force and energy, us", "times one cosine"], lines)


def shared_table() -> str:
    """Return what many radii and many turning depths on one curve cost, over one of them."""
    material = {"k": 0.3, "nu": NU, "modulus": 500.0, "c0_over_R": 0.05, "A": 0.02}
    cases: dict[str, tuple[float, dict[str, Any]]] = {
        "one cosine, 16 waves": (0.05, {}),
        "one cosine, 400 waves": (0.002, {}),
        "one cosine, 16 waves, load": (0.05, {"loading": Loading(control="load")}),
        "series of two, 16 waves": (0.05, {"profile": PAIR}),
    }
    lines = []
    for name, (wavelength, how) in cases.items():
        scene = {**material, "lambda_over_R": wavelength, "a_max_over_R": 0.8}
        rims = {**scene, "a_max_over_R": np.linspace(0.8 / MANY, 0.8, MANY)}
        depth = float(solve(scene, ["delta_max"], **how)["delta_max"])
        turned = {**scene, "a_max_over_R": 1.0, "indentation_max_over_R": depth}
        depths = {**turned, "indentation_max_over_R": np.linspace(depth / MANY, depth, MANY)}
        one, many, turn, turns = (
            microseconds(of, **how) * size for of, size in ((scene, 1), (rims, MANY), (turned, 1), (depths, MANY))
        )
        lines.append([name, one, many / one, turn, turns / turn])
    header = ["one thread", "one radius, us", f"{MANY} radii: times", "one depth, us", f"{MANY} depths: times"]
    return table(header, lines)


def main() -> None:
    """Print all tables."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    for made in (controls_table, exponents_table, punches_table, shared_table):
        print(made(), flush=True)


if __name__ == "__main__":
    main()
