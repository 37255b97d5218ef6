"""The closed forms of the envelopes (5.21)-(5.43) of a short wave, in ball arithmetic and units R = dgamma = 1.

With s, F of a punch r^m/m, the swings r_+ and r_- of the waves about their mean and c = (1-k)/2 the contact follows

    delta = F a^m - (s -+ r_+-) a^c,    P = K [m/(1+k+m) F a^(1+k+m) - (s -+ r_+-) a^((3+k)/2)]

with the upper signs on loading, beyond a_in where that delta is 0, and the lower ones on unloading, down to a_out where
it is least. With rho = (delta_H - delta)/Delta the energy is  int 2 pi a (rho^2 on unloading - rho^2 on loading) da.
The mean height lambda A sum cos_n of the waves, which the printed form leaves out, is added to the two depths.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from flint import arb

from gradhesion.twin.shape import PLAIN, Harmonic, Shape
from gradhesion.twin.special import theta


def _stiffness(parameters: Mapping[str, float]) -> arb:
    """Return M."""
    k = arb(parameters["k"])
    return theta(k, arb(parameters["nu"])) * arb(parameters["modulus"]) / arb(parameters["c0_over_R"]) ** k


def similarity_length(parameters: Mapping[str, float]) -> arb:
    """Return L = (1/M)^(1/(3+k))."""
    return (1 / _stiffness(parameters)) ** (1 / (3 + arb(parameters["k"])))


def strengths(parameters: Mapping[str, float]) -> tuple[arb, arb]:
    """Return s and r."""
    k = arb(parameters["k"])
    s = (2 ** (1 + k) * arb.pi() / _stiffness(parameters)).sqrt()
    wave = arb(parameters["A"]) * arb(parameters["lambda_over_R"]) ** ((1 + k) / 2)
    return s, arb.pi() ** ((1 - k) / 2) * ((1 + k) / 2).gamma() * wave


def swings(k: arb, harmonics: tuple[Harmonic, ...]) -> tuple[arb, arb]:
    """Return the largest  sum n^c [cos_n sin(n t - phi) + sin_n cos(n t - phi)], phi = pi (1+k)/4, and minus the least.

    Every crest of a fine grid that may be the highest is refined by Newton's method.
    """
    waves = [(n, n ** ((1 - k) / 2), arb(even), arb(odd)) for n, even, odd in harmonics if even != 0.0 or odd != 0.0]
    if not waves:
        return arb(0), arb(0)
    phi = arb.pi() * (1 + k) / 4

    def height(t: arb, order: int) -> arb:
        turn = arb.pi() / 2 * order
        terms = ((n, size, n * t - phi + turn, even, odd) for n, size, even, odd in waves)
        return sum((n**order * size * (even * p.sin() + odd * p.cos()) for n, size, p, even, odd in terms), arb(0))

    count = GRID * max(n for n, *_ in waves)
    rough = [(n, float(size), float(even), float(odd)) for n, size, even, odd in waves]
    step, shift = 2 * math.pi / count, float(phi)
    grid = [
        sum(
            size * (even * math.sin(p) + odd * math.cos(p))
            for n, size, even, odd in rough
            for p in (n * j * step - shift,)
        )
        for j in range(count)
    ]
    slack = sum(n * n * size * (abs(even) + abs(odd)) for n, size, even, odd in rough) * step * step / 8
    found = []
    for sign in (1, -1):
        best = max(sign * value for value in grid)
        crests = []
        for j in range(count):
            here = sign * grid[j]
            if here >= best - slack and here >= sign * grid[j - 1] and here >= sign * grid[(j + 1) % count]:
                t = 2 * arb.pi() * j / count
                for _ in range(8):
                    t = (t - height(t, 1) / height(t, 2)).mid()
                crests.append(sign * height(t, 0))
        found.append(max(crests, key=float))
    return found[0], found[1]


def amplitude(parameters: Mapping[str, float], ratio: float) -> arb:
    """Return the A of r/s."""
    s, r = strengths({**parameters, "A": 1.0})
    return ratio * s / r


def jump_in_radius(parameters: Mapping[str, float]) -> tuple[arb, float]:
    """Return the radius a_2 of (5.34), and the relative change of it for one of s and r; NaN where r >= s."""
    k = arb(parameters["k"])
    s, r = strengths(parameters)
    if not r < s:
        return arb("nan"), float("inf")
    return ((1 + k) * (s - r)) ** (2 / (3 + k)), float((s + r) / (s - r))


GRID: Final = 64
"""Points of a wave of the shortest kind on which crests are looked for."""


@dataclass(frozen=True)
class Envelope:
    """Outputs in the units of a study, `None` where they are infinite, with the sizes of their terms."""

    pull_off_force: arb
    pull_off_radius: arb
    dissipated_energy: arb | None
    loading_jumps: int
    unloading_jumps: int
    delta_max: arb | None
    delta_jump_out: arb
    loading_energy: arb | None
    unloading_energy: arb | None
    margin_jumps: float
    energy_size: float
    delta_max_size: float
    delta_jump_out_size: float


def solve_envelope(parameters: Mapping[str, float], shape: Shape = PLAIN) -> Envelope:
    """Solve one scene in the limit of a short wave, under displacement control."""
    k, m, rim = arb(parameters["k"]), arb(shape.exponent), arb(parameters["a_max_over_R"])
    unbounded = parameters["a_max_over_R"] == float("inf")
    pi, c = arb.pi(), (1 - k) / 2
    power = 1 / (m - c)
    mean = arb(parameters["lambda_over_R"]) * arb(parameters["A"]) * sum((arb(h[1]) for h in shape.harmonics), arb(0))
    s, one = strengths(parameters)
    up, down = (one * swing for swing in swings(k, shape.harmonics))
    front = (m / 2).gamma() * ((1 + k) / 2).gamma() / (2 * ((1 + k + m) / 2).gamma())
    stiffness = 4 * pi / ((1 + k) * s * s)

    def within(a: arb) -> arb:
        return a if unbounded or not a > rim else rim

    def depth(pull: arb, a: arb) -> tuple[arb, float]:
        """Return the depth on an envelope with the mean height of the wave, and the size of its terms."""
        terms = front * a**m, pull * (a**c if k < 1 else arb(1)), mean
        return terms[0] - terms[1] + terms[2], float(sum((abs(term) for term in terms), arb(0)))

    a_in = within(((s - up) / front) ** power) if up < s else arb(0)
    a_out = within((c * (s + down) / (m * front)) ** power) if k < 1 else arb(0)
    lowest, lowest_size = depth(s + down, a_out)
    greatest, greatest_size = (None, float("inf")) if unbounded else depth(s - up, rim)
    if greatest is not None and not greatest > 0:
        greatest = arb(0)

    last = lowest - mean  # in the energy depths begin at the mean surface
    gains = [
        2 * pi / (s * s) * front**2 * a_out ** (2 * m + 1 + k) / (2 * m + 1 + k),
        -4 * pi / (s * s) * last * front * a_out ** (m + 1 + k) / (m + 1 + k),
        2 * pi / (s * s) * last * last * a_out ** (1 + k) / (1 + k),
        -pi * ((1 + down / s) * a_out) ** 2,
        -2 * pi / (s * s) * front**2 * a_in ** (2 * m + 1 + k) / (2 * m + 1 + k),
        pi * ((1 - up / s) * a_in) ** 2,
    ]
    endless = unbounded and bool(up + down > 0)
    square = (
        one * one * sum((arb(n) ** (1 - k) * (arb(p) ** 2 + arb(q) ** 2) for n, p, q in shape.harmonics), arb(0)) / 2
    )
    parts = [sum(gains[4:], arb(0)), sum(gains[:4], arb(0))]  # of loading and of unloading
    if not unbounded:
        gains.append(pi * (up + down) / s * (2 + (down - up) / s) * rim * rim)
        parts[0] += pi * (up * (2 * s - up) - square) / (s * s) * rim * rim
        parts[1] += pi * (down * (2 * s + down) + square) / (s * s) * rim * rim

    held = within(((3 + k) * (s + down) / (2 * m * front)) ** power)
    load = stiffness * held ** (1 + k) * (m / (1 + k + m) * front * held**m - (s + down) * held**c)
    return Envelope(
        pull_off_force=-load / (3 * pi / 2),
        pull_off_radius=held,
        dissipated_energy=None if endless else sum(gains, arb(0)),
        loading_jumps=1 if a_in > 0 else 0,
        unloading_jumps=1 if a_out > 0 else 0,
        delta_max=greatest,
        delta_jump_out=lowest,
        loading_energy=None if endless else parts[0],
        unloading_energy=None if endless else parts[1],
        margin_jumps=float(abs(s - up) / (s + up)),
        energy_size=float(sum((abs(gain) for gain in gains), arb(0))),
        delta_max_size=greatest_size,
        delta_jump_out_size=lowest_size,
    )
