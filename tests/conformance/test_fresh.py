"""Fresh scenes of every kind against a slow solver that shares no line with the core: ball arithmetic of 51 digits."""

import math
from typing import Any

import numpy as np
import pytest

pytest.importorskip("flint")

from gradhesion.twin import stated
from gradhesion.twin.general import PLAIN, Shape
from gradhesion.twin.scene import waves_to_follow

from .kinds import COUNTS, KINDS, SINES, Kind, Scenes, at, drawn, name_of, rng_of, some
from .promises import errors

SCENES = 3
MOST_WAVES = 25.0
"""Waves of the shortest harmonic that a scene may have: the twin needs some 15 ms for each."""
COMPARED = [kind for kind in KINDS if kind.solver != "asymptotic"]


def shape_of(kind: Kind) -> Shape:
    """The shape by which the twin knows a kind; it has a curve of its own for the plain one."""
    own = Shape(kind.exponent, kind.waves, kind.control, kind.pattern_waves, kind.pattern or "toughness")
    return PLAIN if own == PLAIN else own


def compared(kind: Kind, scene: Scenes, shape: Shape, found: dict[str, Any], names: Any) -> int:
    """Compare one scene with the twin; return how many values were."""
    expected = stated.expected(scene, names, kind.solver, shape)
    one = {name: np.reshape(value, 1) for name, value in scene.items()}
    allowed = errors(kind, one, {name: np.reshape(value, 1) for name, value in found.items()})
    count = 0
    for name, of in expected.items():
        if of.near:
            continue  # of a count: a tie; of a radius: two troughs
        limit = 0.0 if name in COUNTS else np.nan_to_num(float(allowed[name][0]), posinf=0.0)
        off = stated.deviation(float(found[name]), of)
        assert off <= max(limit, 0.0), (kind.name, name, float(found[name]), str(of), off, limit, scene)
        count += 1
    return count


@pytest.mark.parametrize("kind", COMPARED, ids=name_of)
def test_fresh_scenes(kind: Kind) -> None:
    scenes, found = drawn(kind)
    names = [name for name in kind.outputs if name not in ("contact_slope",)]
    shape, done, count = shape_of(kind), 0, 0
    for i in rng_of(f"fresh {kind.name}").permutation(found["status"].size):
        scene = {name: float(values[i]) for name, values in scenes.items()}
        try:
            if kind.solver == "exact":
                waves = waves_to_follow(scene, shape, cycle=True)
                if not waves <= MOST_WAVES or found["loading_jumps"][i] < (2 if done == 0 else 1):
                    continue
            count += compared(kind, scene, shape, {name: values[i] for name, values in found.items()}, names)
        except ArithmeticError:  # one of the folds that even 51 digits do not tell apart
            continue
        done += 1
        if done == SCENES:
            break
    assert done == SCENES
    assert count > 5 * SCENES


CORNERS = (
    ("k = 0", Kind("corner"), {"k": 0.0}),
    ("k an ulp above 0", Kind("corner"), {"k": 5e-324}),
    ("k = 1e-16", Kind("corner", waves=SINES[:2]), {"k": 1e-16}),
    ("k an ulp below 1", Kind("corner"), {"k": 1 - 2.0**-53, "nu": 0.5}),
    ("k = 1", Kind("corner"), {"k": 1.0, "nu": 0.5}),
    ("k = 1, sines", Kind("corner", waves=SINES[:2]), {"k": 1.0, "nu": 0.5}),
    ("k = 1, load", Kind("corner", control="load"), {"k": 1.0, "nu": 0.5}),
    ("cone", Kind("corner", exponent=1.0), {"k": 0.4}),
    ("cone at k = 0", Kind("corner", exponent=1.0), {"k": 0.0}),
    ("cone at k = 1", Kind("corner", exponent=1.0), {"k": 1.0, "nu": 0.5}),
    ("cone with a groove at its centre", Kind("corner", exponent=1.0, waves=((1, -1.0, -0.2),)), {"k": 0.3}),
    ("exponent 1.5 at k = 0", Kind("corner", exponent=1.5), {"k": 0.0}),
    ("exponent 1.5 at k = 0, machine", Kind("corner", exponent=1.5, control="machine"), {"k": 0.0}),
    ("exponent 6.5", Kind("corner", exponent=6.5), {"k": 0.6}),
    ("no first harmonic", Kind("corner", waves=((3, 0.5, 0.2), (4, 0.3, 0.0))), {"k": 0.25, "lambda_over_R": 1.0}),
    ("a groove at the centre", Kind("corner", waves=((1, -0.8, 0.0),)), {"k": 0.25}),
    ("A = 0", Kind("corner"), {"k": 0.25, "A": 0.0}),
    ("A = 0, series, machine", Kind("corner", waves=SINES, control="machine"), {"k": 0.25, "A": 0.0}),
    ("A = 1e-13", Kind("corner"), {"k": 0.25, "A": 1e-13}),
    ("a rim in the first bin", Kind("corner"), {"k": 0.25, "a_max_over_R": 1e-6}),
    ("a rim in the first bin, series", Kind("corner", waves=SINES), {"k": 0.0, "a_max_over_R": 1e-6}),
    ("a tiny modulus", Kind("corner"), {"k": 0.25, "modulus": 1e-7}),
    ("a huge modulus", Kind("corner"), {"k": 0.25, "modulus": 1e11, "A": 1e-5}),
    ("unbounded", Kind("corner"), {"k": 0.25, "a_max_over_R": math.inf, "lambda_over_R": 0.5}),
    ("unbounded, load", Kind("corner", control="load"), {"k": 0.6, "a_max_over_R": math.inf, "lambda_over_R": 0.5}),
    ("unbounded, exponent 4", Kind("corner", exponent=4.0), {"k": 0.6, "a_max_over_R": math.inf, "lambda_over_R": 0.7}),
    ("unbounded, exponent 1.5", Kind("corner", exponent=1.5), {"k": 0.6, "a_max_over_R": math.inf, "lambda_over_R": 2.0}),
)
"""What is special, the kind, and what differs from a plain scene."""


