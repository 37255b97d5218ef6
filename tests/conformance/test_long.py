"""A thousand to a hundred thousand waves within one contact, where nothing can be walked: similarity, sums and limits."""

import math
from typing import Any

import numpy as np
import pytest

from gradhesion.core import draw_curves

from .kinds import DEPTH, ONE, TWO, Kind, Scenes, at, rng_of
from .promises import agree, errors
from .test_laws import rescaled, values_rescaled
from .theory import stiffness, stretch, wave_size

WAVES = np.array([1e3, 5e3, 3e4, 1e5])
LONG = (Kind("long"), Kind("long, two harmonics", waves=TWO), Kind("long, machine", control="machine"))
EVERY = pytest.mark.parametrize("kind", [*LONG, Kind("long, two works", ratio=True)], ids=lambda kind: kind.name)


def long(rng: np.random.Generator, kind: Kind, waves: Any = WAVES, chi: Any = None) -> Scenes:
    """Scenes with that many waves within the rim, most of which fold."""
    waves = np.asarray(waves)
    count = waves.size
    k, nu, modulus, c0 = rng.choice([0.0, 0.2, 0.55, 0.9], count), np.full(count, 0.3), rng.uniform(50, 900, count), 0.05
    M = stiffness(k, nu, modulus, c0)
    rim = M ** (-1 / (3 + k)) * rng.uniform(1.5, 2.5, count)
    wavelength = rim / waves
    size = rng.uniform(0.15, 0.7, count) if chi is None else chi
    A = size * stretch(k, M) / wave_size(k, 1.0, wavelength)
    scenes: Scenes = {"k": k, "nu": nu, "modulus": modulus, "c0_over_R": np.full(count, c0), "lambda_over_R": wavelength}
    scenes |= {"A": A, "a_max_over_R": rim}
    scenes |= {"machine_stiffness": rng.uniform(0.1, 3.0, count)} if kind.control == "machine" else {}
    scenes |= {"closing_ratio": rng.uniform(0.3, 0.9, count)} if kind.ratio else {}
    return scenes


@EVERY
def test_similarity(kind: Kind) -> None:
    rng = rng_of(f"similar {kind.name}")
    scenes = long(rng, kind)
    c = 2.0 ** rng.integers(1, 4, WAVES.size)
    other = rescaled(kind, scenes, c)
    names = [name for name in kind.outputs if "jumps" not in name]
    agree(kind, other, kind.solve(other), values_rescaled(kind, kind.solve(scenes), c), names)


@EVERY
def test_counts_are_those_of_similar_scenes(kind: Kind) -> None:
    """Of so many jumps one decision in 1e5 may lie within the promise of a tie: the count may differ by as much."""
    rng = rng_of(f"counts {kind.name}")
    scenes = long(rng, kind)
    found, other = kind.solve(scenes), kind.solve(rescaled(kind, scenes, 2.0))
    for name in ("loading_jumps", "unloading_jumps"):
        assert (found[name] > 20).any()
        assert (np.abs(found[name] - other[name]) <= 1).all()


@EVERY
def test_alone_and_beside(kind: Kind) -> None:
    scenes = long(rng_of(f"beside {kind.name}"), kind)
    found = kind.solve(scenes)
    names = [name for name in kind.outputs if "jumps" not in name]
    for i in range(WAVES.size):
        one = {name: values[[i]] for name, values in scenes.items()}
        agree(kind, one, kind.solve(one), {name: values[[i]] for name, values in found.items()}, names)


@pytest.mark.parametrize("kind", LONG[:2], ids=lambda kind: kind.name)
def test_what_is_lost_is_the_sum_over_the_drawn_jumps(kind: Kind) -> None:
    """A few thousand jumps, listed one by one."""
    scenes = long(rng_of(f"sum {kind.name}"), kind, [900.0, 2500.0])
    found = kind.solve(scenes)
    for i in range(2):
        one = {name: float(values[i]) for name, values in scenes.items()}
        jumps, _ = draw_curves(one, ["jumps"], **kind.how)
        unloading = jumps["jump_unloading"] == 1
        parts = {"loading_energy": ~unloading, "unloading_energy": unloading}
        sums = {name: np.array([jumps["jump_energy"][which].sum()]) for name, which in parts.items()}
        values = {name: array[[i]] for name, array in found.items()}
        agree(kind, {n: v[[i]] for n, v in scenes.items()}, values | sums, values, list(sums), times=4.0)
        assert abs(int(unloading.sum()) - int(found["unloading_jumps"][i])) <= 1


