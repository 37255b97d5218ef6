"""The moving edge a second way: the profile by Gauss-Jacobi quadrature, and explicit steps along the curve of (s, lag), as the edge opens.

Nothing of core/ is used but the material. With need = a delta_H'/Delta - q0 rho and force = eps a u^(-1/n)/((1+tau) Delta)

    ds/dy = w,  d lag/dy = w (force - need),  1/w = sqrt(1 + need^2) + force,   s = |ln a/a_0|

is not steep where the edge starts, nor where it moves slowly. DOP853 of SciPy at 1e-12.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import beta, roots_jacobi

from gradhesion.core import Loading, Profile
from gradhesion.core.problem.material import stiffness

_END = math.log(1e9)
_FIRST = 1e-11
_EXACT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}


@dataclass
class Punch:
    """Depth and load of a scene at any radius and rho; R = dgamma = 1."""

    scene: dict[str, float]
    profile: Profile
    loading: Loading

    def __post_init__(self) -> None:
        s = self.scene
        self.k = k = s["k"]
        self.M = M = float(stiffness(k, s["nu"], s["modulus"], s["c0_over_R"]))
        self.K = 2.0 ** (1.0 - k) * M / (1.0 + k)
        self.stretch = math.sqrt(2.0 ** (1.0 + k) * math.pi / M)
        spring = s["machine_stiffness"] * s["modulus"] if self.loading.control == "machine" else math.inf
        self.compliance = self.K / spring
        waves = max(0.8, s["a_max_over_R"]) * max(h.n for h in self.profile.harmonics) / s["lambda_over_R"]
        t, weights = roots_jacobi(60 + int(4.0 * waves), 0.5 * (k - 1.0), 0.0)
        self.t = 0.5 * (1.0 + t)
        self.weights = weights * 0.5 ** (0.5 * (1.0 + k)) * (1.0 + self.t) ** (0.5 * (k - 1.0))

    def at(self, a: float) -> tuple[float, float, float]:
        """Return delta_H, a delta_H' and P_H."""
        k, m, lam = self.k, self.profile.exponent, self.scene["lambda_over_R"]
        depth = 0.5 * beta(0.5 * m, 0.5 * (1.0 + k)) * a**m
        slope, integral = m * depth, 0.5 * beta(0.5 * m, 0.5 * (3.0 + k)) * a ** (1.0 + k + m)
        first, second = np.zeros_like(self.t), np.zeros_like(self.t)
        for h in self.profile.harmonics:
            w = 2.0 * math.pi * h.n
            y = w * a * self.t / lam
            first += self.scene["A"] * w * (h.cos * np.sin(y) + h.sin * np.cos(y))
            second += self.scene["A"] * w * w / lam * (h.cos * np.cos(y) - h.sin * np.sin(y))
        wave = a * float(self.weights @ first)
        depth, slope = depth + wave, slope + wave + a * a * float(self.weights @ (self.t * second))
        integral += a ** (2.0 + k) * float(self.weights @ (first * (1.0 - self.t**2)))
        return depth, slope, self.K * (a ** (1.0 + k) * depth - integral)

    def adhesion(self, a: float) -> float:
        """Return Delta."""
        return self.stretch * a ** (0.5 * (1.0 - self.k))

    def terms(self, a: float, rho: float) -> tuple[float, float]:
        """Return need, and force over eps u^(-1/n)."""
        k, tau, adhesion = self.k, self.compliance * a ** (1.0 + self.k), self.adhesion(a)
        q0 = (0.5 * (1.0 - k) + tau * 0.5 * (3.0 + k)) / (1.0 + tau)
        return self.at(a)[1] / adhesion - q0 * rho, a / ((1.0 + tau) * adhesion)

    def load(self, a: float, rho: float) -> float:
        """Return P."""
        return self.at(a)[2] - self.K * a ** (1.0 + self.k) * self.adhesion(a) * rho

    def coordinate(self, a: float, rho: float) -> float:
        """Return delta + P/S."""
        return self.at(a)[0] - self.adhesion(a) * rho + self.compliance / self.K * self.load(a, rho)


def opened(punch: Punch, eps: float, n: float, radius: float) -> dict[str, float]:
    """Return what opening from a radius comes to, in the units of `open_at_speed`."""

    def slow(lag: float) -> float:
        return float((lag * (2.0 + lag)) ** (-1.0 / n)) if lag > 0.0 else 1e300

    def rates(_y: float, state: Any) -> list[float]:
        s, lag, _ = state
        a = radius * math.exp(-s)
        need, force = punch.terms(a, 1.0 + lag)
        force *= eps * slow(lag)
        w = 1.0 / (math.sqrt(1.0 + need * need) + force)
        return [w, w * (force - need), w * 2.0 * math.pi * (a * (1.0 + lag)) ** 2]

    def trough(_y: float, state: Any) -> float:
        a = radius * math.exp(-state[0])
        return math.log(eps * a * slow(state[1]) / ((1.0 + punch.k) * punch.adhesion(a) * (1.0 + state[1])))

    def end(_y: float, state: Any) -> float:
        return float(state[0] - _END)

    end.terminal = True  # type: ignore[attr-defined]
    lag = _FIRST
    s = n / (1.0 + n) * lag * (2.0 * lag) ** (1.0 / n) / (eps * punch.terms(radius, 1.0)[1])
    energy = 2.0 * math.pi * radius**2 * s
    found = solve_ivp(rates, (0.0, 1e9), [s, lag, energy], events=[trough, end], **_EXACT)
    places = [(radius, 1.0 + _FIRST)] + [(radius * math.exp(-one[0]), 1.0 + one[1]) for one in found.y_events[0]]
    load, a, rho = min((punch.load(a, rho), a, rho) for a, rho in places)
    s, lag, energy = found.y[:, -1]
    last = radius * math.exp(-s)
    depth = punch.coordinate(last, 1.0 + lag) - eps * last * slow(lag) * n / (n + 1.0 - punch.k)
    energy += 2.0 * math.pi * (depth / punch.stretch) ** 2 * last ** (1.0 + punch.k) / (1.0 + punch.k)
    return {
        "pull_off_force": -load / (1.5 * math.pi),
        "pull_off_radius": a,
        "opening_energy": energy,
        "delta_jump_out": depth,
        "edge_speed_at_pull_off": 1.0 / slow(rho - 1.0),
    }
