"""Every study of a figure gives what is known of it by other means: closed forms, scaling, areas, the paper's text."""

import math
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray
from numpy.typing import NDArray

from figures.fig4 import threshold_of
from figures.fig8 import parts_of
from gradhesion.core import PARAMETERS, solve
from gradhesion.core.equations import energy, envelopes, hertz
from gradhesion.core.material import stiffness
from gradhesion.core.status import LOADING_NOT_ONE_DISC

Compute = Callable[..., xarray.Dataset]
Values = NDArray[np.float64]
ROOT = Path(__file__).parents[2]
CONFIGS = sorted((ROOT / "configs").glob("fig*.toml"))
FORCE = 1.5 * math.pi
"""The unit of loads, in R dgamma."""
CHORDS = 1e-3
"""Five times what a chord of a curve is off, of the span that is drawn (core/curves)."""


def values(dataset: xarray.Dataset, *names: str) -> list[Values]:
    columns = [np.asarray(dataset[name].values, dtype=float) for name in names]
    return [column[~np.isnan(columns[0])] for column in columns]


def area(x: Values, y: Values) -> float:
    """The area within a closed line, in R^2 dgamma."""
    return FORCE * abs(float(np.sum(0.5 * (y + np.roll(y, -1)) * (np.roll(x, -1) - x))))


def scene(dataset: xarray.Dataset) -> dict[str, float]:
    return {
        name: dataset[name].item() for name in ("k", "nu", "modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R")
    }


def material(dataset: xarray.Dataset) -> float:
    return float(stiffness(*(dataset[name].item() for name in ("k", "nu", "modulus", "c0_over_R"))))


def ratio(dataset: xarray.Dataset) -> float:
    """The largest r/s of its scenes."""
    k = np.atleast_1d(dataset["k"].values)
    M = stiffness(k, *(dataset[name].item() for name in ("nu", "modulus", "c0_over_R")))
    r = envelopes.waviness_strength(k, dataset["lambda_over_R"].values.max(), dataset["A"].values.max())
    return float((r / envelopes.adhesion_strength(k, M)).max())


@pytest.mark.parametrize("config", CONFIGS, ids=lambda path: path.stem)
def test_every_study_says_what_it_shows_and_that_its_values_are_chosen(config: Path) -> None:
    text = config.read_text()
    comment = " ".join(line.removeprefix("#").strip() for line in text.splitlines() if line.startswith("#"))
    assert comment.startswith(f"Fig. {config.stem.removeprefix('fig')[0]}")
    assert "chosen" in comment or "The paper does not print its values; these are those of" in comment
    assert 15 <= len(text.splitlines()) <= 30
    assert "Fig. " in tomllib.loads(text)["title"]


@pytest.mark.parametrize("config", CONFIGS, ids=lambda path: path.stem)
def test_nothing_is_to_be_reported_of_any_scene(config: Path, computed: Compute) -> None:
    status = computed(config.stem)["status"].values
    assert not (status & ~np.int8(4 if config.stem == "fig4c" else 0)).any()  # 4: the pull-off is at the rim


@pytest.mark.parametrize("name", ["fig2a", "fig2b", "fig3", "fig5", "fig6", "fig7", "fig8"])
def test_the_contact_of_every_curve_stays_one_disc(name: str, computed: Compute) -> None:
    dataset = computed(name)
    parameters = {key: dataset[key].values for key in PARAMETERS}
    assert not (solve(parameters, ["dissipated_energy"])["status"] & LOADING_NOT_ONE_DISC).any()


@pytest.mark.parametrize("name", ["fig2a", "fig3", "fig7"])
def test_every_jump_of_loading_leaves_one_disc(name: str, computed: Compute) -> None:
    """The sufficient condition, delta_H(s) >= delta for all s outside the contact, at every fold of loading."""
    of_path = computed("fig3", "a_max_over_R=0.35") if name == "fig2a" else computed(name)
    radius, depth, jump, back = values(
        of_path, *(f"path_{part}" for part in ("contact_radius", "indentation", "jump", "unloading"))
    )
    folds = np.flatnonzero((jump > 0.5) & (back < 0.5))[1:] - 1  # at the first the gap is the profile
    assert folds.size >= 2
    for fold in folds:
        outside = np.linspace(radius[fold], of_path["a_max_over_R"].item(), 2001)[1:]
        without = hertz.indentation(of_path["k"].item(), outside, of_path["lambda_over_R"].item(), of_path["A"].item())
        assert np.min(without) > depth[fold]


