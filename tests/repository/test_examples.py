"""Each study that is shipped runs, and gives what is known of it by other means; those of pictures are in tests/figures."""

import json
import math

import numpy as np
import pytest
import xarray

import gradhesion as gr
from tests.conftest import ROOT

CONFIGS = ROOT / "configs"
REFERENCE = ROOT / "tests" / "reference"
WAVES = {"parameters.A": 0.0}
CHI = {"parameters.chi": 0.0}
ENDLESS = WAVES | {"parameters.a_max_over_R": math.inf}
SMOOTH: dict[str, dict[str, object]] = {
    "closing": {},
    "crackfront": {"parameters.toughness_amplitude": 0.0},
    "dead_load": WAVES,
    "jkr": {"physical.a_max": "inf"},
    "map": ENDLESS,
    "maps": ENDLESS | {"parameters.lambda_over_R": 0.3},
    "materials": WAVES,
    "physical": WAVES | {"physical.a_max": "inf"},
    "points": ENDLESS,
    "rate": WAVES | {"parameters.speed_over_reference": 0.0},
    "reduced": CHI | {"parameters.lambda_over_L": 0.3},
    "reduced_rim": CHI,
    "rings": {"parameters.toughness_amplitude": 0.0},
    "sensitive_probe": WAVES | {"physical.a_max": "inf"},
    "sensitivities": WAVES | {"parameters.lambda_over_R": 0.2},
    "series": WAVES,
    "short_waves": CHI,
    "smoke": ENDLESS,
    "solvers": CHI,
    "spring": WAVES,
    "uncertain_probe": {},
}
"""The paraboloids, and the keys that leave none of their scenes waves, rings or a speed."""
OTHERS = {"cone", "curve", "fit", "fit_spring", "optimum", "profile", "specimens"}


def run(name: str, set_to: dict[str, object] | None = None, **parameters: object) -> xarray.Dataset:
    own = {f"parameters.{key}": value for key, value in parameters.items()}
    return gr.run(CONFIGS / f"{name}.toml", set=(set_to or {}) | own)


def test_every_study_is_known_here() -> None:
    names = {path.stem for path in CONFIGS.glob("*.toml")}
    assert {name for name in names if not name.startswith(("fig", "extra_"))} == {*SMOOTH, *OTHERS}


@pytest.mark.parametrize("name", SMOOTH)
def test_a_smooth_paraboloid_has_its_force_without_gain_by_every_solver(name: str) -> None:
    found = run(name, SMOOTH[name])
    expected = ((3.0 + found["k"]) / 3.0).broadcast_like(found["pull_off_force"])
    np.testing.assert_allclose(found["pull_off_force"], expected, rtol=1e-12)
    for gain in {"adhesion_gain", "energy_gain"} & {*found}:
        np.testing.assert_allclose(found[gain], 1.0, rtol=1e-11)
    if "solver" in found.dims:
        energy = found["dissipated_energy"]
        np.testing.assert_allclose(energy, energy.isel(solver=0).broadcast_like(energy), rtol=1e-11)
    if "R" in found.coords:
        own = found["pull_off_force_si"]
        newtons = 1.5 * math.pi * found["R"] * found["work_of_adhesion"] * found["pull_off_force"]
        np.testing.assert_allclose(own, newtons.transpose(*own.dims), rtol=1e-12)


@pytest.mark.parametrize("name", sorted({*SMOOTH, *OTHERS} - {"fit", "fit_spring"}))
def test_every_scene_has_a_value_and_small_slopes(name: str) -> None:
    found = run(name)
    assert not found.gr.flagged("no_value").any()
    assert "steep_contact" not in found
    for force in {"pull_off_force", "best_pull_off_force"} & {*found}:
        assert not found[force].isnull().any()


def test_a_smooth_cone_is_pulled_off_by_the_force_of_its_closed_form() -> None:
    modulus = np.array([100.0, 500.0])
    cone = run("cone", k=0.0, A=0.0, modulus=modulus.tolist())
    # P = (pi/2) E* a^2 - (8 pi E* dgamma a^3)^(1/2) for the slope 1 (Maugis & Barquins): least at a = 18 dgamma/(pi E*)
    radius = 18.0 / (math.pi * modulus)
    force = 0.25 * np.sqrt(8.0 * math.pi * modulus * radius**3) / (1.5 * math.pi)
    np.testing.assert_allclose(cone["pull_off_force"], force, rtol=1e-12)
    np.testing.assert_allclose(cone["pull_off_radius"], radius, rtol=1e-7)


