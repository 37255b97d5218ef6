"""Studies in units and what may be left out: the same scenes as in ratios, and results in SI beside those without a unit."""

import math
from fractions import Fraction
from itertools import product
from typing import Any, Final

import numpy as np
import pytest
import xarray

from gradhesion.cli.dataset import compute
from gradhesion.cli.names.outputs import SI
from gradhesion.cli.names.units import UNITS
from gradhesion.cli.study import study_from
from gradhesion.core import OUTPUTS

EPS: Final = 2.0**-52
COUNT: Final = 40
LENGTHS: Final = {"m": 1, "mm": Fraction(1, 10**3), "um": Fraction(1, 10**6), "nm": Fraction(1, 10**9), "inch": Fraction(254, 10**4)}  # fmt: skip
STRESSES: Final = {"Pa": 1, "kPa": 10**3, "MPa": 10**6, "GPa": 10**9, "N/mm^2": 10**6}
TENSIONS: Final = {"J/m^2": 1, "mJ/m^2": Fraction(1, 10**3), "N/m": 1, "erg/cm^2": Fraction(1, 10**3)}
FORCES: Final = {"N": 1, "mN": Fraction(1, 10**3), "uN": Fraction(1, 10**6), "nN": Fraction(1, 10**9)}
SPRINGS: Final = {"N/m": 1, "mN/m": Fraction(1, 10**3), "nN/nm": 1}
CASES: Final[dict[str, tuple[str, str]]] = {
    "a rim": ("displacement", "a_max"),
    "a depth": ("displacement", "indentation_max"),
    "a preload": ("displacement", "preload"),
    "a dead load": ("load", "a_max"),
    "a machine": ("machine", "a_max"),
}


