"""Studies in units against the same without units, over random values in random units: the same scenes, and the same bits."""

from fractions import Fraction
from typing import Any, Final

import numpy as np
import pytest

from gradhesion.cli.dataset.dataset import compute
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study.reading import study_from

EPS: Final = Fraction(1, 2**52)
COUNT: Final = 40
LENGTHS: Final = {
    "m": 1,
    "mm": Fraction(1, 10**3),
    "um": Fraction(1, 10**6),
    "nm": Fraction(1, 10**9),
    "inch": Fraction(254, 10**4),
}
STRESSES: Final = {"Pa": 1, "kPa": 10**3, "MPa": 10**6, "GPa": 10**9, "N/mm^2": 10**6}
TENSIONS: Final = {"J/m^2": 1, "mJ/m^2": Fraction(1, 10**3), "N/m": 1, "erg/cm^2": Fraction(1, 10**3)}
FORCES: Final = {"N": 1, "mN": Fraction(1, 10**3), "uN": Fraction(1, 10**6), "nN": Fraction(1, 10**9)}
SPRINGS: Final = {"N/m": 1, "mN/m": Fraction(1, 10**3), "nN/nm": 1}
OUTPUTS: Final = [
    "pull_off_force",
    "pull_off_radius",
    "dissipated_energy",
    "loading_energy",
    "delta_max",
    "loading_jumps",
]
CASES: Final[dict[str, tuple[str, tuple[str, ...]]]] = {
    "a rim": ("displacement", ("a_max",)),
    "a depth": ("displacement", ("indentation_max",)),
    "a preload": ("displacement", ("preload",)),
    "a dead load": ("load", ("a_max",)),
    "a machine": ("machine", ("a_max",)),
}


class Quantities:
    """Random quantities as texts with units, and what they are exactly in SI units."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.texts: dict[str, list[str]] = {}
        self.exact: dict[str, list[Fraction]] = {}

    def draw(self, name: str, units: dict[str, Any], values: list[float]) -> None:
        """Write values in SI units in one of some units each, with as many digits as they come."""
        self.texts[name], self.exact[name] = [], []
        for value in values:
            unit = str(self.rng.choice([*units]))
            number = f"{value / float(units[unit]):.{int(self.rng.integers(2, 15))}g}"
            self.texts[name].append(f"{number} {unit}")
            self.exact[name].append(Fraction(number) * units[unit])


def drawn(seed: int, ends: tuple[str, ...], control: str) -> tuple[Quantities, dict[str, list[float]]]:
    """Draw scenes over six decades of every quantity; waves are neither too many nor too steep."""
    made = Quantities(seed)
    rng = made.rng
    radius, modulus = 10.0 ** rng.uniform(-8, -2, COUNT), 10.0 ** rng.uniform(3, 11, COUNT)
    work = modulus * radius / 10.0 ** rng.uniform(0.5, 4.0, COUNT)
    made.draw("R", LENGTHS, radius.tolist())
    made.draw("E_star", STRESSES, modulus.tolist())
    made.draw("work_of_adhesion", TENSIONS, work.tolist())
    made.draw("c0", LENGTHS, (radius * 10.0 ** rng.uniform(-3, 1, COUNT)).tolist())
    made.draw("wavelength", LENGTHS, (radius * 10.0 ** rng.uniform(-1.5, 0, COUNT)).tolist())
    size = {"a_max": radius, "indentation_max": 0.1 * radius, "preload": radius * work}
    for name in ends:
        spread = 10.0 ** rng.uniform(-1, 0.3, COUNT)
        made.draw(name, FORCES if name == "preload" else LENGTHS, (size[name] * spread).tolist())
    if control == "machine":
        made.draw("spring_constant", SPRINGS, (modulus * radius * 10.0 ** rng.uniform(-2, 2, COUNT)).tolist())
    numbers = {"k": rng.uniform(0, 0.95, COUNT).tolist(), "A": (10.0 ** rng.uniform(-4, -1, COUNT)).tolist()}
    return made, numbers


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("case", CASES)
def test_the_same_scenes_and_the_same_bits(case: str, seed: int) -> None:
    control, ends = CASES[case]
    made, numbers = drawn(seed, ends, control)
    loading: dict[str, Any] = {} if control == "displacement" else {"loading": {"control": control}}
    common = {"layout": "points", "outputs": OUTPUTS}
    units = compute(study_from(common | loading | {"parameters": numbers | {"nu": 0.3}, "physical": made.texts}))

    exact = made.exact
    quotients = {
        "modulus": [e * r / w for e, r, w in zip(exact["E_star"], exact["R"], exact["work_of_adhesion"], strict=True)],
        "c0_over_R": [c / r for c, r in zip(exact["c0"], exact["R"], strict=True)],
        "lambda_over_R": [c / r for c, r in zip(exact["wavelength"], exact["R"], strict=True)],
    }
    for name, ratio in (("a_max", "a_max_over_R"), ("indentation_max", "indentation_max_over_R")):
        if name in exact:
            quotients[ratio] = [a / r for a, r in zip(exact[name], exact["R"], strict=True)]
    if control == "machine":
        springs = zip(exact["spring_constant"], exact["E_star"], exact["R"], strict=True)
        quotients["machine_stiffness"] = [s / (e * r) for s, e, r in springs]
    for name, values in quotients.items():
        for found, value in zip(units[name].values.tolist(), values, strict=True):
            assert abs(Fraction(found) - value) <= 4 * EPS * value, (
                name
            )  # each text is rounded once, and so is each step

    ratios = {
        name: units[name].values.tolist() for name in (*quotients, *(["load_max"] if case == "a preload" else []))
    }
    without = loading
    if control == "machine":
        without = {"loading": loading["loading"] | {"machine_stiffness": ratios.pop("machine_stiffness")}}
    plain = compute(study_from(common | without | {"parameters": numbers | ratios | {"nu": 0.3}}))
    for name in (*OUTPUTS, "status"):
        np.testing.assert_array_equal(units[name].values, plain[name].values, err_msg=name)
    R, w = (np.array([float(value) for value in exact[name]]) for name in ("R", "work_of_adhesion"))
    size = {"N": 1.5 * np.pi * R * w, "J": R * R * w, "m": R}
    for name in OUTPUTS:
        if name in UNITS:
            np.testing.assert_allclose(
                units[name + SI], plain[name] * size[UNITS[name]], rtol=8 * float(EPS), err_msg=name
            )
    assert np.isfinite(plain["pull_off_force"]).mean() > 0.9