def test_a_lens_closes_and_opens_at_the_forces_of_its_two_works() -> None:
    lens = run("closing")
    radius, opening = lens["R"].item(), lens["work_of_adhesion"].item()
    closing, area = lens["work_of_adhesion_closing"], math.pi * lens["turning_radius_si"] ** 2
    pull = (4.0 / 3.0 * math.pi * radius * closing).broadcast_like(area)
    np.testing.assert_allclose(lens["snap_in_force_si"][..., 1:], pull.transpose(*area.dims)[..., 1:], rtol=1e-11)
    assert lens["snap_in_force"].isel(work_of_adhesion_closing=0).isnull().all()
    front = ((opening - closing) * area).transpose(*area.dims)
    np.testing.assert_allclose(lens["front_energy_si"], front, rtol=1e-12)
    parts = lens["loading_energy"] + lens["unloading_energy"] + lens["front_energy"]
    np.testing.assert_allclose(parts, lens["dissipated_energy"], rtol=1e-12)


def test_the_rings_of_crackfront_have_the_stored_cycle_in_other_units() -> None:
    patterns = json.loads((REFERENCE / "moving_edge.json").read_text())["patterns"]
    expected, found = patterns["crackfront_axisymmetric"]["result"], run("crackfront").sel(toughness_amplitude=0.2)
    scales = {"pull_off_force": 1.0, "snap_in_force": 1.0, "turning_radius": 10.0, "dissipated_energy": 100.0}
    for name, scale in (scales | {"loading_jumps": 1.0, "unloading_jumps": 1.0}).items():
        assert scale * found[name].item() == pytest.approx(float(expected[name]), rel=1e-12), name


def test_short_rings_hold_as_the_toughest_of_them() -> None:
    force = run("rings")["pull_off_force"]
    toughest = 1.0 + 0.75 * force["toughness_amplitude"]  # cos x - cos(2 x)/4 is at most 3/4, at x = 0
    assert bool((force <= toughest**2 * (1.0 + 1e-12)).all())
    np.testing.assert_allclose(force.isel(toughness_wavelength=0), toughest**2, rtol=0.003)


def test_slow_speeds_are_the_cycle_at_rest_and_fast_ones_hide_the_waves() -> None:
    rate = run("rate", speed_over_reference=[0.0, 1e-7, 10.0])
    force, punch = rate["pull_off_force"], ("k", "nu", "modulus", "lambda_over_R", "a_max_over_R")
    rest = gr.solve({name: rate[name].item() for name in punch}, A=[0.0, 0.02])
    for name in ("pull_off_force", "dissipated_energy"):
        np.testing.assert_array_equal(rate[name].isel(speed_over_reference=0), rest[name])
    slow = 1.0 + rate["rate_coefficient"].isel(speed_over_reference=1) * 1e-7**0.6
    np.testing.assert_allclose(force.isel(speed_over_reference=1), rest["pull_off_force"] * slow, rtol=1e-7)
    gain = force.sel(A=0.02) / force.sel(A=0.0)
    assert [float(gain[0]), float(gain[2])] == pytest.approx([1.342, 1.011], abs=5e-4)  # docs/theory.md, section 20
    assert bool((rate["dissipated_energy"].diff("speed_over_reference") > 0.0).all())


def test_a_retraction_through_a_spring_gives_what_it_was_made_with() -> None:
    found = run("fit_spring")
    made = {"E_star": 2e6, "work_of_adhesion": 0.045, "indentation_offset": 3e-9, "load_offset": -8e-9}
    assert list(found["parameter"].values) == list(made)
    away = (found["value"] - list(made.values())) / found["standard_deviation"]
    assert float(abs(away).max()) < 3.5
    assert 0.7 < float(found["chi_square"] / found["degrees_of_freedom"]) < 1.4
