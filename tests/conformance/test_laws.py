"""Laws of the theory that hold for every kind, limits with the values of other theories, scenes beside others, slopes."""

from dataclasses import replace
from typing import Any

import numpy as np

from gradhesion.core import OUTPUTS, PARAMETERS, draw_curves

from .kinds import (
    COUNTS,
    EXACT,
    KINDS,
    SCENES,
    Kind,
    Scenes,
    drawn,
    for_kinds,
    one_of,
    powers_of,
    rescaled,
    rng_of,
    some,
)
from .promises import (
    NO_VALUE,
    SENSITIVITY,
    SHARE,
    agree,
    depth_size,
    errors,
    has,
    is_sure,
    load_size,
    phase_of,
    work_size,
)
from .theory import FORCE, Array, Curve, jump_density, stiffness, stretch

REACH_FARTHER = [
    # waves still fold where the search for the one ends
    (0.76, 0.3806, 243.1, 0.01414, 1.806e-05, 0.0403, 0.9732),
    (0.76, 0.01491, 6.326, 4.729, 1.429e-05, 4.256e-05, np.inf),
    (0.18, 0.1775, 1.04, 1.952, 1.488e-05, 0.001846, 2.616),
    (0.18, 0.1481, 1.335, 2.572, 1.921e-05, 0.02306, np.inf),
    (0.76, 0.007996, 77650.0, 0.004449, 5.813e-05, 0.05437, 1.194),
    (0.76, 0.06749, 550.9, 1.902, 1.626e-05, 7.473e-05, np.inf),
    # waves so faint that the load has a single trough
    (0.32, 0.2972, 40400.0, 0.006701, 0.001735, 1.496e-05, np.inf),
    (0.32, 0.2918, 56740.0, 0.003083, 0.001109, 0.0003233, np.inf),
    (0.46, 0.2695, 10090.0, 0.07659, 0.003054, 2.722e-05, np.inf),
    (0.46, 0.3448, 17280.0, 0.004058, 0.001156, 0.0001069, 0.3042),
]
"""Scenes, and below each a neighbour of the same exponent that must be known farther out."""
EXPONENTS = np.array([0.0, 0.1, 0.37, 0.7, 0.96])
SMOOTH: Scenes = {"k": EXPONENTS, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.07, "lambda_over_R": 0.1, "A": 0.0}
PARABOLOIDS = [k for k in EXACT if k.exponent == 2 and not k.turn and not k.pattern]
EVERY = for_kinds(KINDS)


