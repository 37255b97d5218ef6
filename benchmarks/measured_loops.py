"""Loops as instruments give them, with known parameters: contact anywhere in the data, zeros far off, noise, drift.

A loop is given by (seed, number) and its kind: words joined by "+" out of `WORDS`. Material and waves are drawn by the
logarithm, and the ranges searched lie around each value by a draw of their own: none is centred on it. A tip turns at
1 to 1,000 times the pull-off force. Points are evenly spaced in time, at a constant speed of the tip, so that no point
lies within a jump and most lie on the base line or at large loads. They are on the exact curve, not on its chords.

Drawn anew is what nobody would measure: a contact wider than half the radius, fewer than
`LEAST_POINTS` points in adhesion or `LEAST_PER_WAVE` in a wave at half the widest radius.
"""

import math
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.special import gamma

from gradhesion.core import draw_curves, solve
from gradhesion.core.equations import jkr
from gradhesion.core.problem.material import stiffness

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Range = tuple[float, float]

WORDS: Final = ("smooth", "wavy", "works", "drift", "walk", "tilt", "approach", "retract")
"""smooth or wavy (one of them); unequal works; the zero of load drifts evenly or by a random walk; a tilt of the base
line; one branch alone."""
DECADES: Final = {"E_star": 2.0, "work_of_adhesion": 2.0, "wavelength": 1.0, "A": 1.0}
"""The widths of the ranges searched."""
WITHIN: Final = (0.1, 0.9)
"""Where in its range a value lies, in parts of its logarithm."""
TURNED: Final = (1.0, 1000.0)
"""The largest load, in pull-off forces of the tip pressed in without end."""
NU: Final = 0.3
NOISE: Final = 0.01
"""Of the load, in parts of the pull-off force, and of the depth, in parts of the depth at which contact ends."""
POINTS: Final = 900
LEAST_POINTS: Final = 4
LEAST_PER_WAVE: Final = 4
_FINE: Final = 24
"""Parts of each piece of the drawn path for distances to the truth."""


@dataclass(frozen=True)
class Loop:
    """A loop, with what it was made with. Depths in m, loads in N; points in order of time."""

    kind: str
    seed: int
    number: int
    true: dict[str, float]
    """What is fitted: parameters, then offsets."""
    fixed: dict[str, float]
    free: dict[str, Range]
    depth: Array
    load: Array
    unloading: Bools
    noise: tuple[float, float]
    paths: tuple[Array, Array] = field(repr=False)
    """The exact loading and unloading, base lines included, rows of depth and load without offsets."""
    turned: float
    """The largest load over the pull-off force."""

    def chi_square(self) -> float:
        """Return that of the truth: squares of the distances to the exact path, over the noise."""
        depth, load, back, true = self.depth, self.load, self.unloading, self.true
        shifted = load - true["load_offset"] - true.get("load_slope", 0.0) * depth
        points = np.column_stack([depth - true["indentation_offset"], shifted]) / self.noise
        sides = ((~back, self.paths[0]), (back, self.paths[1]))
        return sum(float(np.sum(_squares(points[own], path / self.noise))) for own, path in sides if own.any())


def draw_loop(seed: int, number: int, kind: str = "wavy", points: int = POINTS) -> Loop:
    """Draw a loop by its number."""
    words = frozenset(kind.split("+"))
    if unknown := words - set(WORDS):
        raise ValueError(f"kind = {kind!r}: {min(unknown)!r} is none of {', '.join(WORDS)}")
    rng = np.random.default_rng([seed, number])
    turned = _log(rng, *TURNED)
    while (made := _cycle(rng, words, points, turned)) is None:
        pass
    return _measured(rng, words, kind, seed, number, made)


@dataclass(frozen=True)
class _Cycle:
    """A cycle without noise, zero at first contact."""

    physical: dict[str, float]
    fixed: dict[str, float]
    depth: Array
    load: Array
    unloading: Bools
    paths: tuple[Array, Array]
    pull_off: float
    out: float
    turned: float


