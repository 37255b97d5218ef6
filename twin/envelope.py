"""The closed forms of the envelopes (5.21)-(5.43) of a short wave, in ball arithmetic and units R = dgamma = 1.

With s, the wave's r = pi^((1-k)/2) G((1+k)/2) A lambda^((1+k)/2) and c = (1-k)/2 the contact follows

    delta = a^2/(1+k) - (s -+ r) a^c,    P = K [2 a^(3+k)/((1+k)(3+k)) - (s -+ r) a^((3+k)/2)]

with the upper signs on loading, beyond a_in where that delta is 0, and the lower ones on unloading, down to a_out where
it is least. With rho = (delta_H - delta)/Delta the energy is  int 2 pi a (rho^2 on unloading - rho^2 on loading) da.
The mean height lambda A of the wave, which the printed form leaves out, is added to the two depths.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from flint import arb

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
    margin_jumps: float
    energy_size: float
    delta_max_size: float
    delta_jump_out_size: float


def solve_envelope(parameters: Mapping[str, float]) -> Envelope:
    """Solve one scene in the limit of a short wave."""
    k, rim = arb(parameters["k"]), arb(parameters["a_max_over_R"])
    unbounded = parameters["a_max_over_R"] == float("inf")
    wavelength, amplitude = arb(parameters["lambda_over_R"]), arb(parameters["A"])
    pi, c, power = arb.pi(), (1 - k) / 2, 2 / (3 + k)
    s, r = strengths(parameters)
    stiffness = 4 * pi / ((1 + k) * s * s)

    def within(a: arb) -> arb:
        return a if unbounded or not a > rim else rim

    def depth(pull: arb, a: arb) -> tuple[arb, float]:
        """Return the depth on an envelope with the mean height of the wave, and the size of its terms."""
        terms = a * a / (1 + k), pull * (a**c if k < 1 else arb(1)), wavelength * amplitude
        return terms[0] - terms[1] + terms[2], float(sum((abs(term) for term in terms), arb(0)))

    a_in = within(((1 + k) * (s - r)) ** power) if r < s else arb(0)
    a_out = within(((1 - k * k) / 4 * (s + r)) ** power) if k < 1 else arb(0)
    lowest, lowest_size = depth(s + r, a_out)
    greatest, greatest_size = (None, float("inf")) if unbounded else depth(s - r, rim)
    if greatest is not None and not greatest > 0:
        greatest = arb(0)

    last = lowest - wavelength * amplitude  # in the energy depths begin at the mean surface
    gains = [
        2 * pi / (s * s) * a_out ** (5 + k) / ((1 + k) ** 2 * (5 + k)),
        -4 * pi / (s * s) * last * a_out ** (3 + k) / ((1 + k) * (3 + k)),
        2 * pi / (s * s) * last * last * a_out ** (1 + k) / (1 + k),
        -pi * ((1 + r / s) * a_out) ** 2,
        -2 * pi / (s * s) * a_in ** (5 + k) / ((1 + k) ** 2 * (5 + k)),
        pi * ((1 - r / s) * a_in) ** 2,
    ]
    endless = unbounded and bool(r > 0)
    if not unbounded:
        gains.append(4 * pi * r / s * rim * rim)

    held = ((1 + k) * (3 + k) / 4 * (s + r)) ** power
    force = (3 + k) / 3 * (1 + r / s) ** 2
    if not unbounded and rim < held:
        load = stiffness * (2 * rim ** (3 + k) / ((1 + k) * (3 + k)) - (s + r) * rim ** ((3 + k) / 2))
        held, force = rim, -load / (3 * pi / 2)
    return Envelope(
        pull_off_force=force,
        pull_off_radius=held,
        dissipated_energy=None if endless else sum(gains, arb(0)),
        loading_jumps=1 if a_in > 0 else 0,
        unloading_jumps=1 if a_out > 0 else 0,
        delta_max=greatest,
        delta_jump_out=lowest,
        margin_jumps=float(abs(s - r) / (s + r)),
        energy_size=float(sum((abs(gain) for gain in gains), arb(0))),
        delta_max_size=greatest_size,
        delta_jump_out_size=lowest_size,
    )
