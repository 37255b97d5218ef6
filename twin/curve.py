"""The equilibrium curve of one scene, in units R = dgamma = 1, by the phase z = 2 pi a/lambda of the contact radius a.

    delta(z) = a^2/(1+k) + 2 pi A a S0(z) - Delta,      Delta = s a^((1-k)/2),   s = sqrt(2^(1+k) pi/M)
    P(z)     = K [ a^(1+k) delta_H - a^(3+k)/(3+k) - 2 pi A a^(2+k) S1(z) - a^(1+k) Delta ]

Both have their extrema where  tilt(z) = 2/(1+k) + g V(z) - c z^(-(3+k)/2)  vanishes, V = (z S0)'/z and
g = (2 pi)^2 A/lambda, with c = `fold` for delta and c = `trough` for P; each grows with a exactly where its tilt is
positive.
"""

import math
from collections.abc import Mapping
from functools import lru_cache

from flint import arb

from gradhesion.twin.special import Sine, theta
from gradhesion.twin.window import grid


@lru_cache(maxsize=2)
def sine_of(k: float) -> Sine:
    """Return the universal functions of k, shared by the scenes that have it; 140 kB a wave once they are filled."""
    return Sine(arb(k))


class Curve:
    """delta, P and the tilt of one scene; parameters are exact doubles under the keys of a study."""

    shortest = 1
    innermost = 1.5

    def __init__(self, parameters: Mapping[str, float], work: float = 1.0) -> None:
        """Derive M and the coefficients of the curve, whose work of adhesion is `work` dgamma."""
        k, nu = arb(parameters["k"]), arb(parameters["nu"])
        pi = arb.pi()
        self.k, self.sine = k, sine_of(parameters["k"])
        self.amplitude = arb(parameters["A"])
        self.theta = theta(k, nu)
        self.modulus = self.theta * arb(parameters["modulus"]) / arb(parameters["c0_over_R"]) ** k
        self.stiffness = 2 ** (1 - k) * self.modulus / (1 + k)
        self.strength = (2 ** (1 + k) * pi / self.modulus).sqrt()
        self.work = arb(work)
        self.adhesion = self.strength * self.work.sqrt()
        self.wavelength = arb(parameters["lambda_over_R"]) if self.amplitude > 0 else self._natural_wavelength()
        self.waviness = 4 * pi * pi * self.amplitude / self.wavelength
        unit = self.adhesion * (2 * pi / self.wavelength) ** ((3 + k) / 2)
        self.fold = unit * (1 - k) / 2
        self.trough = unit * (3 + k) / 2
        self.starts_rising = bool(self.fold == 0)
        rim = parameters["a_max_over_R"]
        self.rim = self.phase(arb(rim)).mid() if rim != float("inf") else None

    def _natural_wavelength(self) -> arb:
        """Give a smooth punch, which has none, a wavelength at which the phase of its jump-in is about 1."""
        jump_in = ((1 + self.k) * self.strength) ** (2 / (3 + self.k))
        return 2 * arb.pi() * arb(2) ** round(math.log2(float(jump_in)))

    def phase(self, a: arb) -> arb:
        """Return the phase z of the radius a."""
        return 2 * arb.pi() * a / self.wavelength

    def radius(self, z: arb) -> arb:
        """Return the radius a at the phase z."""
        return z * self.wavelength / (2 * arb.pi())

    def hertz(self, z: arb) -> arb:
        """delta_H, the indentation without adhesion."""
        a = self.radius(z)
        if self.amplitude == 0:
            return a * a / (1 + self.k)
        return a * a / (1 + self.k) + 2 * arb.pi() * self.amplitude * a * self.sine.s0(z)

    def gap(self, z: arb) -> arb:
        """Delta, the part of adhesion in delta."""
        return self.adhesion * self.radius(z) ** ((1 - self.k) / 2)

    def delta(self, z: arb) -> arb:
        """Indentation in equilibrium."""
        return self.hertz(z) - self.gap(z)

    coordinate = delta

    def ratio(self, z: arb, level: arb) -> arb:
        """Rho = (delta_H - level)/Delta at a depth that is held, Delta that of dgamma."""
        return (self.hertz(z) - level) / (self.strength * self.radius(z) ** ((1 - self.k) / 2))

    def release(self, _z: arb) -> arb:
        """Work of adhesion, over dgamma."""
        return self.work

    def pinned(self, z: arb) -> arb:
        """Depth between the curve of dgamma and that of the work of adhesion."""
        return (self.strength - self.adhesion) * self.radius(z) ** ((1 - self.k) / 2)

    def force_at_zero(self, z: arb) -> arb:
        """Load of a contact of this radius at the coordinate 0, in equilibrium or not."""
        return self.force(z) - self.stiffness * self.radius(z) ** (1 + self.k) * self.delta(z)

    def depth_at_full_contact(self, level: arb) -> arb:
        """Depth at the rim is what is prescribed."""
        return level

    def work_at_rim(self, level: arb) -> arb:
        """Return the integral of P d(delta) from the depth of the rim to `level`; P has the slope K a^(1+k)."""
        assert self.rim is not None
        pinned = level - self.delta(self.rim)
        spring = self.stiffness * self.radius(self.rim) ** (1 + self.k)
        return self.force(self.rim) * pinned + spring * pinned * pinned / 2

    def force(self, z: arb) -> arb:
        """Load P in equilibrium."""
        k, a = self.k, self.radius(z)
        height = 2 * a * a / ((1 + k) * (3 + k)) - self.gap(z)
        if self.amplitude > 0:
            s0, s1 = self.sine.pair(z)
            height += 2 * arb.pi() * self.amplitude * a * (s0 - s1)
        return self.stiffness * a ** (1 + k) * height

    def force_size(self, z: arb) -> arb:
        """Return the sum of the sizes of the three terms of P."""
        k, a = self.k, self.radius(z)
        smooth, gap = 2 * a * a / ((1 + k) * (3 + k)), self.gap(z)
        wave = self.force(z) / (self.stiffness * a ** (1 + k)) - smooth + gap
        return self.stiffness * a ** (1 + k) * (smooth + gap + abs(wave))

    def tilt(self, z: arb, c: arb) -> tuple[arb, arb]:
        """Return the tilt with the coefficient c and its derivative in z (enclosures when z is a ball)."""
        v, slope = self.sine.v(z) if self.amplitude > 0 else (arb(0), arb(0))
        b = 2 / (1 + self.k)
        if c == 0:
            return b + self.waviness * v, self.waviness * slope
        p = (3 + self.k) / 2
        pull = c * z**-p
        return b + self.waviness * v - pull, self.waviness * slope + p * pull / z

    def slope(self, z: arb) -> arb:
        """Return the derivative of delta in z: a^2/z (tilt with c = fold)."""
        a = self.radius(z)
        return a * a / z * self.tilt(z, self.fold)[0]

    def grid(self, c: arb, end: arb | None) -> list[arb]:
        """Return phases that cut the window of a control's folds into pieces for `tilt`."""
        return grid(self, c, end)

    def coordinate_size(self, z: arb) -> float:
        """Return the size of the terms of delta but the waves."""
        a = self.radius(z)
        return float(a * a / (1 + self.k) + self.gap(z))

    def depth_size(self, z: arb) -> float:
        """Return the size of delta, of its terms, and of its change with the phase."""
        a = self.radius(z)
        change = z * abs(self.slope(z)) if z > 0 else arb(0)
        return float(abs(self.delta(z)) + a * a / (1 + self.k) + self.gap(z) + change)

    full_depth_size = depth_size

    def tilt_size(self, z: arb, c: arb) -> arb:
        """Return the size of the terms of the tilt but the waves."""
        return 2 / (1 + self.k) + (c * z ** (-(3 + self.k) / 2) if c > 0 else 0)