def test_fig2a_the_smooth_punch_pulls_off_at_its_closed_form(computed: Compute) -> None:
    dataset = computed("fig2a")
    assert float(dataset["smooth_load"].min()) == pytest.approx(-(3 + 0.3) / 3, rel=1e-13)
    assert ratio(dataset) == pytest.approx(0.50, abs=0.005)


def test_fig2b_contact_of_the_smooth_punch_is_lost_at_its_closed_form(computed: Compute) -> None:
    dataset = computed("fig2b")
    k = dataset["k"].item()
    smooth = dataset.sel(A=0.0)
    last = int(np.nanargmin(smooth["indentation"].values))
    # P is a parabola in X = a^((3+k)/2): at the least depth it is this share of its minimum, 5/9 for k = 0
    share = (1 - k) * (5 + 3 * k) / (3 + k) ** 2
    assert float(smooth["load"][last]) == pytest.approx(-share * (3 + k) / 3, rel=1e-12)
    branches = (dataset["stable"] == 1).astype(int).diff("point").clip(min=0).sum("point")
    assert branches.values.tolist() == [1, 1, 4, 4]


def test_fig3_the_loop_is_the_energy(computed: Compute) -> None:
    dataset = computed("fig3")
    depth, load = values(dataset, "path_indentation", "path_load")
    expected = float(solve(scene(dataset), ["dissipated_energy"])["dissipated_energy"])
    assert area(depth, load) == pytest.approx(expected, rel=CHORDS)


def test_fig4a_the_best_exponent_is_that_of_the_paper(computed: Compute) -> None:
    dataset = computed("fig4a")
    greatest = dataset["pull_off_force"].max("lambda_over_R")
    assert float(greatest.idxmax("k")) == 0.7
    smooth = computed("fig4a", "A=0.0")["pull_off_force"]
    np.testing.assert_allclose(smooth, ((3 + smooth["k"]) / 3).broadcast_like(smooth), rtol=1e-13)


def test_fig4b_the_force_grows_as_the_gradient_gets_shallow_and_its_depth_is_a_factor_of_the_modulus(
    computed: Compute,
) -> None:
    force = computed("fig4b")["pull_off_force"]
    greatest = force.max("lambda_over_R").values
    assert (np.diff(greatest) < 0).all()
    stiffer = computed("fig4b", f"modulus={500.0 * 1000.0**0.3!r}")["pull_off_force"]
    np.testing.assert_allclose(stiffer.sel(c0_over_R=1.0), force.sel(c0_over_R=0.001), rtol=1e-11)


def test_fig4c_the_threshold_is_the_furthest_radius_of_the_pull_off(computed: Compute) -> None:
    dataset = computed("fig4c")
    force = dataset["pull_off_force"]
    unbounded = {name: dataset[name].values for name in ("k", "nu", "modulus", "c0_over_R", "A")} | {
        "a_max_over_R": math.inf
    }
    wavelengths = np.geomspace(0.05, 1.0, 2000)
    furthest = solve(unbounded | {"lambda_over_R": wavelengths}, ["pull_off_radius"])["pull_off_radius"].max()
    assert furthest == pytest.approx(0.574, abs=5e-4)
    step = float(force["a_max_over_R"][1] - force["a_max_over_R"][0])
    assert (
        -0.003 < threshold_of(force) - furthest < step
    )  # 0.003: the wavelengths of the study are near the last one, not it
    limit = solve(unbounded | {"lambda_over_R": force["lambda_over_R"].values}, ["pull_off_force"])["pull_off_force"]
    np.testing.assert_allclose(force.isel(a_max_over_R=-1), limit, rtol=1e-13)


def test_fig5_the_asymptotic_curve_is_off_by_a_few_per_cent_at_the_longest_wave_only(computed: Compute) -> None:
    dataset = computed("fig5")
    errors = []
    for i in range(3):
        one = dataset.isel(lambda_over_R=i)
        radius, load = values(one, "contact_radius", "load")
        other, asymptotic = values(one, "asymptotic_contact_radius", "asymptotic_load")
        grid = np.linspace(0.1, 0.3, 400)
        wave = envelopes.waviness_strength(one["k"], one["lambda_over_R"], one["A"])
        swing = float(hertz.disc_stiffness(one["k"], material(one), 0.3) * wave * 0.3**0.35)
        errors.append(np.max(np.abs(np.interp(grid, radius, load) - np.interp(grid, other, asymptotic))) / swing)
    assert 0.02 < errors[0] < 0.2
    assert errors[0] > 1.5 * errors[1] > 3 * errors[2]
    np.testing.assert_allclose([ratio(dataset.isel(lambda_over_R=i)) for i in range(3)], [0.50, 0.32, 0.11], atol=0.005)