@pytest.mark.parametrize(("kind", "special"), [corner[1:] for corner in CORNERS], ids=[corner[0] for corner in CORNERS])
def test_corners(kind: Kind, special: Scenes) -> None:
    rng = rng_of(f"corner {kind}{special}")
    scene: Scenes = {"nu": 0.21, "modulus": float(rng.uniform(150, 400)), "c0_over_R": 0.13, "lambda_over_R": 0.17}
    scene |= {"A": float(rng.uniform(0.02, 0.04)), "a_max_over_R": float(rng.uniform(0.4, 0.6))}
    scene |= {"machine_stiffness": 0.7} if kind.control == "machine" else {}
    scene |= special
    found = kind.solve(scene)
    names = [name for name in kind.outputs if name != "contact_slope"]
    assert compared(kind, scene, shape_of(kind), found, names) > 8


@pytest.mark.parametrize("kind", [Kind("two works", ratio=True), Kind("two works", ratio=True, waves=SINES[:2])], ids=str)
@pytest.mark.parametrize("ratio", [0.0, 1e-12, 1 - 2.0**-53, 1.0])
def test_ratios_at_the_ends_of_their_range(kind: Kind, ratio: float) -> None:
    scene = {"k": 0.3, "nu": 0.3, "modulus": 300.0, "c0_over_R": 0.1, "lambda_over_R": 0.2, "A": 0.03}
    scene |= {"a_max_over_R": 0.5, "closing_ratio": ratio}
    assert compared(kind, scene, shape_of(kind), kind.solve(scene), kind.outputs) > 10


def test_a_rim_beside_the_trough_holds_what_the_trough_holds() -> None:
    """Force is stationary there: a rim within 1e-7 of it changes the force by less than 1e-12."""
    kind = Kind("cosine")
    scenes, found = drawn(kind)
    inner = found["pull_off_radius"] < 0.98 * scenes["a_max_over_R"]
    own, expected = some(scenes, inner), some(found, inner)
    for off in (-1e-8, -1e-10, 0.0, 1e-10, 1e-8):
        rims = own | {"a_max_over_R": expected["pull_off_radius"] * (1 + off)}
        force = kind.solve(rims, ["pull_off_force"])["pull_off_force"]
        limit = 2 * errors(kind, own, expected)["pull_off_force"] + 1e-10 * expected["pull_off_force"]
        assert (np.abs(force - expected["pull_off_force"]) <= limit).all()


@pytest.mark.parametrize("count", [64])
def test_as_many_harmonics_as_there_may_be(count: int) -> None:
    """A rough series of 64 waves: the loop integral, and the same series on a wavelength twice as long."""
    rng = rng_of("64 harmonics")
    size = np.arange(1, count + 1) ** -1.5
    angle = rng.uniform(0, 2 * np.pi, count)
    waves = tuple((n + 1, float(size[n] * np.cos(angle[n])), float(size[n] * np.sin(angle[n]))) for n in range(count))
    kind = Kind("rough", waves=waves)
    scenes = some(drawn(Kind("cosine"))[0], slice(12))
    scenes |= {"A": 0.3 * scenes["A"], "lambda_over_R": 1.1 * scenes["a_max_over_R"]}
    found = kind.solve(scenes, [*kind.outputs, "energy_residual"])
    allowed = errors(kind, scenes, found)
    assert (np.abs(found["energy_residual"]) <= 100 * allowed["dissipated_energy"]).all()
    doubled = at(kind, waves=tuple((2 * n, even, odd) for n, even, odd in waves))
    other = doubled.solve(scenes | {"lambda_over_R": 2 * scenes["lambda_over_R"], "A": scenes["A"] / 2})
    for name in ("pull_off_force", "dissipated_energy", "delta_max"):
        assert (np.abs(other[name] - found[name]) <= 2 * allowed[name]).all(), name
    assert (found["loading_jumps"] == other["loading_jumps"]).all()
