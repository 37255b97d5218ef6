"""Laws of the theory that hold for every kind: similarity, the sum of the parts, drawn paths, rims and turns."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import FLAGS, draw_curves

from .kinds import BY_NAME, DEPTH, EXACT, KINDS, LOAD, Kind, Scenes, at, drawn, name_of, rng_of, some
from .promises import CLOSE, NO_CONTACT, NO_VALUE, SHARE, agree, depth_size, errors, has, load_size, reached, turn_error
from .theory import FORCE, Curve, stiffness

EVERY = pytest.mark.parametrize("kind", KINDS, ids=name_of)
EVERY_EXACT = pytest.mark.parametrize("kind", EXACT, ids=name_of)
SOME = slice(80)


def rescaled(kind: Kind, scenes: Scenes, c: Any) -> Scenes:
    """The same reduced problem with all radii c times as large; R stays, so that depths are c^m times as large.

    lambda, a ~ c;  A ~ c^(m-1);  M ~ c^(1-k-2m) from Delta ~ c^m;  S ~ M a^(1+k) ~ c^(2-2m), in units of E*.
    """
    k, m = scenes["k"], kind.exponent
    other = dict(scenes)
    for name in ("lambda_over_R", "a_max_over_R", "toughness_wavelength_over_R"):
        if name in scenes:
            other[name] = scenes[name] * c
    other["A"] = scenes["A"] * c ** (m - 1)
    other["modulus"] = scenes["modulus"] * c ** (1 - k - 2 * m)
    if "machine_stiffness" in scenes:
        other["machine_stiffness"] = scenes["machine_stiffness"] * c ** (1 + k)
    if DEPTH in scenes:
        other[DEPTH] = scenes[DEPTH] * c**m
    if LOAD in scenes:
        other[LOAD] = scenes[LOAD] * c ** (2 - m)
    return other


def values_rescaled(kind: Kind, found: Any, c: Any) -> dict[str, Any]:
    """Forces ~ c^(2-m), depths ~ c^m, energies ~ dgamma a^2."""
    powers = dict.fromkeys(("pull_off_force", "snap_in_force"), 2 - kind.exponent)
    powers |= dict.fromkeys(("pull_off_radius", "turning_radius"), 1.0)
    powers |= dict.fromkeys(("delta_max", "delta_jump_out", "pinned_depth"), kind.exponent)
    powers["contact_slope"] = kind.exponent - 1
    powers |= dict.fromkeys(("dissipated_energy", "loading_energy", "unloading_energy", "front_energy"), 2.0)
    return {name: values * c ** powers[name] if name in powers else values for name, values in found.items()}


@EVERY
def test_similarity(kind: Kind) -> None:
    """Three numbers decide everything: scenes with the same ones have the same reduced values."""
    scenes, found = drawn(kind)
    c = 2.0 ** rng_of(f"similar {kind.name}").integers(-3, 4, found["status"].size)
    other = rescaled(kind, scenes, c)
    agree(kind, other, kind.solve(other), values_rescaled(kind, found, c))


@EVERY
def test_one_number_is_the_material(kind: Kind) -> None:
    """nu, E* and c0 enter through M = theta(k, nu) E*/c0^k alone."""
    scenes, found = drawn(kind)
    rng = rng_of(f"material {kind.name}")
    c0 = scenes["c0_over_R"] * np.exp(rng.uniform(-1, 1, found["status"].size))
    nu = np.where(scenes["k"] > 0.98, scenes["nu"], rng.uniform(-0.4, 0.45, found["status"].size))
    before = stiffness(scenes["k"], scenes["nu"], 1.0, scenes["c0_over_R"])
    factor = before / stiffness(scenes["k"], nu, 1.0, c0)
    other = scenes | {"c0_over_R": c0, "nu": nu, "modulus": scenes["modulus"] * factor}
    if "machine_stiffness" in scenes:
        other["machine_stiffness"] = scenes["machine_stiffness"] / factor
    agree(kind, other, kind.solve(other), found)


@EVERY
def test_a_series_in_another_wavelength(kind: Kind) -> None:
    """n waves in lambda are 2 n waves in 2 lambda, with half the amplitude over lambda."""
    scenes, found = drawn(kind)
    doubled = at(kind, waves=tuple((2 * n, even, odd) for n, even, odd in kind.waves))
    other = scenes | {"lambda_over_R": 2 * scenes["lambda_over_R"], "A": 0.5 * scenes["A"]}
    agree(kind, scenes, doubled.solve(other), found)


@EVERY
def test_zero_waves_are_no_waves(kind: Kind) -> None:
    """A harmonic without an amplitude changes nothing, and one cosine may be written as a series."""
    scenes, found = drawn(kind)
    longer = at(kind, waves=(*kind.waves, (9, 0.0, 0.0)))
    agree(kind, some(scenes, SOME), longer.solve(some(scenes, SOME)), some(found, SOME))


@EVERY
def test_parts_are_all_that_is_lost(kind: Kind) -> None:
    scenes, found = drawn(kind)
    total = found["loading_energy"] + found["unloading_energy"] + found.get("front_energy", 0.0)
    agree(kind, scenes, dict(found) | {"dissipated_energy": total}, found, ["dissipated_energy"])
    if kind.ratio:
        area = np.pi * found["turning_radius"] ** 2 * (1 - scenes["closing_ratio"])
        if not kind.pattern:
            agree(kind, scenes, dict(found) | {"front_energy": area}, found, ["front_energy"])
    elif "front_energy" in found:
        assert not found["front_energy"][~has(found, NO_VALUE)].any()


@EVERY
def test_unloading_always_loses(kind: Kind) -> None:
    scenes, found = drawn(kind)
    sure = ~has(found, NO_VALUE | NO_CONTACT)
    assert (found["unloading_energy"] >= -errors(kind, scenes, found)["unloading_energy"])[sure].all()
    assert (found["unloading_jumps"] >= 0)[sure].all()
    assert (found["pull_off_force"] > 0)[sure].all()


@EVERY_EXACT
def test_the_losses_are_the_loop_integral(kind: Kind) -> None:
    if kind.control == "load":
        pytest.skip("under a dead load the cycle is not closed")
    scenes, found = drawn(kind)
    residual = kind.solve(some(scenes, SOME), ["energy_residual", "dissipated_energy"])
    # the loop integral is a sum of products of load and depth, each good to the promise
    end, own = reached(found)[SOME], some(scenes, SOME)
    work = FORCE * load_size(kind, own, end) * depth_size(kind, own, end)
    if kind.control == "machine":
        work = work + (FORCE * load_size(kind, own, end)) ** 2 / (own["machine_stiffness"] * own["modulus"])
    known = np.isfinite(residual["energy_residual"])
    limit = (10 * SHARE * work + 2 * errors(kind, own, some(found, SOME))["dissipated_energy"])[known]
    assert known.mean() > 0.5
    assert (np.abs(residual["energy_residual"][known]) <= limit).all(), np.nanmax(np.abs(residual["energy_residual"]))


def is_nested(kind: Kind) -> bool:
    """Tell whether a kind has rims that cut it."""
    return not kind.unbounded and not kind.turn


@pytest.mark.parametrize("kind", [kind for kind in EXACT if is_nested(kind)], ids=name_of)
def test_a_wider_rim_never_holds_less(kind: Kind) -> None:
    scenes, _ = drawn(kind)
    own = some(scenes, slice(40))
    rims = own["a_max_over_R"][:, None] * np.linspace(0.2, 1.2, 9)
    wide = {name: values[:, None] for name, values in own.items()} | {"a_max_over_R": rims}
    found = kind.solve(wide, kind.outputs)
    force, size = found["pull_off_force"], errors(kind, wide, found)["pull_off_force"]
    assert (np.diff(force, axis=1) >= -2 * np.maximum(size[:, 1:], size[:, :-1])).all()


@pytest.mark.parametrize("kind", [kind for kind in EXACT if is_nested(kind)], ids=name_of)
def test_rims_side_by_side_have_continuous_values(kind: Kind) -> None:
    """Force and energy are continuous in the rim; at most by the loss density of its annulus, 2 pi a da (1 + rho^2)."""
    scenes, found = drawn(kind)
    step = 1e-7
    other = scenes | {"a_max_over_R": scenes["a_max_over_R"] * (1 + step)}
    near = kind.solve(other)
    rim = scenes["a_max_over_R"]
    work = FORCE * load_size(kind, scenes, rim) * depth_size(kind, scenes, rim)
    if kind.control == "machine":
        work = work + (FORCE * load_size(kind, scenes, rim)) ** 2 / (scenes["machine_stiffness"] * scenes["modulus"])
    if kind.control == "load":
        work = work * (1 + kind.exponent)
    limit = 4 * step * (np.pi * rim**2 + work * (kind.waves_per_wavelength * 2 * np.pi * rim / scenes["lambda_over_R"] + 4))
    assert (np.abs(near["dissipated_energy"] - found["dissipated_energy"]) <= limit).all()
    slope = load_size(kind, scenes, rim) * (kind.waves_per_wavelength * 2 * np.pi * rim / scenes["lambda_over_R"] + 4)
    assert (np.abs(near["pull_off_force"] - found["pull_off_force"]) <= 4 * step * slope).all()


@pytest.mark.parametrize("kind", [kind for kind in EXACT if kind.turn], ids=name_of)
def test_a_turn_is_a_rim_where_it_turns(kind: Kind) -> None:
    scenes, found = drawn(kind)
    turned = (found["turning_radius"] > 0) & (found["turning_radius"] < scenes["a_max_over_R"])
    assert turned.sum() >= 10
    rims = {n: v for n, v in some(scenes, turned).items() if n != kind.turn}
    rims["a_max_over_R"] = found["turning_radius"][turned]
    own = some(found, turned)
    other = at(kind, turn="").solve(rims)
    names = [name for name in kind.outputs if name not in ("loading_jumps", "unloading_jumps")]
    agree(kind, some(scenes, turned), other, own, names)
    counts = (other["loading_jumps"] == own["loading_jumps"]) & (other["unloading_jumps"] == own["unloading_jumps"])
    assert counts.all()


@pytest.mark.parametrize("kind", [kind for kind in EXACT if not kind.turn], ids=name_of)
@pytest.mark.parametrize("turn", [DEPTH, LOAD])
def test_a_turn_at_what_loading_reaches_is_a_rim_there(kind: Kind, turn: str) -> None:
    """Points of drawn loading paths, whose depth or load no earlier one has, against rims at their radii."""
    rng = rng_of(f"reach {turn} {kind.name}")
    scenes, found = drawn(kind)
    turns = []
    for i in rng.permutation(np.flatnonzero(found["loading_jumps"] > 0))[:12]:
        one = {name: float(values[i]) for name, values in scenes.items()}
        path, _ = draw_curves(one, ["path"], **kind.how)
        loading = path["path_unloading"] == 0
        a, on = path["path_contact_radius"][loading], path["path_jump"][loading] == 0
        measured = path["path_indentation" if turn == DEPTH else "path_load"][loading]
        before = np.maximum.accumulate(np.append(-np.inf, measured[:-1]))
        first = np.flatnonzero(on & (measured > before + 1e-3 * np.ptp(measured)) & (measured > 0))
        # a point within a jump may have what is measured as well: the straight line of a jump is not followed
        free = [j for j in first if 0 < j < a.size - 1 and on[j + 1] and 0 < a[j] < a[-1]]
        turns += [(i, a[j], measured[j]) for j in rng.choice(free, min(2, len(free)), replace=False)] if free else []
    assert len(turns) >= 3
    index, radii, values = (np.array(column) for column in zip(*turns, strict=True))
    own = some(scenes, index)
    turned, wide = at(kind, turn=turn), own | {turn: values}
    result = turned.solve(wide)
    moved = np.maximum(1e-9 * radii, 20 * turn_error(turned, wide, radii))  # what is drawn is good to 1e-11 of its terms
    assert (np.abs(result["turning_radius"] - radii) <= moved).all()
    rim = kind.solve(own | {"a_max_over_R": result["turning_radius"]})
    names = [name for name in kind.outputs if name != "contact_slope"]
    agree(turned, wide, rim, result, names)


@EVERY_EXACT
def test_the_drawn_path(kind: Kind) -> None:
    """It is in equilibrium, its jumps are those that are counted, and they lose what is lost; its area is the loss."""
    scenes, found = drawn(kind)
    rng = rng_of(f"path {kind.name}")
    for i in rng.permutation(np.flatnonzero(~has(found, NO_VALUE | NO_CONTACT | CLOSE)))[:6]:
        one = {name: float(values[i]) for name, values in scenes.items()}
        values = {name: array[[i]] for name, array in found.items()}
        drawn_curves, status = draw_curves(one, ["path", "jumps"], **kind.how)
        assert status & NO_VALUE == 0
        unloading = drawn_curves["jump_unloading"] == 1
        energies = drawn_curves["jump_energy"]
        out = int(kind.control == "load")  # the jump out of a dead load is not listed
        assert (~unloading).sum() == values["loading_jumps"][0], one
        assert unloading.sum() + out * (found["unloading_jumps"][i] > 0) == values["unloading_jumps"][0], one
        sums = {"loading_energy": energies[~unloading].sum(), "unloading_energy": energies[unloading].sum()}
        sums = {name: np.array([value]) for name, value in sums.items()}
        agree(kind, {n: v[[i]] for n, v in scenes.items()}, values | sums, values, list(sums))
        in_equilibrium(kind, one, drawn_curves)
        if kind.control != "load" and np.isfinite(values["turning_radius"][0]):
            has_the_area(kind, one, drawn_curves, float(values["dissipated_energy"][0]))


def in_equilibrium(kind: Kind, scene: Scenes, path: Any) -> None:
    """Points of the drawn path are on the curve of the definitions, by SciPy: good to 1e-11 of the sizes of terms."""
    a, depth, load = (path[f"path_{name}"] for name in ("contact_radius", "indentation", "load"))
    end = a.max()
    inside = (a > 0) & (a < end)
    for unloading in (0, 1):
        curve = Curve(kind, scene, closing=not unloading)
        on = inside & (path["path_unloading"] == unloading) & (path["path_jump"] == 0)
        if on.sum() < 3:
            continue
        radii, size = a[on][1:-1], depth_size(kind, scene, a[on][1:-1])
        off = np.abs(curve.depth(radii) - depth[on][1:-1]) / size
        assert off.max(initial=0.0) <= 1e-11, scene
        off = np.abs(curve.load(radii) - load[on][1:-1]) / load_size(kind, scene, radii)
        assert off.max(initial=0.0) <= 1e-11, scene


def has_the_area(kind: Kind, scene: Scenes, path: Any, energy: float) -> None:
    """The area of the drawn polygon: chords stay within 2e-4 of the span, so 2/3 of that times the length is left."""
    depth, load = path["path_indentation"], FORCE * path["path_load"]
    if kind.control == "machine":
        depth = depth + load / (scene["machine_stiffness"] * scene["modulus"])
    area = float(np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(depth)))
    scale = np.ptp(depth) * np.ptp(load)
    moved = np.hypot(np.diff(depth) / np.ptp(depth), np.diff(load) / np.ptp(load))
    assert abs(area - energy) <= 2e-4 * scale * moved.sum(), scene


@pytest.mark.parametrize("name", ["cosine", "sines, machine", "exponent 1.5"])
def test_flags_of_the_rim(name: str) -> None:
    """pull_off_at_rim: the pull-off radius is the rim; jump_in_to_rim: full contact by one jump."""
    kind = BY_NAME[name]
    scenes, found = drawn(kind)
    at_rim = has(found, FLAGS["pull_off_at_rim"])
    assert np.array_equal(at_rim, found["pull_off_radius"] >= scenes["a_max_over_R"] * (1 - 1e-9))
    assert at_rim.any() and not at_rim.all()
    into = has(found, FLAGS["jump_in_to_rim"])
    assert into.any()
    assert (found["loading_jumps"][into] == 1).all()