@pytest.mark.parametrize("kind", LONG[:2], ids=lambda kind: kind.name)
def test_beyond_saturation_nothing_is_lost(kind: Kind) -> None:
    """Where the last fold lies within the rim, a wider rim changes no value but the depth that is reached."""
    scenes = long(rng_of(f"saturated {kind.name}"), kind, WAVES[:3], 0.02)
    scenes["a_max_over_R"] *= 0.4
    radius = kind.solve(scenes, ["saturation_radius"])["saturation_radius"]
    near, far = (kind.solve(scenes | {"a_max_over_R": radius * factor}) for factor in (1.001, 3.0))
    names = ("pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out")
    agree(kind, scenes | {"a_max_over_R": radius * 3.0}, near, far, names)
    assert (near["loading_jumps"] == far["loading_jumps"]).all()
    unbounded = kind.solve(scenes | {"a_max_over_R": np.full(3, np.inf)})
    agree(kind, scenes | {"a_max_over_R": radius * 3.0}, unbounded, far, names)


@EVERY
def test_a_wider_rim_loses_no_less_and_holds_no_less(kind: Kind) -> None:
    scenes = long(rng_of(f"rims {kind.name}"), kind)
    rims = scenes["a_max_over_R"][:, None] * np.linspace(0.5, 1.0, 7)
    wide = {name: values[:, None] for name, values in scenes.items()} | {"a_max_over_R": rims}
    found = kind.solve(wide)
    for name in ("pull_off_force", "dissipated_energy"):
        size = errors(kind, wide, found)[name]
        assert (np.diff(found[name], axis=1) >= -2 * np.maximum(size[:, 1:], size[:, :-1])).all(), name


@pytest.mark.parametrize("waves", [ONE, TWO], ids=["one", "two"])
def test_a_turn_is_a_rim_there(waves: Any) -> None:
    kind = Kind("long", turn=DEPTH, waves=waves)
    scenes = long(rng_of(f"turn {len(waves)}"), kind)
    plain = at(kind, turn="")
    deepest = plain.solve(scenes, ["delta_max"])["delta_max"]
    turned = scenes | {DEPTH: 0.6 * deepest}
    found = kind.solve(turned)
    assert (found["turning_radius"] < scenes["a_max_over_R"]).all()
    rims = scenes | {"a_max_over_R": found["turning_radius"]}
    names = ["pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy", "delta_jump_out"]
    agree(kind, turned, plain.solve(rims), found, names)


@pytest.mark.parametrize("k", [0.0, 0.3, 0.9])
def test_saturated_losses_of_fine_and_low_waves(k: float) -> None:
    """4 pi chi a_e^2 c(k) beyond the smooth cycle, section 10, with c(k) an integral over one period."""
    constant = {0.0: 0.052938, 0.3: 0.078240, 0.9: 0.130969}[k]
    M = float(stiffness(k, 0.3, 500.0, 0.07))
    s = float(stretch(k, M))
    chi, off = 0.01, []
    for waves in (1e4, 8e4):
        wavelength = M ** (-1 / (3 + k)) / waves
        A = chi * s / float(wave_size(k, 1.0, wavelength))
        scene = {"k": k, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.07, "lambda_over_R": wavelength, "A": A}
        scene |= {"a_max_over_R": np.inf}
        found = Kind("fine").solve(scene, ["dissipated_energy", "saturation_radius"])
        even = Kind("fine").solve(scene | {"A": 0.0}, ["dissipated_energy"])
        gained = float(found["dissipated_energy"] - even["dissipated_energy"])
        off.append(gained / (4 * math.pi * chi * float(found["saturation_radius"]) ** 2 * constant) - 1)
    assert abs(off[1]) < 0.1, off
