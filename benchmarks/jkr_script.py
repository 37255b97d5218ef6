"""A script that fits the closed curve of Johnson, Kendall & Roberts (1971), as an experimenter has it: NumPy and SciPy.

Least squares of the signed distance of each point to the path, in units of the noise, from `STARTS` starts over the
ranges. Approach comes along the base line and jumps in at depth zero; retraction follows the curve from the turn of the
data to its fold, and jumps out to the base line. Nothing of it comes from gradhesion.
"""

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import qmc

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]

STARTS: Final = 48
POINTS: Final = 300
"""Of a branch."""
LOADS: Final = 10.0
BRANCHES: Final = ("approach", "retract", "both")
NAMES: Final = ("E_star", "work_of_adhesion", "indentation_offset", "load_offset")
BEYOND: Final = 6.0
"""Standard deviations of the depth by which the path goes on beyond the deepest point, whose depth is off too."""
_VERTICES: Final = 120
_FEW: Final = 4
"""Every so many points are given to the starts, and so many of these are refined with all."""


@dataclass(frozen=True)
class Branch:
    """Points with what they were made with."""

    true: Array
    """In the order of `NAMES`, in SI units."""
    R: float
    depth: Array
    load: Array
    unloading: Bools
    noise: tuple[float, float]
    low: Array
    high: Array


def depth_at(a: Array, E_star: float, work: float, R: float) -> Array:
    """Return the depth at contact radii."""
    return a**2 / R - np.sqrt(2.0 * math.pi * work * a / E_star)


def load_at(a: Array, E_star: float, work: float, R: float) -> Array:
    """Return the load at contact radii."""
    return 4.0 * E_star * a**3 / (3.0 * R) - np.sqrt(8.0 * math.pi * work * E_star * a**3)


def radii(E_star: float, work: float, R: float, turn: float) -> tuple[float, float, float]:
    """Return the radii where contact ends (a fold of the depth), where it begins, at depth 0, and where it turns."""
    unit = (math.pi * work * R**2 / E_star) ** (1 / 3)  # depth = unit^2/R (x^4 - sqrt(2) x), a = unit x^2
    t, low, high = turn * R / unit**2, 2.0 ** (1 / 6), 2.0 ** (1 / 6) + 1.0
    while high**4 - math.sqrt(2.0) * high < t:
        high *= 2.0
    for _ in range(60):
        x = 0.5 * (low + high)
        low, high = (x, high) if x**4 - math.sqrt(2.0) * x < t else (low, x)
    return unit / 2.0, unit * 2.0 ** (1 / 3), unit * (0.5 * (low + high)) ** 2


def draw(seed: int, number: int) -> Branch:
    """Draw a branch by its number, the kinds of `BRANCHES` in turn."""
    rng = np.random.default_rng([seed, number])
    kind = BRANCHES[number % 3]
    E_star, work, turned = (10.0 ** rng.uniform(*ends) for ends in ((3.0, 8.0), (-3.0, -0.5), (0.0, 3.0)))
    R = 10.0 ** rng.uniform(-6.0, -4.3)
    pull = 1.5 * math.pi * work * R
    first, last = math.pow(math.pi * work * R**2 / (8.0 * E_star), 1 / 3), 0.0
    low, high = 2.0 * first, 1e4 * first
    for _ in range(100):  # the radius at the turn
        last = 0.5 * (low + high)
        low, high = (last, high) if load_at(np.array(last), E_star, work, R) < turned * pull else (low, last)
    deepest, end = (float(depth_at(np.array(a), E_star, work, R)) for a in (last, first))
    line = max(deepest * 10.0 ** rng.uniform(-1.0, 0.5), -2.0 * end)
    a = np.geomspace(first, last, 200_000)
    curve = depth_at(a, E_star, work, R), load_at(a, E_star, work, R)
    depths = np.linspace(-line, deepest, POINTS)
    branches = []
    for back in (False, True):
        on = depths > (end if back else 0.0)
        load = np.where(on, np.interp(depths, *curve), 0.0)
        branches.append((depths, load, np.full(POINTS, back)))
    wanted = {"approach": branches[:1], "retract": branches[1:], "both": branches}[kind]
    depth, load, unloading = (np.concatenate(row) for row in zip(*wanted, strict=True))
    noise = 0.01 * abs(end), 0.01 * pull
    zero = (line + deepest) * rng.uniform(-2.0, 2.0), pull * rng.uniform(-3.0, 3.0)
    depth = depth + zero[0] + noise[0] * rng.standard_normal(depth.size)
    load = load + zero[1] + noise[1] * rng.standard_normal(depth.size)
    within = 10.0 ** (-2.0 * rng.uniform(0.1, 0.9, 2))
    low_ends = [E_star * within[0], work * within[1], float(depth.min()), -LOADS * pull]
    high_ends = [100.0 * low_ends[0], 100.0 * low_ends[1], float(depth.max()), LOADS * pull]
    true = np.array([E_star, work, *zero])
    return Branch(true, R, depth, load, unloading, noise, np.array(low_ends), np.array(high_ends))