@for_kinds(KINDS)
def test_the_same_problem_in_other_numbers(kind: Kind) -> None:
    """Three numbers decide everything, among them M = theta(k, nu) E*/c0^k; what has no amplitude is not there."""
    scenes, found = (some(values, slice(SCENES // 2)) for values in drawn(kind))
    rng, k, size = rng_of(f"similar {kind.name}"), scenes["k"], found["status"].size
    c = 2.0 ** rng.integers(-3, 4, size)
    others = {"similar": (kind, rescaled(kind, scenes, k, c), rescaled(kind, found, k, c))}
    c0, nu = scenes["c0_over_R"] * np.exp(rng.uniform(-1, 1, size)), rng.uniform(-0.4, 0.45, size)
    nu = np.where(k > 0.98, scenes["nu"], nu)
    factor = stiffness(k, scenes["nu"], 1.0, scenes["c0_over_R"]) / stiffness(k, nu, 1.0, c0)
    material = scenes | {"c0_over_R": c0, "nu": nu, "modulus": scenes["modulus"] * factor}
    if kind.control == "machine":
        material["machine_stiffness"] = scenes["machine_stiffness"] / factor
    others["of another material"] = (kind, material, found)
    doubled = replace(kind, waves=tuple((2 * n, even, odd) for n, even, odd in kind.waves))
    longer = scenes | {"lambda_over_R": 2 * scenes["lambda_over_R"], "A": 0.5 * scenes["A"]}
    others["in another wavelength"] = (doubled, longer, found)
    others["with an empty wave"] = (replace(kind, waves=(*kind.waves, (9, 0.0, 0.0))), scenes, found)
    if not kind.ratio:
        others["with two equal works"] = (replace(kind, ratio=True), scenes | {"closing_ratio": np.ones(size)}, found)
    if kind.solver == "exact" and kind.has_rim and not kind.pattern:
        flat = {"toughness_wavelength_over_R": 0.3 * scenes["a_max_over_R"], "toughness_amplitude": np.zeros(size)}
        for of in ("toughness", "work"):
            others[f"with a flat pattern of {of}"] = (replace(kind, pattern=of), scenes | flat, found)
    for name, (other, own, expected) in others.items():
        agree(replace(kind, name=f"{kind.name} {name}"), own, other.solve(own, kind.outputs), expected, statuses=True)


@for_kinds(KINDS)
def test_parts_are_all_that_is_lost(kind: Kind) -> None:
    scenes, found = drawn(kind)
    total = found["loading_energy"] + found["unloading_energy"] + found.get("front_energy", 0.0)
    agree(kind, scenes, found | {"dissipated_energy": total}, found, ["dissipated_energy"])
    if "front_energy" in found and not kind.pattern:
        front = np.pi * found["turning_radius"] ** 2 * (1 - scenes["closing_ratio"]) if kind.ratio else 0.0 * total
        agree(kind, scenes, found | {"front_energy": front}, found, ["front_energy"])
    sure = is_sure(found)
    assert (found["unloading_energy"] >= -errors(kind, scenes, found)["unloading_energy"])[sure].all()
    assert (found["pull_off_force"] > 0)[sure].all()


@for_kinds([kind for kind in EXACT if kind.control != "load"])
def test_the_losses_are_the_loop_integral(kind: Kind) -> None:
    scenes, found = drawn(kind)
    residual = kind.solve(scenes, ["energy_residual"])["energy_residual"]
    known, limit = np.isfinite(residual), errors(kind, scenes, found)["energy_residual"]
    assert known.mean() > 0.5
    assert (np.abs(residual) <= limit)[known].all(), np.nanmax((np.abs(residual) - limit)[known])


@for_kinds([kind for kind in EXACT if kind.has_rim])
def test_rims_beside_each_other(kind: Kind) -> None:
    """A wider rim never holds less; force and energy are continuous in it, at most by the work in its annulus."""
    scenes, found = drawn(kind)
    steps = np.array([0.3, 0.5, 0.8, 1.0, 1.0 + 1e-7, 1.1])
    wide = {n: v[:, None] for n, v in scenes.items()} | {"a_max_over_R": scenes["a_max_over_R"][:, None] * steps}
    values = kind.solve(wide)
    force, allowed = values["pull_off_force"], errors(kind, wide, values)["pull_off_force"]
    assert (np.diff(force, axis=1) >= -2 * np.maximum(allowed[:, 1:], allowed[:, :-1])).all()
    rim = scenes["a_max_over_R"]
    rate = 4e-7 * (phase_of(kind, scenes, rim) + 8)  # of a power of the radius up to 8, and of waves
    assert (np.abs(np.diff(values["dissipated_energy"][:, 3:5])[:, 0]) <= rate * work_size(kind, scenes, rim)).all()
    assert (np.diff(force[:, 3:5])[:, 0] <= rate * load_size(kind, scenes, rim)).all()
    agree(kind, scenes, some(values, np.s_[:, 3]), found)
    inner = found["pull_off_radius"] < 0.98 * rim  # where force is stationary: by 1e-16 phase^2 of its terms
    scenes, found = some(scenes, inner), some(found, inner)
    for off in (-1e-8, -1e-10, 0.0, 1e-10, 1e-8):
        near = kind.solve(scenes | {"a_max_over_R": found["pull_off_radius"] * (1 + off)}, ["pull_off_force"])
        agree(kind, scenes, found | near, found, ["pull_off_force"], more=1e-10)


@for_kinds([kind for kind in EXACT if kind.turn])
def test_a_turn_is_a_rim_where_it_turns(kind: Kind) -> None:
    scenes, found = drawn(kind)
    turned = (found["turning_radius"] > 0) & (found["turning_radius"] < scenes["a_max_over_R"])
    assert turned.mean() > 0.06
    scenes, found = some(scenes, turned), some(found, turned)
    rims = {name: values for name, values in scenes.items() if name != kind.turn}
    other = replace(kind, turn="").solve(rims | {"a_max_over_R": found["turning_radius"]})
    agree(kind, scenes, other, found)
    for count in COUNTS:  # also of a turn where a jump lands, which as a rim is on a tie
        np.testing.assert_array_equal(other[count], found[count])


@for_kinds(EXACT)
def test_the_drawn_path(kind: Kind) -> None:
    """It is in equilibrium, its jumps are those that are counted and lose what is lost, and its area is the loss.

    Its lowest load is the pull-off force, and no state within it pulls harder, whether or not it is on the path.
    """
    scenes, found = drawn(kind)
    few = found["loading_jumps"] < 3000  # the most that every kind can draw is a few times that
    sure = np.flatnonzero(few & is_sure(found))
    for i in rng_of(f"path {kind.name}").permutation(sure)[:4]:
        scene, values, own = one_of(scenes, i), some(found, [i]), some(scenes, [i])
        path, status = draw_curves(scene, ["equilibrium", "path", "jumps"], **kind.how)
        assert status & NO_VALUE == 0
        inside = path["contact_radius"] <= path["path_contact_radius"].max()
        for load in (path["path_load"], np.append(path["load"][inside], path["path_load"].min())):
            agree(kind, own, values | {"pull_off_force": -load.min(keepdims=True)}, values, ["pull_off_force"])
        for back, name in enumerate(("loading", "unloading")):
            lost = path["jump_energy"][path["jump_unloading"] == back]
            # the jump out of a dead load is not listed
            out = back and kind.control == "load" and values[f"{name}_jumps"][0] > 0
            assert lost.size + out == values[f"{name}_jumps"][0], scene
            agree(kind, own, values | {f"{name}_energy": lost.sum(keepdims=True)}, values, [f"{name}_energy"])
        is_in_equilibrium(kind, scene, path)
        if kind.control != "load" and np.isfinite(values["turning_radius"][0]):
            has_the_area(kind, scene, path, float(values["dissipated_energy"][0]))


def is_in_equilibrium(kind: Kind, scene: Scenes, path: Any) -> None:
    """Points of the drawn path are on the curve of the definitions, by SciPy: good to 1e-11 of the sizes of terms."""
    a, depth, load = (path[f"path_{name}"] for name in ("contact_radius", "indentation", "load"))
    for unloading in (0, 1):
        curve = Curve(kind, scene, closing=not unloading)
        on = (a > 0) & (a < a.max()) & (path["path_unloading"] == unloading) & (path["path_jump"] == 0)
        on = np.flatnonzero(on)[1:-1]
        for drawn_values, true, size in ((depth, curve.depth, depth_size), (load, curve.load, load_size)):
            off = np.abs(true(a[on]) - drawn_values[on]) / size(kind, scene, a[on])
            assert off.max(initial=0.0) <= 1e-11, scene


def has_the_area(kind: Kind, scene: Scenes, path: Any, energy: float) -> None:
    """The area of the drawn polygon: chords stay within 2e-4 of the span, so 2/3 of that times the length is left."""
    depth, load = path["path_indentation"], FORCE * path["path_load"]
    if kind.control == "machine":
        depth = depth + load / (scene["machine_stiffness"] * scene["modulus"])
    area = float(np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(depth)))
    moved = np.hypot(np.diff(depth) / np.ptp(depth), np.diff(load) / np.ptp(load))
    assert abs(area - energy) <= 2e-4 * np.ptp(depth) * np.ptp(load) * moved.sum(), scene


@for_kinds(PARABOLOIDS)
def test_smooth_punches_are_those_of_jkr(kind: Kind) -> None:
    """Force (3 + k)/3 at any modulus, and at k = 0 the radius of Johnson, Kendall & Roberts, (9 pi/(8 E*))^(1/3)."""
    moduli = np.array([[1.0], [700.0], [1e5]])
    scenes = SMOOTH | {"modulus": moduli, "a_max_over_R": np.inf}
    scenes |= {"machine_stiffness": 0.3} if kind.control == "machine" else {}
    scenes |= {"closing_ratio": 0.4} if kind.ratio else {}
    found = kind.solve(scenes, ["pull_off_force", "pull_off_radius"])
    np.testing.assert_allclose(found["pull_off_force"], np.broadcast_to((3 + EXPONENTS) / 3, (3, 5)), rtol=4 * SHARE)
    np.testing.assert_allclose(found["pull_off_radius"][:, 0], (9 * np.pi / (8 * moduli[:, 0])) ** (1 / 3), rtol=1e-6)


@for_kinds(["cosine", "two harmonics", "cosine, two works", "envelope of a cosine"])
def test_smooth_cycles_have_their_closed_forms(kind: Kind) -> None:
    """Section 10: pi a^2 F(q) of the jumps in (q = 1) and out (q = (1-k)/4); section 16: the pull after the first."""
    ratio = np.array([0.04, 0.4, 0.9, 1.0, 0.7]) if kind.ratio else np.ones(5)
    scenes = {name: np.broadcast_to(value, 5) for name, value in (SMOOTH | {"a_max_over_R": 1.5}).items()}
    scenes |= {"closing_ratio": ratio} if kind.ratio else {}
    found = kind.solve(scenes)
    k, s = EXPONENTS, stretch(EXPONENTS, stiffness(EXPONENTS, 0.3, 500.0, 0.07))
    expected = {"snap_in_force": 8 * (1 + k) * ratio / (3 * (3 + k)), "front_energy": 2.25 * np.pi * (1 - ratio)}
    for name, q, size, work in (("loading", np.ones(5), np.sqrt(ratio), -ratio), ("unloading", (1 - k) / 4, 1.0, 1.0)):
        radius = ((1 + k) * q * size * s) ** (2 / (3 + k))
        expected[f"{name}_energy"] = np.pi * work * jump_density(k, q) * radius**2
    agree(kind, scenes, found, found | expected, [name for name in expected if name in found])


@for_kinds([kind for kind in EXACT if kind.control == "machine"])
def test_a_stiff_machine_prescribes_the_depth(kind: Kind) -> None:
    """What is prescribed differs by P/S from the depth: energies differ in proportion to 1/S."""
    scenes = drawn(kind)[0]
    plain = replace(kind, control="displacement")
    expected = plain.solve({name: values for name, values in scenes.items() if name != "machine_stiffness"})
    bound = work_size(plain, scenes, scenes["a_max_over_R"])
    for stiff in (1e6, 1e9, 1e12):
        found = kind.solve(scenes | {"machine_stiffness": np.full_like(scenes["k"], stiff)})
        # a turn may pass a fold that it just does not pass under the other control
        same = np.abs(found["turning_radius"] - expected["turning_radius"]) <= 1e-3 * scenes["a_max_over_R"]
        assert same.mean() > 0.9
        off = np.abs(found["dissipated_energy"] - expected["dissipated_energy"])[same]
        assert (off <= (1e4 / stiff + 4 * SHARE) * bound[same]).all()
        agree(plain, scenes, found, expected, ["pull_off_force"], where=same, more=1e4 / stiff)


@for_kinds([kind for kind in EXACT if kind.ratio])
def test_a_tiny_ratio_is_none(kind: Kind) -> None:
    """Closing without adhesion is the limit: sqrt(Gamma) = 1e-12 is what enters depth and load."""
    scenes = drawn(kind)[0]
    none, tiny = (kind.solve(scenes | {"closing_ratio": np.full_like(scenes["k"], ratio)}) for ratio in (0.0, 1e-24))
    same = np.abs(none["turning_radius"] - tiny["turning_radius"]) <= 1e-3 * scenes["a_max_over_R"]
    assert same.mean() > 0.9
    for name in ("dissipated_energy", "pull_off_force", "delta_max"):
        bound = 2 * errors(kind, scenes, none)[name] + 1e-8 * (np.abs(none[name]) + scenes["a_max_over_R"] ** 2)
        off = np.abs(none[name] - tiny[name])
        assert ((off <= bound) | (off == 0))[same].all(), name


@EVERY
def test_in_any_order_in_pieces_and_alone_by_any_threads(kind: Kind) -> None:
    scenes, found = drawn(kind)
    order = rng_of(f"order {kind.name}").permutation(found["status"].size)
    for piece in (*np.array_split(order, 3), *order[:4, None]):
        other, twice = (kind.solve(some(scenes, piece), threads=threads) for threads in (1, 2))
        for name in other:
            np.testing.assert_array_equal(other[name], twice[name])  # threads change no bit
        agree(kind, some(scenes, piece), other, some(found, piece), bits=True)


@EVERY
def test_two_neighbours(kind: Kind) -> None:
    """Pairs that differ in one parameter alone, against both alone: what a solver shares between them is not mixed."""
    scenes, found = drawn(kind)
    rng = rng_of(f"pairs {kind.name}")
    for name in scenes:
        first, second = (one_of(scenes, i) for i in rng.choice(found["status"].size, 2, replace=False))
        if name in ("k", "nu") and max(first["k"], second["k"]) > 0.98:
            continue  # only nu = 1/2 has a value there
        own = {n: np.array([first[n], second[n] if n == name else first[n]]) for n in first}
        pair = kind.solve(first | {name: own[name]})
        for i in range(2):
            agree(kind, some(own, [i]), kind.solve(some(own, [i])), some(pair, [i]), bits=True)


@EVERY
def test_a_grid_is_its_points(kind: Kind) -> None:
    """Rims along the last axis share a trace, and other parameters stand before or behind them."""
    scenes, found = drawn(kind)
    one = one_of(scenes, rng_of(f"grid {kind.name}").integers(found["status"].size))
    rims = np.array([0.5, np.inf, 0.2, 1.0]) if kind.unbounded else one["a_max_over_R"] * np.array([1.0, 0.4, 1.3, 0.7])
    first = "closing_ratio" if kind.ratio else "machine_stiffness" if kind.control == "machine" else "A"
    values = np.array([0.0, 1.0, 0.37]) if kind.ratio else one[first] * np.array([1.0, 0.5, 1.2])
    columns = [axis.ravel() for axis in np.meshgrid(values, rims, indexing="ij")]
    points = {n: np.full(12, v) for n, v in one.items()} | {first: columns[0], "a_max_over_R": columns[1]}
    expected = kind.solve(points)
    for outer, inner in ((values[:, None], rims), (values, rims[:, None])):
        grid = kind.solve(one | {first: outer, "a_max_over_R": inner})
        flat = {name: (array if outer.ndim == 2 else array.T).ravel() for name, array in grid.items()}
        agree(kind, points, flat, expected, bits=True)


@EVERY
def test_what_is_asked_for_changes_no_value(kind: Kind) -> None:
    scenes, found = (some(values, slice(SCENES // 2)) for values in drawn(kind))
    names = [name for name in kind.outputs if name != "contact_slope"]  # it is that of what else is asked for
    order = [str(name) for name in rng_of(f"asked {kind.name}").permutation(names)]
    alone = ["pull_off_force", "pull_off_radius", "turning_radius"]  # need no cycle; of short waves one without value
    where = (kind.solver != "asymptotic") | ~has(found, NO_VALUE)
    for few in (order[:3], order[3:6], order[6:9], order[9:], alone):
        asked = kind.solve(scenes, few)
        assert set(asked) == {*few, "status"}
        agree(kind, scenes, found | asked, found, few, where=where)


@for_kinds(kind for kind in EXACT if kind.exponent > 1)
def test_almost_1_is_1(kind: Kind) -> None:
    """Where k is next to 1, the first fold lies below all tables; forces and energies have the limit of k = 1."""
    scenes, _ = drawn(kind)
    scenes = scenes | {"nu": np.full(SCENES, 0.5)}
    names = ["pull_off_force", "dissipated_energy", "loading_energy", "unloading_energy"]
    one, almost = (kind.solve(scenes | {"k": np.full(SCENES, k)}) for k in (1.0, 1.0 - 1e-12))
    where = is_sure(one) & is_sure(almost)
    assert where.sum() > SCENES // 4
    agree(kind, scenes | {"k": np.ones(SCENES)}, almost, one, names, where=where, more=1e-9)


def test_a_neighbour_that_reaches_farther_changes_no_bit() -> None:
    for pair in np.reshape(REACH_FARTHER, (-1, 2, 7)):
        scenes = dict(zip(PARAMETERS, pair.T, strict=True))
        found, alone = KINDS[0].solve(scenes), KINDS[0].solve(some(scenes, [0]))
        for name in found:
            np.testing.assert_array_equal(alone[name], found[name][:1], err_msg=name)


VALUES = ("pull_off_force", "dissipated_energy")
WITH_SLOPES = for_kinds([kind for kind in EXACT if not kind.unbounded])


def solved(kind: Kind) -> tuple[Scenes, Any, Any, dict[str, dict[str, Array]]]:
    """Scenes, their results, which of them have contact and no tie, and the sensitivities by value and parameter."""
    scenes = some(drawn(kind)[0], slice(SCENES // 2))
    with np.errstate(all="ignore"):
        found = kind.solve(scenes, [*OUTPUTS, *(f"{value}_sensitivity" for value in VALUES)])
    edge = ("closing_ratio", "toughness_wavelength_over_R", "toughness_amplitude")
    names = [*PARAMETERS, *(name for name in scenes if name not in (*PARAMETERS, *edge))]
    names += [name for name in edge if name in scenes]
    slopes = {v: dict(zip(names, np.moveaxis(found[f"{v}_sensitivity"], -1, 0), strict=True)) for v in VALUES}
    return scenes, found, is_sure(found), slopes


def sizes(kind: Kind, scenes: Scenes, found: Any, value: str) -> Array:
    """The sizes of the terms of a value over the value: how a relative promise is to be read where terms cancel."""
    with np.errstate(all="ignore"):
        return np.asarray(1 + errors(kind, scenes, found)[value] / SHARE / np.abs(found[value]))


@WITH_SLOPES
def test_similarity_and_the_material_are_sum_rules(kind: Kind) -> None:
    """Along the scaling of all lengths a value changes by its power alone; c0 enters through M ~ E* c0^-k alone."""
    scenes, found, sure, slopes = solved(kind)
    powers = powers_of(kind, scenes["k"])
    for value, of in slopes.items():
        scaled = [name for name in of if name in powers]
        total = sum(powers[name] * of[name] for name in scaled)
        size = sizes(kind, scenes, found, value) * (1 + sum(np.abs(of[name]) for name in scaled))
        by_m = of["modulus"] - of.get("machine_stiffness", 0.0)
        assert np.isfinite(total[sure & (found[value] > 0)]).all()  # a loading may gain more than all other jumps lose
        for off in (total - powers[value], of["c0_over_R"] + scenes["k"] * by_m):
            assert np.nanmax((np.abs(off) / size)[sure]) <= SENSITIVITY, (value, np.nanargmax(np.abs(off / size)))


@WITH_SLOPES
def test_central_differences(kind: Kind) -> None:
    """Fourth order, with a step of a part of the fastest phase; where no count, pull-off or turn steps within it."""
    scenes, found, sure, slopes = solved(kind)
    end = np.nan_to_num(found["turning_radius"])
    h = 3e-3 / (1 + phase_of(kind, scenes, end) + 4 * np.pi * end / scenes.get("toughness_wavelength_over_R", np.inf))
    ratios = [name for name in slopes[VALUES[0]] if name != "closing_ratio"]  # one-sided at 1, a root of it at 0
    checked = 0
    for name in {"A", "k", *rng_of(f"differences {kind.name}").choice(ratios, 3, replace=False)}:
        free, logs = sure.copy(), {}
        if name in ("k", "nu"):
            free &= (scenes["k"] > 0.02) & (scenes["k"] < 0.95) & (scenes["nu"] < 0.49)
        for j in (-2, -1, 1, 2):
            moved = scenes[name] + j * h if name in ("k", "nu") else scenes[name] * np.exp(j * h)
            with np.errstate(all="ignore"):
                values = kind.solve(scenes | {name: moved}, OUTPUTS)
                logs[j] = {value: np.log(values[value]) for value in VALUES}
                free &= is_sure(values)
                free &= np.logical_and.reduce([values[count] == found[count] for count in COUNTS])
                free &= np.abs(values["pull_off_radius"] / found["pull_off_radius"] - 1) < 0.02
                free &= np.abs(values["turning_radius"] / found["turning_radius"] - 1) < 0.1
                at_rim = values["turning_radius"] == (moved if name == "a_max_over_R" else scenes["a_max_over_R"])
                free &= at_rim == (found["turning_radius"] == scenes["a_max_over_R"])
        for value in VALUES:
            slope, size = slopes[value][name], sizes(kind, scenes, found, value)
            with np.errstate(all="ignore"):
                one, two = ((logs[j][value] - logs[-j][value]) / (2 * j * h) for j in (1, 2))
                limit = 4 * SHARE * size / h + np.abs(one - two) + SENSITIVITY * size * (1 + np.abs(slope))
                off = np.where(free, np.abs((4 * one - two) / 3 - slope) / limit, 0.0)
            i = int(np.nanargmax(off))
            assert off[i] <= 1, (value, name, slope[i], one[i], two[i], one_of(scenes, i))
            checked += int(free.sum())
    assert checked > SCENES
