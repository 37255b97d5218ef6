"""Limits in which another theory, or another kind, has the same values."""

from dataclasses import replace

import numpy as np

from .kinds import EXACT, Kind, Scenes, drawn, for_kinds
from .promises import SHARE, agree, errors, work_size
from .theory import stiffness, stretch

EXPONENTS = np.array([0.0, 0.1, 0.37, 0.7, 0.96])
SMOOTH: Scenes = {"k": EXPONENTS, "nu": 0.3, "modulus": 500.0, "c0_over_R": 0.07, "lambda_over_R": 0.1, "A": 0.0}
PARABOLOIDS = [k for k in EXACT if k.exponent == 2 and not k.turn and not k.pattern]


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
        density = 16 * q * q / ((1 + k) * (3 + k) * (5 + k)) - 8 * q / ((1 + k) * (3 + k)) + 2 / (1 + k) - 1
        expected[f"{name}_energy"] = np.pi * work * density * radius**2
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


@for_kinds(["cosine, load", "sines, load"])
def test_a_soft_machine_prescribes_the_load(kind: Kind) -> None:
    """All but the last jump, whose energy grows as 1/S."""
    scenes, expected = drawn(kind)
    soft = replace(kind, control="machine").solve(scenes | {"machine_stiffness": np.full_like(scenes["k"], 1e-13)})
    agree(kind, scenes, soft, expected, ["pull_off_force", "loading_jumps", "unloading_jumps"])
    bound = work_size(kind, scenes, scenes["a_max_over_R"])
    assert (np.abs(soft["loading_energy"] - expected["loading_energy"]) <= 1e-8 * bound).all()


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