class Misfit:
    """Distances to the closed curve; vectors are ln E*, ln w, and the zeros of depth and load in units of the noise."""

    def __init__(self, branch: Branch, every: int = 1) -> None:
        self.own, self.noise, self.back = branch, np.array(branch.noise), branch.unloading[::every]
        self.points = np.column_stack([branch.depth, branch.load])[::every] / self.noise
        self.deepest = float(branch.depth.max()) + BEYOND * branch.noise[0]
        self.low, self.high = self.vector(branch.low), self.vector(branch.high)

    def vector(self, values: Array) -> Array:
        """Return what is searched for values in SI units."""
        return np.concatenate([np.log(values[:2]), values[2:] / self.noise])

    def values(self, vector: Array) -> Array:
        """Return values in SI units."""
        return np.concatenate([np.exp(vector[:2]), vector[2:] * self.noise])

    def residual(self, vector: Array) -> Array:
        """Return the signed distances."""
        return self._feet(vector)[0]

    def jacobian(self, vector: Array) -> Array:
        """Return their derivatives: how the foot moves across the path, by differences at its fixed radius."""
        _, normal, at, where = self._feet(vector)
        moved = np.zeros((normal.shape[0], 2, 4))
        moved[:, 0, 2] = moved[:, 1, 3] = 1.0
        for i in range(2):
            step = np.zeros(4)
            step[i] = 1e-5
            ends = []
            for sign in (1.0, -1.0):
                E_star, work = np.exp((vector + sign * step)[:2])
                x = np.where(where == 1, depth_at(at, E_star, work, self.own.R), 0.0)
                fold = radii(E_star, work, self.own.R, 0.0)[0]
                x = np.where(where == 2, depth_at(np.array(fold), E_star, work, self.own.R), x)
                y = np.where(where == 1, load_at(at, E_star, work, self.own.R), 0.0)
                ends.append(np.column_stack([x, y]) / self.noise)
            moved[:, :, i] = (ends[0] - ends[1]) / 2e-5
        slopes: Array = -np.einsum("ij,ijk->ik", normal, moved)
        return slopes

    def _feet(self, vector: Array) -> tuple[Array, Array, Array, Array]:
        """Return distances, normals, the radius of each foot, and what it lies on.

        0 is what does not move with E* and w, the base line and the jump in; 1 the curve; 2 the jump out.
        """
        E_star, work = np.exp(vector[:2])
        points = self.points - vector[2:]
        back = self.back
        out, begin, turn = radii(E_star, work, self.own.R, self.deepest - vector[2] * self.noise[0])
        away, normal = np.empty(len(points)), np.empty((len(points), 2))
        at, where = np.zeros(len(points)), np.zeros(len(points), int)
        fold = float(depth_at(np.array(out), E_star, work, self.own.R)) / self.noise[0]
        jump_out = float(load_at(np.array(out), E_star, work, self.own.R)) / self.noise[1]
        jump_in = float(load_at(np.array(begin), E_star, work, self.own.R)) / self.noise[1]
        contact = self.deepest / self.noise[0] > vector[2]
        for own, first, corner, low in ((~back, begin, 0.0, jump_in), (back, out, fold, jump_out)):
            if not own.any():
                continue
            x, y = points[own].T
            edge = corner if contact else np.inf
            pieces = [(np.minimum(x, edge), np.zeros_like(y), np.zeros_like(x), 0 * x)]
            if contact:
                moves = np.full_like(x, 2.0 * (corner != 0.0))
                pieces.append((np.full_like(x, corner), np.clip(y, low, 0.0), np.zeros_like(x), moves))
                a = self._nearest(points[own], E_star, work, first, max(first, turn))
                u, v = self._scaled(a, E_star, work)
                pieces.append((u, v, a, 0 * x + 1))
            squares = np.array([(x - u) ** 2 + (y - v) ** 2 for u, v, _, _ in pieces])
            best = np.argmin(squares, axis=0)
            u, v, a, kind = (np.choose(best, [piece[i] for piece in pieces]) for i in range(4))
            size = np.sqrt(squares.min(axis=0))
            side = np.where(np.where(kind == 1, y > v, np.where(best == 0, y > 0.0, x < corner)), 1.0, -1.0)
            away[own], at[own], where[own] = side * size, a, kind
            normal[own] = side[:, None] * np.column_stack([x - u, y - v]) / np.maximum(size, 1e-300)[:, None]
        return away, normal, at, where

    def _scaled(self, a: Array, E_star: float, work: float) -> tuple[Array, Array]:
        R = self.own.R
        return depth_at(a, E_star, work, R) / self.noise[0], load_at(a, E_star, work, R) / self.noise[1]

    def _nearest(self, points: Array, E_star: float, work: float, first: float, last: float) -> Array:
        """Return the radii of the feet on the curve: the nearest of many chords, then Newton's steps beside it."""
        a = np.geomspace(first, max(last, first * (1.0 + 1e-9)), _VERTICES)
        x, y = self._scaled(a, E_star, work)
        run = np.diff(np.column_stack([x, y]), axis=0)
        dx, dy = points[:, :1] - x[:-1], points[:, 1:] - y[:-1]
        share = np.clip((dx * run[:, 0] + dy * run[:, 1]) / np.maximum(np.sum(run**2, axis=1), 1e-300), 0.0, 1.0)
        piece = np.argmin((dx - share * run[:, 0]) ** 2 + (dy - share * run[:, 1]) ** 2, axis=1)
        rows = np.arange(len(points))
        found: Array = a[piece] + share[rows, piece] * (a[piece + 1] - a[piece])
        low, high = a[np.maximum(piece - 1, 0)], a[np.minimum(piece + 2, _VERTICES - 1)]
        R, (s, t) = self.own.R, self.noise
        c, d = math.sqrt(2.0 * math.pi * work / E_star), math.sqrt(8.0 * math.pi * work * E_star)
        for _ in range(8):
            u, v = self._scaled(found, E_star, work)
            root = np.sqrt(found)
            u1, v1 = (2 * found / R - 0.5 * c / root) / s, (4 * E_star * found**2 / R - 1.5 * d * root) / t
            u2, v2 = (2 / R + 0.25 * c / root**3) / s, (8 * E_star * found / R - 0.75 * d / root) / t
            slope = (u - points[:, 0]) * u1 + (v - points[:, 1]) * v1
            bend = u1**2 + v1**2 + (u - points[:, 0]) * u2 + (v - points[:, 1]) * v2
            bend = np.where(bend > 0.1 * (u1**2 + v1**2), bend, u1**2 + v1**2)
            found = np.clip(found - slope / np.maximum(bend, 1e-300), low, high)
        return found