def _log(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def _cycle(rng: np.random.Generator, words: frozenset[str], points: int, turned: float) -> _Cycle | None:
    """Draw a scene and put points on its path; None where it is drawn anew."""
    k, R = float(rng.choice([0.0, 0.3])), _log(rng, 1e-6, 50e-6)
    E_star, work, c0 = _log(rng, 1e3, 1e9), _log(rng, 1e-3, 1.0), R * _log(rng, 0.01, 1.0)
    line, waves, rough = _log(rng, 0.1, 10.0), _log(rng, 1.0, 20.0), _log(rng, 0.1, 1.5)
    ratio = _log(rng, 0.05, 1.0) if "works" in words else 1.0
    modulus = E_star * R / work
    M = float(stiffness(k, NU, modulus, c0 / R))
    widest = (2.0 * math.pi * turned / M) ** (1.0 / (3.0 + k))  # about the radius at the turn, over R
    if not 0.005 < widest < 0.5:
        return None
    if points / (1.0 + line) < max(LEAST_POINTS * turned ** (2.0 / 3.0), 4.0 * LEAST_PER_WAVE * waves):
        return None  # about, before anything is solved
    wavelength = widest / waves
    s = math.sqrt(2.0 ** (1.0 + k) * math.pi / M)
    A = rough * s / (math.pi ** ((1.0 - k) / 2) * gamma((1.0 + k) / 2) * wavelength ** ((1.0 + k) / 2))
    A *= "smooth" not in words
    scene = {"k": k, "nu": NU, "modulus": modulus, "c0_over_R": c0 / R, "lambda_over_R": wavelength, "A": A}
    scene |= {"a_max_over_R": math.inf}
    force = float(solve(scene, ["pull_off_force"], threads=1)["pull_off_force"])
    scene |= {"load_max": turned * force} | ({"closing_ratio": ratio} if "works" in words else {})
    found = solve(scene, ["pull_off_force", "delta_jump_out"], threads=1)
    if found["status"] != 0:
        return None
    path, status = draw_curves(scene, ["path"])
    if status != 0:
        return None
    walk = _Walk(path, scene, ratio)
    if walk.load.min() > -1e-3 or walk.depth.max() <= 0.0:
        return None
    travel, out = float(walk.depth.max()), float(-walk.depth.min())
    far = -max(line * travel, 1.3 * out)
    depth, load, back = walk.in_time(points, far)
    per_wave = 0.5 * widest * wavelength / (2.0 * (travel - far) / points)
    in_adhesion = np.count_nonzero(back & (load < 0.2 * walk.load.min()))
    if in_adhesion < LEAST_POINTS or (A > 0.0 and per_wave < LEAST_PER_WAVE):
        return None
    unit = np.array([R, 1.5 * math.pi * R * work])
    physical = {"E_star": E_star, "work_of_adhesion": work}
    physical |= {"wavelength": wavelength * R, "A": A} if A > 0.0 else {}
    physical |= {"closing_ratio": ratio} if "works" in words else {}
    fixed = {"k": k, "nu": NU, "R": R} | ({"c0": c0} if k > 0.0 else {}) | ({"A": 0.0} if A == 0.0 else {})
    before, after = walk.chains(far)
    pull = -float(walk.load.min())
    return _Cycle(
        physical, fixed, depth * unit[0], load * unit[1], back, (before * unit, after * unit), pull * unit[1],
        out * unit[0], float(walk.load.max()) / pull,
    )  # fmt: skip


class _Walk:
    """The path of a cycle in units of the theory, with points of the exact curve between its vertices."""

    def __init__(self, path: dict[str, NDArray[Any]], scene: dict[str, float], ratio: float) -> None:
        names = ("contact_radius", "indentation", "load", "unloading", "jump")
        self.radius, self.depth, self.load, back, jump = (path[f"path_{name}"] for name in names)
        self.back, self.jump = back > 0, jump > 0
        self.ratio, self.k, self.waves = ratio, scene["k"], (scene["lambda_over_R"], scene["A"])
        self.M = float(stiffness(scene["k"], scene["nu"], scene["modulus"], scene["c0_over_R"]))

    def between(self, after: NDArray[np.intp], share: Array) -> tuple[Array, Array]:
        """Return depth and load at shares of the pieces that end at vertices: straight, or on the exact curve."""
        before = after - 1
        rows = [row[before] + share * (row[after] - row[before]) for row in (self.depth, self.load, self.radius)]
        depth, load, radius = rows
        curved = ~self.jump[after] & (self.radius[before] != self.radius[after]) & (self.radius[before] > 0.0)
        for way, ratio in ((False, self.ratio), (True, 1.0)):
            own = curved & (self.back[after] == way)
            shape = (self.k, self.M / ratio, radius[own], *self.waves)
            depth[own], load[own] = jkr.indentation(*shape), ratio * jkr.load(*shape)
        return depth, load

    def in_time(self, points: int, far: float) -> tuple[Array, Array, Bools]:
        """Return points at a constant speed of the depth, from `far` to the turn and back."""
        steps = np.abs(np.diff(self.depth))
        clock = np.concatenate([[0.0], np.cumsum(steps)]) - far
        whole = clock[-1] + float(self.depth[-1]) - far
        times = (np.arange(points) + 0.5) * whole / points
        inside = (times > clock[0]) & (times < clock[-1])
        after = np.clip(np.searchsorted(clock, times[inside]), 1, self.depth.size - 1)
        share = (times[inside] - clock[after - 1]) / np.where(steps[after - 1] > 0.0, steps[after - 1], 1.0)
        turn = clock[np.count_nonzero(~self.back) - 1]
        depth, load = np.where(times < clock[0], far + times, whole + far - times), np.zeros(points)
        depth[inside], load[inside] = self.between(after, share)
        return depth, load, times > turn

    def chains(self, far: float) -> tuple[Array, Array]:
        """Return loading and unloading as chains of many vertices, base lines included."""
        last = int(np.count_nonzero(~self.back))
        after = np.repeat(np.arange(1, self.depth.size), _FINE)
        share = np.tile(np.arange(1, _FINE + 1) / _FINE, self.depth.size - 1)
        fine = np.column_stack(self.between(after, share))
        away, start = np.array([[2.0 * far - 1.0, 0.0]]), np.array([[0.0, 0.0]])
        split = (last - 1) * _FINE
        return np.concatenate([away, start, fine[:split]]), np.concatenate([fine[split - 1 :], away])


def _squares(points: Array, chain: Array) -> Array:
    """Return the squares of distances of points (n, 2) to a chain (m, 2)."""
    start, run = chain[:-1], np.diff(chain, axis=0)
    length = np.maximum(np.sum(run * run, axis=1), 1e-300)
    found = np.empty(len(points))
    for first in range(0, len(points), 200):
        away = points[first : first + 200, None, :] - start
        share = np.clip(np.einsum("ijk,jk->ij", away, run) / length, 0.0, 1.0)
        away -= share[:, :, None] * run
        found[first : first + 200] = np.min(np.einsum("ijk,ijk->ij", away, away), axis=1)
    return found


def _measured(rng: np.random.Generator, words: frozenset[str], kind: str, seed: int, number: int, made: _Cycle) -> Loop:
    """Add what the instrument does to a cycle, and draw the ranges."""
    depth, load, back, pull = made.depth, made.load, made.unloading, made.pull_off
    if one := words & {"approach", "retract"}:
        keep = back == ("retract" in one)
        depth, load, back = depth[keep], load[keep], back[keep]
    noise = NOISE * made.out, NOISE * pull
    travel = float(np.ptp(depth))
    true = made.physical | {
        "indentation_offset": travel * float(rng.uniform(-2.0, 2.0)),
        "load_offset": pull * float(rng.uniform(-5.0, 5.0)),
    }
    errors = rng.standard_normal((2, depth.size))
    depth = depth + true["indentation_offset"] + noise[0] * errors[0]
    load = load + true["load_offset"] + noise[1] * errors[1]
    if "tilt" in words:
        true["load_slope"] = pull / travel * float(rng.uniform(-2.0, 2.0))
        load += true["load_slope"] * depth
    if way := words & {"drift", "walk"}:
        size = noise[1] * _log(rng, 0.1, 5.0)
        drift = np.linspace(-0.5, 0.5, depth.size) if "drift" in way else np.cumsum(rng.standard_normal(depth.size))
        load += size * (drift - drift.mean()) / max(float(np.ptp(drift)), 1e-300)
    free = {}
    for name, decades in DECADES.items():
        if name in made.physical:
            low = made.physical[name] * 10.0 ** (-decades * float(rng.uniform(*WITHIN)))
            free[name] = (low, low * 10.0**decades)
    if "closing_ratio" in made.physical:
        free["closing_ratio"] = (0.01, 1.0)
    return Loop(kind, seed, number, true, made.fixed, free, depth, load, back, noise, made.paths, made.turned)