class Quantities:
    """Random quantities as texts with units, and what they are exactly in SI units."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.texts: dict[str, list[str]] = {}
        self.exact: dict[str, list[Fraction]] = {}

    def draw(self, name: str, units: dict[str, Any], values: Any) -> None:
        """Write values in SI units in one of some units each, with as many digits as they come."""
        self.texts[name], self.exact[name] = [], []
        for value in values.tolist():
            unit = str(self.rng.choice([*units]))
            number = f"{value / float(units[unit]):.{int(self.rng.integers(2, 15))}g}"
            self.texts[name].append(f"{number} {unit}")
            self.exact[name].append(Fraction(number) * units[unit])


def drawn(end: str, control: str) -> Quantities:
    """Draw scenes over six decades of every quantity; waves are neither too many nor too steep."""
    made = Quantities(1)
    radius, modulus = 10.0 ** made.rng.uniform(-8, -2, COUNT), 10.0 ** made.rng.uniform(3, 11, COUNT)
    work = modulus * radius / 10.0 ** made.rng.uniform(0.5, 4.0, COUNT)
    made.draw("R", LENGTHS, radius)
    made.draw("E_star", STRESSES, modulus)
    made.draw("work_of_adhesion", TENSIONS, work)
    made.draw("c0", LENGTHS, radius * 10.0 ** made.rng.uniform(-3, 1, COUNT))
    made.draw("wavelength", LENGTHS, radius * 10.0 ** made.rng.uniform(-1.5, 0, COUNT))
    size = {"a_max": radius, "indentation_max": 0.1 * radius, "preload": radius * work}[end]
    made.draw(end, FORCES if end == "preload" else LENGTHS, size * 10.0 ** made.rng.uniform(-1, 0.3, COUNT))
    if control == "machine":
        made.draw("spring_constant", SPRINGS, modulus * radius * 10.0 ** made.rng.uniform(-2, 2, COUNT))
    return made


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_random_values_in_random_units_are_the_same_scenes_and_have_the_same_bits(case: str) -> None:
    control, end = CASES[case]
    made = drawn(end, control)
    numbers = {"k": made.rng.uniform(0, 0.95, COUNT).tolist(), "A": (10.0 ** made.rng.uniform(-4, -1, COUNT)).tolist()}
    outputs = [name for name in OUTPUTS if control != "load" or not name.endswith("_residual")]
    common = {"layout": "points", "outputs": outputs, "loading": {"control": control}}
    units = compute(study_from(common | {"parameters": numbers | {"nu": 0.3}, "physical": made.texts}))

    R, E_star, work = (np.array(made.exact[name]) for name in ("R", "E_star", "work_of_adhesion"))
    quotients = {"modulus": E_star * R / work}
    names = {"c0": "c0_over_R", "wavelength": "lambda_over_R", "a_max": "a_max_over_R", "indentation_max": "indentation_max_over_R"}  # fmt: skip
    quotients |= {ratio: np.array(made.exact[name]) / R for name, ratio in names.items() if name in made.exact}
    if control == "machine":
        quotients["machine_stiffness"] = np.array(made.exact["spring_constant"]) / (E_star * R)
    for name, values in quotients.items():  # each text is rounded once, and so is each step
        off = [
            abs(Fraction(found) / value - 1) for found, value in zip(units[name].values.tolist(), values, strict=True)
        ]
        assert max(off) <= 4 * EPS, name

    ratios = {name: units[name].values.tolist() for name in (*quotients, *(["load_max"] if end == "preload" else []))}
    stiffness = {name: ratios.pop(name) for name in ("machine_stiffness",) if name in ratios}
    loading = {"loading": {"control": control} | stiffness}
    plain = compute(study_from(common | loading | {"parameters": numbers | ratios | {"nu": 0.3}}))
    size = {"N": 1.5 * np.pi * (R * work).astype(float), "J": (R * R * work).astype(float), "m": R.astype(float)}
    for name in (*outputs, "status"):
        np.testing.assert_array_equal(units[name].values, plain[name].values, err_msg=name)
        if name in UNITS:
            expected = plain[name] * size[UNITS[name]]
            np.testing.assert_allclose(units[name + SI], expected, rtol=8 * EPS, err_msg=name)
    assert np.isfinite(plain["pull_off_force"]).mean() > 0.9


TIP = {"R": ["1 um", "1.3 um"], "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2", "c0": "13 nm", "wavelength": "0.2 um"}  # fmt: skip
VALUES = ["pull_off_force", "dissipated_energy", "loading_jumps"]


def made(parameters: dict[str, Any], outputs: Any = tuple(VALUES), **tables: Any) -> xarray.Dataset:
    """Compute a study of some parameters."""
    return compute(study_from({"outputs": [*outputs], "parameters": parameters, **tables}))


def test_axes_have_units_and_ratios_follow() -> None:
    waves = {"start": "110 nm", "stop": "470 nm", "num": 3, "spacing": "log"}
    physical = TIP | {"wavelength": waves, "a_max": ["1.7 um", math.inf]}
    dataset = made({"k": [0.0, 0.31], "nu": 0.27, "A": [0.0, 0.023]}, physical=physical)
    assert list(dataset["pull_off_force"].dims) == ["k", "R", "wavelength", "A", "a_max"]
    assert dataset["lambda_over_R"].dims == ("R", "wavelength")
    assert (dataset["modulus"].dims, dataset["a_max_over_R"].dims) == (("R",), ("R", "a_max"))
    units = {"R": "m", "E_star": "Pa", "work_of_adhesion": "J/m^2", "c0": "m", "wavelength": "m", "a_max": "m", "modulus": "1"}  # fmt: skip
    assert {name: dataset[name].units for name in units} == units
    assert (dataset["pull_off_force_si"].units, dataset["dissipated_energy_si"].units) == ("N", "J")
    assert "loading_jumps_si" not in dataset
    assert dataset["R"].values.tolist() == [1e-6, 1.3e-6]


def test_an_amplitude_in_metres_and_reduced_variables_beside_units() -> None:
    parameters = {"k": [0.0, 0.31], "nu": 0.27, "a_max_over_a2": 1.5}
    dataset = made(parameters, physical=TIP | {"amplitude": ["0 nm", "4 nm"]})
    assert dataset["A"].dims == ("R", "amplitude")  # through R in and out again
    np.testing.assert_allclose(dataset["A"].values, [[0.0, 0.02], [0.0, 0.02]], rtol=4 * EPS)
    assert dataset["a_max_over_R"].dims == ("k", "R", "amplitude")


def test_curves_have_units_too() -> None:
    parameters = {"k": 0.31, "nu": 0.27, "A": [0.0, 0.023]}
    dataset = made(parameters, ["path", "jumps"], kind="curve", physical=TIP | {"a_max": "0.4 um"})
    scale = 1.5 * math.pi * dataset["R"] * dataset["work_of_adhesion"]
    np.testing.assert_allclose(dataset["path_load_si"], dataset["path_load"] * scale, rtol=4 * EPS)
    for name, unit in {"path_load_si": "N", "jump_energy_si": "J", "path_contact_radius_si": "m"}.items():
        assert dataset[name].units == unit
    assert dataset["jump_energy_si"].dims == ("jump",)
    assert "path_branch_si" not in dataset


BALL: dict[str, Any] = {"k": 0.0, "nu": 0.3, "A": 0.0}


def test_a_smooth_homogeneous_ball_needs_four_numbers() -> None:
    """Johnson, Kendall & Roberts (1971): F = 1.5 pi R dgamma and H = 7.0922 (dgamma^5 R^4/E*^2)^(1/3)."""
    plain = made(BALL | {"modulus": 500.0})
    assert plain["pull_off_force"].item() == pytest.approx(1.0, rel=4 * EPS)
    assert plain["a_max_over_R"].item() == math.inf
    assert (plain["c0_over_R"].item(), plain["lambda_over_R"].item()) == (1.0, 1.0)
    assert [name for name in plain.coords if "comment" in plain[name].attrs] == ["c0_over_R", "lambda_over_R"]
    for name in ("c0_over_R", "lambda_over_R"):
        for value in (1e-3, 0.37, 40.0):
            other = made(BALL | {"modulus": 500.0, name: value})
            assert all(other[output].item() == plain[output].item() for output in VALUES)
    R, E_star, work = 5e-6, 1e9, 0.05
    dataset = made(BALL, physical={"R": "5 um", "E_star": "1 GPa", "work_of_adhesion": "50 mJ/m^2"})
    assert dataset["pull_off_force_si"].item() == pytest.approx(1.5 * math.pi * R * work, rel=1e-14)
    energy = 7.0922 * (work**5 * R**4 / E_star**2) ** (1 / 3)
    assert dataset["dissipated_energy_si"].item() == pytest.approx(energy, rel=1e-4)


def test_youngs_modulus_gives_the_reduced_one() -> None:
    others = {name: value for name, value in TIP.items() if name != "E_star"} | {"R": "1 um"}
    dataset = made({"k": 0.4, "nu": [-0.4, 0.0, 0.5], "A": 0.02}, physical=others | {"E": ["0.7 GPa", "1 GPa"]})
    assert dataset["E"].attrs["units"] == "Pa"
    assert {*dataset["modulus"].dims} == {"E", "nu"}
    for nu, modulus in product((-0.4, 0.0, 0.5), (0.7e9, 1e9)):
        reduced = others | {"E_star": f"{modulus / (1 - nu**2)!r} Pa"}
        expected, own = made({"k": 0.4, "nu": nu, "A": 0.02}, physical=reduced), dataset.sel(E=modulus, nu=nu)
        for output in VALUES:
            assert own[output].item() == pytest.approx(expected[output].item(), rel=1e-12)
    alone = made({"k": 0.4, "nu": 0.3, "A": 0.02}, physical=others | {"E": ["0.7 GPa", "1 GPa"]})
    assert alone["modulus"].dims == ("E",)