def scipy_fit(branch: Branch, starts: int = STARTS, seed: int = 0) -> tuple[Array, Array, float]:
    """Return values in SI units, standard deviations (E* and w relative to the value) and the sum of squares."""
    misfit, coarse = Misfit(branch), Misfit(branch, _FEW)
    low, high = misfit.low, misfit.high
    begun = low + qmc.Sobol(4, seed=seed).random(2 ** math.ceil(math.log2(starts)))[:starts] * (high - low)
    ends = sorted((refined(coarse, start, 60) for start in begun), key=lambda done: float(done.cost))
    best = min((refined(misfit, done.x, 100) for done in ends[:_FEW]), key=lambda done: float(done.cost))
    jacobian = best.jac
    covariance = np.linalg.pinv(jacobian.T @ jacobian)
    return misfit.values(best.x), np.sqrt(np.diag(covariance)) * [1.0, 1.0, *branch.noise], 2.0 * float(best.cost)


def refined(misfit: Misfit, start: Array, most: int) -> Any:
    """Return the minimum that SciPy reaches from a start."""
    width = misfit.high - misfit.low
    inside = np.clip(start, misfit.low + 1e-9 * width, misfit.high - 1e-9 * width)
    return least_squares(
        misfit.residual, inside, misfit.jacobian, (misfit.low, misfit.high), x_scale="jac", xtol=1e-12, ftol=1e-12,
        gtol=1e-12, max_nfev=most,
    )  # fmt: skip