def test_fig6_folds_lie_within_the_envelopes_close_to_them(computed: Compute) -> None:
    dataset = computed("fig6")
    radius, depth = (
        column[np.asarray(dataset["contact_radius"]) > 0.1]
        for column in values(dataset, "contact_radius", "indentation")
    )
    place, upper, lower = values(
        dataset, "envelope_contact_radius", "loading_envelope_indentation", "unloading_envelope_indentation"
    )
    crests = [i for i in range(1, radius.size - 1) if depth[i] > max(depth[i - 1], depth[i + 1])]
    troughs = [i for i in range(1, radius.size - 1) if depth[i] < min(depth[i - 1], depth[i + 1])]
    assert len(crests) >= 8
    assert len(troughs) >= 8
    width = np.interp(radius, place, upper - lower)
    below = (np.interp(radius, place, upper) - depth) / width
    above = (depth - np.interp(radius, place, lower)) / width
    for distance in (below[crests], above[troughs]):
        assert distance.min() > -0.01
        assert distance.max() < 0.1


def test_fig7_the_punch_is_twice_as_wide_as_the_jump_in_and_the_exact_loop_is_within_the_effective_one(
    computed: Compute,
) -> None:
    dataset = computed("fig7")
    radius, depth, load, jump = values(
        dataset, *(f"effective_{part}" for part in ("contact_radius", "indentation", "load", "jump"))
    )
    entry = radius[np.flatnonzero(jump > 0.5)[0]]
    assert radius.max() == pytest.approx(2.0 * entry, rel=1e-12)
    exact, pull = values(dataset, "path_indentation", "path_load")
    assert area(exact, pull) == pytest.approx(
        float(solve(scene(dataset), ["dissipated_energy"])["dissipated_energy"]), rel=CHORDS
    )
    assert 0.6 < area(exact, pull) / area(depth, load) < 1.0


def test_fig8_the_two_parts_are_those_of_the_closed_form(computed: Compute) -> None:
    dataset = computed("fig8")
    numbers = (dataset["k"].item(), material(dataset), dataset["lambda_over_R"].item(), dataset["A"].item())
    first, second = parts_of(dataset)
    assert area(*first) == pytest.approx(float(energy.first_part(*numbers)), rel=CHORDS)
    assert area(*second) == pytest.approx(
        float(energy.second_part(*numbers, dataset["a_max_over_R"].item())), rel=CHORDS
    )


def test_fig9a_the_energy_falls_with_the_exponent_and_is_johnsons_without_waves(computed: Compute) -> None:
    lost = computed("fig9a")["dissipated_energy"]
    assert (lost.diff("k") < 0).all()
    assert (lost.sel(solver="envelope").diff("A") > 0).all()
    assert ratio(computed("fig9a")) < 0.5
    np.testing.assert_allclose(lost.sel(A=0.0, solver="exact"), lost.sel(A=0.0, solver="envelope"), rtol=1e-12)
    # int P d(delta) of JKR between the jumps: 7.0922 (dgamma^5 R^4/E*^2)^(1/3)
    assert float(lost.sel(A=0.0, k=0.0, solver="exact")) * 500.0 ** (2 / 3) == pytest.approx(7.0922, abs=5e-5)


def test_fig9b_the_energy_falls_with_the_exponent_and_tends_to_that_of_the_envelopes(computed: Compute) -> None:
    lost = computed("fig9b")["dissipated_energy"]
    assert (lost.diff("k") < 0).all()
    assert (lost.sel(solver="envelope").diff("lambda_over_R") > 0).all()
    share = lost.sel(solver="exact") / lost.sel(solver="envelope")
    assert (share < 1).all()
    assert (share.isel(lambda_over_R=0) > 0.95).all()
    assert (share.isel(lambda_over_R=0) > share.isel(lambda_over_R=-1)).all()


def test_fig9_without_waves_the_energy_is_that_of_the_smooth_punch(computed: Compute) -> None:
    """At A = 0 the wavelength is nothing, and both solvers give the closed form: 7.0922 at k = 0."""
    lost = computed("fig9")["dissipated_energy"]
    still = lost.sel(A=0.0, k=0.0) * 500.0 ** (2 / 3)
    assert still.values.ravel().tolist() == pytest.approx([7.0922] * still.size, abs=5e-5)
    assert (lost.sel(solver="exact").diff("k") < 0).all()
    assert (lost.sel(solver="envelope").isel(A=slice(1, None)).diff("lambda_over_R") > 0).all()
