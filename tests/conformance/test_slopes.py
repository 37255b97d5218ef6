"""Sensitivities: the sum rules of similarity, and central differences of whole solves."""

from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, PARAMETERS

from .faults import kinds_with
from .kinds import COUNTS, DEPTH, EXACT, LOAD, Kind, Scenes, drawn, rng_of, some
from .promises import CLOSE, NO_CONTACT, NO_VALUE, SENSITIVITY, SHARE, errors, has

BOTH = ("pull_off_force_sensitivity", "dissipated_energy_sensitivity")
EVERY = pytest.mark.parametrize("kind", kinds_with("slopes", [k for k in EXACT if not k.unbounded]))


def names_of(kind: Kind) -> list[str]:
    """The parameters along the last axis of a sensitivity, in order."""
    more = ["machine_stiffness"] if kind.control == "machine" else []
    more += [kind.turn] if kind.turn else []
    more += ["closing_ratio"] if kind.ratio else []
    more += ["toughness_wavelength_over_R", "toughness_amplitude"] if kind.pattern else []
    return [*PARAMETERS, *more]


def solved(kind: Kind, count: int = 60) -> tuple[Scenes, Any, Any]:
    """Scenes with their sensitivities, and which of them have contact and no tie."""
    scenes = some(drawn(kind)[0], slice(count))
    with np.errstate(all="ignore"):
        found = kind.solve(scenes, [*OUTPUTS, *BOTH])
    return scenes, found, ~has(found, NO_VALUE | NO_CONTACT | CLOSE)


def sizes(kind: Kind, scenes: Scenes, found: Any, value: str) -> Any:
    """The sizes of the terms of a value over the value: how a relative promise is to be read where terms cancel."""
    with np.errstate(all="ignore"):
        return 1 + errors(kind, scenes, found)[value] / SHARE / np.abs(found[value])


@EVERY
def test_similarity_is_a_sum_rule(kind: Kind) -> None:
    """Along the scaling of lengths by c no value changes but by its power of c: lambda, a ~ c, A ~ c^(m-1), ..."""
    scenes, found, sure = solved(kind)
    m, k = kind.exponent, scenes["k"]
    powers: dict[str, Any] = {"lambda_over_R": 1.0, "a_max_over_R": 1.0, "A": m - 1, "modulus": 1 - k - 2 * m}
    powers |= {"machine_stiffness": 1 + k, DEPTH: m, LOAD: 2 - m, "toughness_wavelength_over_R": 1.0}
    for name, value, power in zip(BOTH, ("pull_off_force", "dissipated_energy"), (2 - m, 2.0), strict=True):
        of = dict(zip(names_of(kind), np.moveaxis(found[name], -1, 0), strict=True))
        total = sum(powers[one] * of[one] for one in of if one in powers)
        known = sure & np.isfinite(found[name][..., 2])
        assert known.mean() > 0.5
        size = sizes(kind, scenes, found, value) * (1 + sum(np.abs(of[one]) for one in of if one in powers))
        off = (np.abs(total - power) / size)[known]
        assert off.max() <= SENSITIVITY, (name, off.max(), some(scenes, known)["k"][off.argmax()])


@EVERY
def test_the_material_is_a_sum_rule(kind: Kind) -> None:
    """c0 enters through M ~ E* c0^-k alone; the modulus also through S = machine_stiffness E* R."""
    scenes, found, sure = solved(kind)
    for name in BOTH:
        of = dict(zip(names_of(kind), np.moveaxis(found[name], -1, 0), strict=True))
        by_m = of["modulus"] - of.get("machine_stiffness", 0.0)
        known = sure & np.isfinite(by_m)
        off = np.abs(of["c0_over_R"] + scenes["k"] * by_m) / (1 + np.abs(by_m))
        assert off[known].max() <= SENSITIVITY


def stepped(kind: Kind, scenes: Scenes, name: str, step: Any) -> Scenes:
    """Scenes with one parameter moved: k and nu by the step, others by a factor."""
    return scenes | {name: scenes[name] + step if name in ("k", "nu") else scenes[name] * np.exp(step)}


@EVERY
def test_central_differences(kind: Kind) -> None:
    """Fourth order, with a step of a part of the fastest phase; where no count and no place of pull-off changes."""
    scenes, found, sure = solved(kind, 40)
    end = np.where(np.isfinite(found["turning_radius"]), found["turning_radius"], 1.0)
    phase = 1 + 2 * np.pi * kind.waves_per_wavelength * end / scenes["lambda_over_R"]
    rng = rng_of(f"differences {kind.name}")
    checked = 0
    for i, name in enumerate(names_of(kind)):
        if name not in rng.choice(names_of(kind), 4, replace=False) and name not in ("A", "k"):
            continue
        h = 3e-3 / phase
        free = sure.copy()
        if name in ("k", "nu"):
            free &= (scenes["k"] > 0.02) & (scenes["k"] < 0.95) & (scenes["nu"] < 0.49)
        elif name == "closing_ratio":
            continue  # one-sided at 1, and at 0 of the root: the laws of two works have it
        values, counts = {}, [found[count] for count in COUNTS]
        with np.errstate(invalid="ignore", divide="ignore"):
            for j in (-2, -1, 1, 2):
                values[j] = kind.solve(stepped(kind, scenes, name, j * h), OUTPUTS)
                moved = [values[j][count] != own for count, own in zip(COUNTS, counts, strict=True)]
                free &= ~moved[0] & ~moved[1] & ~has(values[j], CLOSE | NO_VALUE | NO_CONTACT)
                place = np.abs(values[j]["pull_off_radius"] / found["pull_off_radius"] - 1)
                free &= place < 0.02
                free &= np.abs(values[j]["turning_radius"] / found["turning_radius"] - 1) < 0.1
            for output, value in zip(BOTH, ("pull_off_force", "dissipated_energy"), strict=True):
                logs = {j: np.log(values[j][value]) for j in values}
                one, two = (logs[1] - logs[-1]) / (2 * h), (logs[2] - logs[-2]) / (4 * h)
                slope = found[output][..., i]
                size = sizes(kind, scenes, found, value)
                limit = 4 * SHARE * size / h + np.abs(one - two) + SENSITIVITY * size * (1 + np.abs(slope))
                known = free & np.isfinite(slope) & np.isfinite(one)
                off = np.abs((4 * one - two) / 3 - slope) / limit
                worst = int(np.argmax(np.where(known, off, 0.0)))
                assert not known.any() or off[known].max() <= 1, (
                    output, name, off[worst], slope[worst], one[worst], {n: float(v[worst]) for n, v in scenes.items()},
                )  # fmt: skip
                checked += int(known.sum())
    assert checked > 60
