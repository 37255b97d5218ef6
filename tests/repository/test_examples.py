"""Each study that shows a feature runs, and gives what is known of it by other means."""

import json
import math
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray

import gradhesion as gr

CONFIGS = Path(__file__).parents[2] / "configs"
FEATURES: dict[str, tuple[str, ...]] = {
    "another profile": ("cone", "series"),
    "another control": ("dead_load", "spring"),
    "two works": ("closing", "extra_split"),
    "a pattern": ("crackfront", "rings"),
    "a speed": ("rate", "extra_speed"),
    "points": ("points", "materials", "specimens"),
    "units": ("physical", "jkr"),
    "reduced variables": ("reduced", "reduced_rim"),
    "several solvers": ("solvers", "short_waves"),
    "sensitivities": ("sensitivities", "sensitive_probe"),
    "uncertain inputs": ("uncertain_probe", "extra_error_bars"),
    "optima": ("optimum", "extra_best_wavelength", "extra_best_exponent", "extra_front"),
    "fits": ("fit", "fit_spring"),
}
WITHOUT_FORCE = {*FEATURES["optima"], *FEATURES["fits"]}
ELSEWHERE = {
    "points",
    "physical",
    "jkr",
    "extra_error_bars",
    "extra_split",
    "extra_speed",
}  # in test_repository and tests/figures
EXAMPLES = sorted({name for names in FEATURES.values() for name in names} - WITHOUT_FORCE - ELSEWHERE)

Run = Callable[..., xarray.Dataset]


@pytest.fixture
def run() -> Run:
    """Compute a study of configs/ in memory, with keys of its own."""

    def compute(name: str, **parameters: object) -> xarray.Dataset:
        return gr.run(CONFIGS / f"{name}.toml", set={f"parameters.{key}": value for key, value in parameters.items()})

    return compute


def test_two_studies_show_each_feature() -> None:
    for feature, names in FEATURES.items():
        for name in names:
            study = tomllib.loads((CONFIGS / f"{name}.toml").read_text())
            parameters = study["parameters"]
            shown = {
                "another profile": "profile" in study,
                "another control": study.get("loading", {}).get("control", "displacement") != "displacement",
                "two works": bool(
                    {"closing_ratio", "work_of_adhesion_closing"} & {*parameters, *study.get("physical", ())}
                ),
                "a pattern": "toughness" in study,
                "a speed": "rate" in study,
                "points": study.get("layout") == "points" or "points" in parameters,
                "units": "physical" in study,
                "reduced variables": {"chi", "lambda_over_L"} <= parameters.keys(),
                "several solvers": isinstance(study.get("method", {}).get("solver"), list),
                "sensitivities": "pull_off_force_sensitivity" in study.get("outputs", ()),
                "uncertain inputs": "uncertainty" in study,
                "optima": study.get("kind") == "optimum",
                "fits": study.get("kind") == "fit",
            }
            assert len(names) > 1
            assert shown[feature], (feature, name)


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_scene_has_a_value(name: str, run: Run) -> None:
    dataset = run(name)
    assert not dataset.gr.flagged("no_value").any()
    assert not dataset["pull_off_force"].isnull().any()
    assert dataset.attrs["title"] in (CONFIGS / f"{name}.toml").read_text()


def test_a_smooth_cone_is_pulled_off_by_the_force_of_its_closed_form(run: Run) -> None:
    modulus = np.array([100.0, 500.0])
    cone = run("cone", k=0.0, A=0.0, modulus=modulus.tolist())
    # P = (pi/2) E* a^2 - (8 pi E* dgamma a^3)^(1/2) for the slope 1 (Maugis & Barquins): least at a = 18 dgamma/(pi E*)
    radius = 18.0 / (math.pi * modulus)
    force = 0.25 * np.sqrt(8.0 * math.pi * modulus * radius**3) / (1.5 * math.pi)
    np.testing.assert_allclose(cone["pull_off_force"], force, rtol=1e-12)
    np.testing.assert_allclose(cone["pull_off_radius"], radius, rtol=1e-7)


