"""Every study of a figure gives what is known of it by other means: closed forms, scaling, areas, the paper's text."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.typing import NDArray
from scipy.optimize import brentq

from figures.effective import EARLY, effective_path
from figures.extras import threshold_of
from figures.fig3 import corners_of
from figures.fig8 import parts_of
from figures.fig9 import fitted_curve
from gradhesion.core import PARAMETERS, TURNS, solve
from gradhesion.core.answers.flags import LINEAR_DEVIATION_OFF
from gradhesion.core.equations import effective, envelopes, jkr
from gradhesion.core.problem.material import stiffness
from gradhesion.core.problem.status import LOADING_NOT_ONE_DISC, PULL_OFF_AT_RIM
from tests.conftest import ROOT

Compute = Callable[..., xarray.Dataset]
Values = NDArray[np.float64]
CONFIGS = [path for pattern in ("fig*", "extra_*") for path in sorted((ROOT / "configs").glob(f"{pattern}.toml"))]
FORCE = 1.5 * math.pi
"""The unit of loads, in R dgamma."""
CHORDS = 1e-3
"""Five times what a chord of a curve is off, of the span that is drawn (core/draw)."""


def values(dataset: xarray.Dataset, *names: str) -> list[Values]:
    columns = [np.asarray(dataset[name].values, dtype=float) for name in names]
    return [column[~np.isnan(columns[0])] for column in columns]


def area(x: Values, y: Values) -> float:
    """The area within a closed line, in R^2 dgamma."""
    return FORCE * abs(float(np.sum(0.5 * (y + np.roll(y, -1)) * (np.roll(x, -1) - x))))


def scene(dataset: xarray.Dataset) -> dict[str, float]:
    return {name: dataset[name].item() for name in (*PARAMETERS, *TURNS) if name in dataset.coords}


def material(dataset: xarray.Dataset) -> float:
    return float(stiffness(*(dataset[name].item() for name in ("k", "nu", "modulus", "c0_over_R"))))


@pytest.mark.parametrize("config", CONFIGS, ids=lambda path: path.stem)
def test_nothing_is_to_be_reported_of_any_scene(config: Path, computed: Compute) -> None:
    dataset = computed(config.stem)
    assert ("steep_contact" in dataset) == (config.stem == "fig4a"), "which is unbounded, as it says"
    allowed = {"fig4a": LOADING_NOT_ONE_DISC, "fig4c": PULL_OFF_AT_RIM, "extra_rim": PULL_OFF_AT_RIM}
    allowed["extra_roughness"] = LOADING_NOT_ONE_DISC | PULL_OFF_AT_RIM
    allowed["extra_error_bars"] = LINEAR_DEVIATION_OFF
    assert not (dataset["status"].values & ~np.int16(allowed.get(config.stem, 0))).any()


@pytest.mark.parametrize("name", ["fig2a", "fig2b", "fig3", "fig5", "fig6", "fig7", "fig8", "extra_amplitudes"])
def test_the_contact_of_every_curve_stays_one_disc(name: str, computed: Compute) -> None:
    dataset = computed(name)
    parameters = {key: dataset[key].values for key in (*PARAMETERS, *TURNS) if key in dataset.coords}
    assert not (solve(parameters, ["dissipated_energy"])["status"] & LOADING_NOT_ONE_DISC).any()


def test_fig1_shows_an_equilibrium_of_one_disc(computed: Compute) -> None:
    dataset = computed("fig1")
    radius, gap = values(dataset, "surface_radius", "surface_gap")
    assert np.nanmin(gap) == 0.0
    assert np.nanmax(gap) > 0.1
    assert dataset["state"].item() in radius


@pytest.mark.parametrize(("name", "k"), [("fig2a", 0.1), ("fig2b", 0.0)])
def test_fig2_the_smooth_punch_pulls_off_at_its_closed_form(name: str, k: float, computed: Compute) -> None:
    dataset = computed(name)
    assert dataset["k"].item() == k
    assert float(dataset["smooth_load"].min()) == pytest.approx(-(3 + k) / 3, rel=1e-13)
    assert float((dataset["stable"] == 1).astype(int).diff("point").clip(min=0).sum()) == 3


def test_fig3_has_the_events_of_the_paper_and_the_loop_is_the_energy(computed: Compute) -> None:
    dataset = computed("fig3")
    depth, load = values(dataset, "path_indentation", "path_load")
    expected = float(solve(scene(dataset), ["dissipated_energy"])["dissipated_energy"])
    assert area(depth, load) == pytest.approx(expected, rel=CHORDS)
    radius, corners = values(dataset, "path_contact_radius")[0], corners_of(dataset)
    # A to L: jump-in, two jumps of loading, the turn, a jump of unloading, the lowest load, the jump-out
    expected_radii = [0.0, 0.0526, 0.085, 0.224, 0.293, 0.402, 0.45, 0.363, 0.249, 0.181, 0.173, 0.0]
    np.testing.assert_allclose(radius[corners], expected_radii, atol=6e-4)
    assert load[corners[9]] == load.min() == pytest.approx(-2.458, abs=5e-4)
    assert depth[corners[6]] == depth.max() == pytest.approx(dataset["indentation_max_over_R"].item(), rel=1e-12)


def test_fig4a_the_best_exponent_depends_on_poissons_ratio(computed: Compute) -> None:
    dataset = computed("fig4a")
    greatest = dataset["pull_off_force"].max("lambda_over_R")
    assert float(greatest.sel(nu=0.3).idxmax("k")) == pytest.approx(0.68, abs=0.021)
    assert float(greatest.sel(nu=0.5).idxmax("k")) == 0.98
    # near the maxima loading does not make contact over one disc: the state is that of intimate contact
    at = dataset["status"].isel(lambda_over_R=dataset["pull_off_force"].argmax("lambda_over_R")).sel(nu=0.5)
    assert ((at & LOADING_NOT_ONE_DISC) > 0).all()


def test_fig4b_and_fig4c_the_force_grows_as_the_gradient_gets_shallow_and_with_the_rim(computed: Compute) -> None:
    assert (np.diff(computed("fig4b")["pull_off_force"].max("lambda_over_R").values) < 0).all()
    whole = 'lambda_over_R={ start = 0.02, stop = 1.0, num = 600, spacing = "log" }'
    force = computed("fig4c", whole)["pull_off_force"].transpose("a_max_over_R", "lambda_over_R").values
    assert (np.diff(force.max(axis=1)[:3]) > 0.5).all()
    np.testing.assert_allclose(force[3], force[4], rtol=1e-13)
    maxima = ((force[:, 1:-1] > force[:, :-2]) & (force[:, 1:-1] > force[:, 2:])).sum(axis=1)
    assert maxima.tolist() == [9] * 5  # the paper has more local maxima with a rim: that depends on the scene


def test_the_threshold_is_the_furthest_radius_of_the_pull_off(computed: Compute) -> None:
    dataset = computed("extra_rim")
    force, names = dataset["pull_off_force"], ("k", "nu", "modulus", "c0_over_R", "A")
    endless = {name: dataset[name].values for name in names} | {"a_max_over_R": math.inf}
    wavelengths = np.geomspace(0.05, 1.0, 2000)
    furthest = solve(endless | {"lambda_over_R": wavelengths}, ["pull_off_radius"])["pull_off_radius"].max()
    step = float(force["a_max_over_R"][1] - force["a_max_over_R"][0])
    # 0.003: the wavelengths of the study are near the last one, not it
    assert -0.003 < threshold_of(force) - furthest < step


@pytest.mark.parametrize("name", ["fig6", "fig7"])
def test_the_effective_path_turns_at_the_greatest_depth_along_a_line(name: str, computed: Compute) -> None:
    """From envelope to envelope."""
    dataset = computed(name)
    path, turn = effective_path(dataset)
    k, M, length, A = dataset["k"].item(), material(dataset), dataset["lambda_over_R"].item(), dataset["A"].item()
    depth, load = path["indentation"], path["load"]
    assert depth.max() == pytest.approx(float(dataset["path_indentation"].max()), rel=1e-12)
    line = effective.early_unloading_load(k, M, turn, depth[EARLY], length * A)
    np.testing.assert_allclose(load[EARLY], line, rtol=1e-11)
    assert path["contact_radius"][EARLY].tolist() == [turn, turn]
    # its area is the closed form, but for the chords of 200 points along each envelope
    assert area(depth, load) == pytest.approx(float(effective.dissipated_energy(k, M, length, A, turn)), rel=CHORDS)


def test_fig7_both_paths_turn_and_end_close_to_each_other(computed: Compute) -> None:
    dataset = computed("fig7")
    path, turn = effective_path(dataset)
    radius, depth, load = values(dataset, *(f"path_{part}" for part in ("contact_radius", "indentation", "load")))
    apart = abs(turn - radius.max()) / dataset["lambda_over_R"].item()
    assert 0.4 < apart < 1.0, "less than a wave apart, and seen to be"
    assert abs(path["indentation"][-1] - depth.min()) < 2e-4
    assert 0.6 < area(depth, load) / area(path["indentation"], path["load"]) < 1.0


def test_fig8_the_two_parts_are_those_of_the_closed_form(computed: Compute) -> None:
    dataset = computed("fig8")
    numbers = (dataset["k"].item(), material(dataset), dataset["lambda_over_R"].item(), dataset["A"].item())
    first, second = parts_of(dataset)
    expected = effective.first_part(*numbers), effective.second_part(*numbers, dataset["a_max_over_R"].item())
    assert [area(*first), area(*second)] == pytest.approx([float(part) for part in expected], rel=CHORDS)


@pytest.mark.parametrize("name", ["extra_energy_amplitude", "extra_energy_wavelength", "extra_energy_map", "fig9", "extra_energy_exponent"])  # fmt: skip
def test_the_energy_is_johnsons_without_waves_and_grows_with_them(name: str, computed: Compute) -> None:
    """int P d(delta) of JKR between the jumps: 7.0922 (dgamma^5 R^4/E*^2)^(1/3)."""
    lost = computed(name)["dissipated_energy"]
    falls = (lost.sel(solver="exact").diff("k") < 0).all()
    assert falls == (name != "extra_energy_exponent"), "up to the Gibson solid for an incompressible half-space only"
    if lost["A"].ndim and lost["A"].min() == 0.0:
        still = lost.sel(A=0.0)
        np.testing.assert_allclose(still.sel(solver="exact"), still.sel(solver="envelope"), rtol=1e-12)
        smooth = still.sel(k=0.0) * 500.0 ** (2 / 3)
        assert smooth.values.ravel().tolist() == pytest.approx([7.0922] * smooth.size, abs=5e-5)
        assert (lost.sel(solver="envelope").diff("A") > 0).all()
        lost = lost.isel(A=slice(1, None))
    if lost["lambda_over_R"].ndim:
        assert (lost.sel(solver="envelope").diff("lambda_over_R") > 0).all()


def test_fig9_the_papers_fits_are_as_far_from_the_closed_form_as_the_study_says(computed: Compute) -> None:
    dataset = computed("fig9", "k={ start = 0.0, stop = 1.0, num = 11 }")
    closed = dataset["dissipated_energy"].sel(solver="envelope")
    off = []
    for A in dataset["A"].values:
        for length in dataset["lambda_over_R"].values:
            k, fitted = fitted_curve(dataset, A, length)
            off.append(fitted / closed.sel(A=A, lambda_over_R=length).sel(k=k, method="nearest") - 1.0)
    assert np.max(off) == pytest.approx(0.031, abs=5e-4)
    assert np.min(off) > -0.004


def test_the_best_exponent_is_that_of_fig4a_and_none_where_the_gradient_is_deep(computed: Compute) -> None:
    best = computed("extra_best_exponent")["best_k"]
    assert best.sel(nu=0.3, c0_over_R=0.01).item() == pytest.approx(0.7, abs=0.05)
    assert best.sel(nu=0.0, c0_over_R=0.1) == 0.0


def test_the_best_force_depends_on_the_amplitude_most(computed: Compute) -> None:
    best = computed("extra_best_wavelength")
    slopes = best["best_pull_off_force_sensitivity"]
    assert bool((slopes.sel(parameter="A") > 2.0 * slopes.sel(parameter="modulus")).all())
    np.testing.assert_allclose(slopes.sel(parameter="lambda_over_R"), 0.0, atol=1e-13)
    assert (np.diff(best["best_lambda_over_R"]) < 0.0).all()


def test_a_front_ends_in_the_best_of_each(computed: Compute) -> None:
    front = computed("extra_front")
    fixed = {name: front[name].item() for name in ("nu", "modulus", "c0_over_R", "a_max_over_R")}
    for k in front["k"].values:
        one = front.sel(k=k)
        own = {"k": k, "lambda_over_R": np.geomspace(0.05, 1.0, 150)[:, None], "A": np.linspace(0.005, 0.02, 40)}
        grid = solve(fixed | own, ["pull_off_force", "dissipated_energy"])
        force, energy = one["best_pull_off_force"].values, one["best_dissipated_energy"].values
        assert np.nanmax(force) >= grid["pull_off_force"].max()
        assert np.nanmax(energy) >= grid["dissipated_energy"].max() * (1.0 - 1e-9)
        # points between those of the sweep may excel it, but by little
        others = {name: values.ravel()[:, None] for name, values in grid.items()}
        near = (force >= 0.99 * others["pull_off_force"]) & (energy >= 0.98 * others["dissipated_energy"])
        assert near.any(axis=1).all()
    assert bool((front["best_dissipated_energy"].max("pareto_point").diff("k") < 0.0).all()), "gradients cost energy"


def test_fig6_two_waves_are_not_bounded_by_their_envelopes(computed: Compute) -> None:
    """Where the curve of Fig. 3a crosses them: the study and docs/paper.md quote these depths."""
    one = scene(computed("fig6"))
    k, length, A, M = one["k"], one["lambda_over_R"], one["A"], material(computed("fig6"))
    s, r, mean = envelopes.adhesion_strength(k, M), envelopes.waviness_strength(k, length, A), length * A

    def above(radius: float, strength: float) -> float:
        """The load of the curve less that of the envelope at the same depth."""
        depth = float(jkr.indentation(k, M, radius, length, A))
        at = brentq(lambda a: float(envelopes.indentation(k, a, strength, mean)) - depth, 0.12, 1.0)
        return float(jkr.load(k, M, radius, length, A)) - float(envelopes.load(k, M, at, strength))

    crossings = [brentq(above, *ends, args=(s - r,)) for ends in ((0.235, 0.26), (0.26, 0.29), (0.41, 0.449))]
    depths = jkr.indentation(k, M, crossings, length, A)
    np.testing.assert_allclose(depths, [0.037, 0.066, 0.138], atol=6e-4)
    assert above(0.262, s - r) > 0.05
    assert above(0.449, s - r) > 0.15
    assert above(0.17294, s + r) == pytest.approx(-0.013, abs=6e-4)  # the state K, at the lowest depth