def test_one_wave_of_a_series_is_a_wave_of_its_own_length() -> None:
    set_to = {"parameters.k": 0.5, "parameters.A": 0.02}
    short = gr.run(CONFIGS / "series.toml", set=set_to | {"profile.harmonics": [{"n": 4, "cos": 0.2}]})
    punch = {"k": 0.5, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.01, "a_max_over_R": 0.5}
    alone = gr.solve(punch, lambda_over_R=0.05, A=0.016)
    for name in ("pull_off_force", "dissipated_energy"):
        assert float(short[name]) == pytest.approx(float(alone[name]), rel=1e-11)


def test_a_dead_load_pulls_off_as_a_controlled_depth_does(run: Run) -> None:
    dead = run("dead_load", A=[0.0, 0.03])
    punch = {name: dead[name].item() for name in ("nu", "modulus", "c0_over_R", "lambda_over_R", "a_max_over_R")}
    depth = gr.solve(punch, k=dead["k"].values, A=[0.0, 0.03])
    np.testing.assert_allclose(dead["pull_off_force"], depth["pull_off_force"], rtol=1e-12)
    np.testing.assert_allclose(dead["pull_off_force"].sel(A=0.0), (3.0 + dead["k"]) / 3.0, rtol=1e-12)


def test_a_softer_spring_costs_more_energy_and_pulls_off_at_the_same_force(run: Run) -> None:
    spring = run("spring")
    force = spring["pull_off_force"]
    np.testing.assert_allclose(force, force.isel(machine_stiffness=-1).broadcast_like(force), rtol=1e-12)
    assert (spring["dissipated_energy"].diff("machine_stiffness") < 0.0).all()


def test_a_lens_closes_and_opens_at_the_forces_of_its_two_works(run: Run) -> None:
    lens = run("closing")
    radius, opening = lens["R"].item(), lens["work_of_adhesion"].item()
    closing, area = lens["work_of_adhesion_closing"], math.pi * lens["turning_radius_si"] ** 2
    pull = (4.0 / 3.0 * math.pi * radius * closing).broadcast_like(area)
    np.testing.assert_allclose(lens["pull_off_force_si"], 1.5 * math.pi * radius * opening, rtol=1e-12)
    np.testing.assert_allclose(lens["snap_in_force_si"][..., 1:], pull.transpose(*area.dims)[..., 1:], rtol=1e-11)
    assert lens["snap_in_force"].isel(work_of_adhesion_closing=0).isnull().all()
    front = ((opening - closing) * area).transpose(*area.dims)
    np.testing.assert_allclose(lens["front_energy_si"], front, rtol=1e-12)
    parts = lens["loading_energy"] + lens["unloading_energy"] + lens["front_energy"]
    np.testing.assert_allclose(parts, lens["dissipated_energy"], rtol=1e-12)


def test_the_rings_of_crackfront_have_the_stored_cycle_in_other_units(run: Run) -> None:
    reference = Path(__file__).parents[1] / "reference" / "moving_edge.json"
    expected = json.loads(reference.read_text())["patterns"]["crackfront_axisymmetric"]["result"]
    found = run("crackfront").sel(toughness_amplitude=0.2)
    for name, scale in (
        ("pull_off_force", 1.0),
        ("snap_in_force", 1.0),
        ("turning_radius", 10.0),
        ("dissipated_energy", 100.0),
    ):
        assert scale * found[name].item() == pytest.approx(float(expected[name]), rel=1e-12), name
    for name in ("loading_jumps", "unloading_jumps"):
        assert found[name].item() == expected[name]


def test_short_rings_hold_as_the_toughest_of_them(run: Run) -> None:
    force = run("rings")["pull_off_force"]
    np.testing.assert_allclose(force.sel(toughness_amplitude=0.0), 1.0, rtol=1e-12)
    toughest = 1.0 + 0.75 * force["toughness_amplitude"]  # cos x - cos(2 x)/4 is at most 3/4, at x = 0
    assert bool((force <= toughest**2 * (1.0 + 1e-12)).all())
    np.testing.assert_allclose(force.isel(toughness_wavelength=0), toughest**2, rtol=0.003)


def test_slow_speeds_are_the_cycle_at_rest_and_fast_ones_hide_the_waves(run: Run) -> None:
    rate = run("rate", speed_over_reference=[0.0, 1e-7, 10.0])
    force, energy = rate["pull_off_force"], rate["dissipated_energy"]
    rest = gr.solve(
        {name: rate[name].item() for name in ("k", "nu", "modulus", "lambda_over_R", "a_max_over_R")}, A=[0.0, 0.02]
    )
    for name in ("pull_off_force", "dissipated_energy"):
        np.testing.assert_array_equal(rate[name].isel(speed_over_reference=0), rest[name])
    slow = 1.0 + rate["rate_coefficient"].isel(speed_over_reference=1) * 1e-7**0.6
    np.testing.assert_allclose(force.isel(speed_over_reference=1), rest["pull_off_force"] * slow, rtol=1e-7)
    gain = force.sel(A=0.02) / force.sel(A=0.0)
    assert [float(gain[0]), float(gain[2])] == pytest.approx([1.342, 1.011], abs=5e-4)  # docs/theory.md, section 20
    assert bool((energy.diff("speed_over_reference") > 0.0).all())


def test_points_in_units_are_johnson_kendall_and_roberts_where_they_are_smooth(run: Run) -> None:
    smooth = run("materials", A=0.0)
    force = 1.5 * math.pi * smooth["R"] * smooth["work_of_adhesion"]
    np.testing.assert_allclose(smooth["pull_off_force_si"], force, rtol=1e-12)
    assert smooth["pull_off_force_si"].dims == ("scene",)


def test_reduced_variables_hold_for_every_material(run: Run) -> None:
    few = {"lambda_over_L": [0.3, 1.1], "chi": [0.0, 0.4, 0.9]}
    one, other = run("reduced", **few), run("reduced", **few, modulus=37.0, c0_over_R=0.4, nu=0.45)
    np.testing.assert_allclose(one["pull_off_force"], other["pull_off_force"], rtol=1e-11)
    np.testing.assert_allclose(one["pull_off_force"].sel(chi=0.0), 1.1, rtol=1e-12)  # (3 + k)/3


def test_cycles_of_like_size_gain_nothing_without_waves(run: Run) -> None:
    smooth = run("reduced_rim", chi=0.0)
    np.testing.assert_allclose(smooth["energy_gain"], 1.0, rtol=1e-11)
    np.testing.assert_allclose(
        smooth["pull_off_force"], ((3.0 + smooth["k"]) / 3.0).broadcast_like(smooth["pull_off_force"]), rtol=1e-12
    )


def test_the_envelope_is_the_limit_of_short_waves(run: Run) -> None:
    found = run("solvers", lambda_over_R=[0.002, 0.02])["pull_off_force"]
    limit = 1.1 * 1.2**2  # (3 + k)/3 (1 + chi)^2
    np.testing.assert_allclose(found.sel(solver="envelope"), limit, rtol=1e-12)
    away = abs(found.sel(solver="exact") / limit - 1.0)
    assert float(away[0]) < float(away[1]) < 0.1


def test_both_solvers_agree_where_there_are_no_waves(run: Run) -> None:
    found = run("short_waves", chi=0.0)
    for name in ("pull_off_force", "dissipated_energy"):
        exact, envelope = (found[name].sel(solver=solver) for solver in ("exact", "envelope"))
        np.testing.assert_allclose(exact, envelope, rtol=1e-11)


def test_no_wavelength_is_better_than_the_best() -> None:
    """For each exponent, against 20,000 wavelengths; the slope is 0 there."""
    best = gr.run(CONFIGS / "optimum.toml")
    study = gr.load(CONFIGS / "optimum.toml")
    assert study.kind == "optimum"
    (searched,) = study.search.inputs
    waves = np.geomspace(searched.low, searched.high, 20_000)[:, None]
    scenes = {name: best[name].values for name in study.parameters}
    force = gr.core.solve(scenes | {"lambda_over_R": waves}, ["pull_off_force"])["pull_off_force"].max(axis=0)
    assert np.all(best["best_pull_off_force"].values >= force * (1.0 - 1e-15))
    np.testing.assert_allclose(best["best_pull_off_force"], force, rtol=1e-6)
    slopes = best["best_pull_off_force_sensitivity"].sel(parameter="lambda_over_R")
    np.testing.assert_allclose(slopes, 0.0, atol=1e-13)
    assert not best["on_bound"].any()


def test_the_force_of_a_smooth_punch_depends_on_the_exponent_alone(run: Run) -> None:
    """It is (3 + k)/3 in units of 1.5 pi R dgamma."""
    smooth = run("sensitivities", A=0.0, lambda_over_R=0.2, k=[0.0, 0.5])
    slopes = smooth["pull_off_force_sensitivity"]
    # differences by k leave step^4/30 of the fifth derivative, 2e-12 here (core/sensitivities/neighbours.py)
    np.testing.assert_allclose(slopes.sel(parameter="k"), 1.0 / (3.0 + smooth["k"]), rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(slopes.drop_sel(parameter="k"), 0.0, atol=1e-12)


def test_the_force_of_a_smooth_probe_in_newtons_grows_as_radius_and_work_of_adhesion(run: Run) -> None:
    slopes = run("sensitive_probe", A=0.0, k=0.0)["pull_off_force_sensitivity_physical"]
    for name in map(str, slopes["physical_parameter"].values):
        known = 1.0 if name in ("R", "work_of_adhesion") else 0.0
        np.testing.assert_allclose(slopes.sel(physical_parameter=name), known, atol=1e-12, err_msg=name)


def test_the_deviation_of_the_force_of_a_smooth_probe_is_that_of_its_factors(run: Run) -> None:
    """F = 1.5 pi R dgamma: relative deviations of 20 nm/R and 3 % add up in squares; modulus and nu do not matter."""
    probe = run("uncertain_probe")
    expected = np.hypot(0.03, 2e-8 / probe["R"]) * probe["pull_off_force_si"]
    np.testing.assert_allclose(probe["pull_off_force_std_si"], expected, rtol=1e-12)


def test_points_of_a_file_are_its_rows(run: Run) -> None:
    found = run("specimens")
    rows = np.genfromtxt(CONFIGS / "specimens.csv", delimiter=",", names=True, comments="#", skip_header=1)
    assert found.sizes == {"scene": rows.size}
    for i in (0, rows.size - 1):
        row = {str(name): float(rows[name][i]) for name in rows.dtype.names}
        alone = gr.solve(row, "pull_off_force", k=0.3, nu=0.3, c0_over_R=0.01, a_max_over_R=0.5)
        assert alone["pull_off_force"].item() == pytest.approx(found["pull_off_force"][i].item(), rel=1e-13)


def test_a_retraction_through_a_spring_gives_what_it_was_made_with() -> None:
    found = gr.run(CONFIGS / "fit_spring.toml")
    made = {"E_star": 2e6, "work_of_adhesion": 0.045, "indentation_offset": 3e-9, "load_offset": -8e-9}
    assert list(found["parameter"].values) == list(made)
    away = (found["value"] - list(made.values())) / found["standard_deviation"]
    assert float(abs(away).max()) < 3.5
    assert 0.7 < float(found["chi_square"] / found["degrees_of_freedom"]) < 1.4
