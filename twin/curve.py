"""The equilibrium curve of any profile under any control, in units R = dgamma = 1, by the phase z = 2 pi a/lambda.

    delta(z) = F a^m + 2 pi A a W(z) - Delta,      F = G(m/2) G((1+k)/2)/(2 G((1+k+m)/2)),   Delta = s a^((1-k)/2)
    P(z)     = K a^(1+k) [ F m/(1+k+m) a^m + 2 pi A a (W - U)(z) - Delta ]

What is prescribed is the coordinate  Y = alpha delta + beta P/K:  the depth (1, 0), the load (0, 1), or the far end of
a machine of stiffness S, (1, K/S). With tau = beta a^(1+k)

    dY/da = (alpha + tau) T,      T = m F a^(m-1) + 2 pi A V(z) - q s a^((1-k)/2 - 1)
    q = (alpha (1-k)/2 + tau (3+k)/2)/(alpha + tau)

and T is the tilt: Y rises with a exactly where it is positive.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

from flint import arb

from gradhesion.twin import bounds
from gradhesion.twin.pattern import Pattern
from gradhesion.twin.series import series_of
from gradhesion.twin.shape import PLAIN, Shape
from gradhesion.twin.special import theta


class Control(NamedTuple):
    """What is prescribed: alpha, beta, and whether only folds where P pulls are of interest."""

    alpha: arb
    beta: arb
    pulling: bool = False


class Curve:
    """Coordinate, depth, load and tilt of one scene; parameters are exact doubles under the keys of a study."""

    def __init__(self, parameters: Mapping[str, float], shape: Shape = PLAIN, work: float = 1.0) -> None:
        """Derive M and the coefficients of the curve, whose work of adhesion is `work` dgamma.

        With the control "machine" there is a `machine_stiffness`.
        """
        k, m = arb(parameters["k"]), arb(shape.exponent)
        self.k, self.m, self.c = k, m, (1 - k) / 2
        self.theta = theta(k, arb(parameters["nu"]))
        modulus = arb(parameters["modulus"])
        self.modulus = self.theta * modulus / arb(parameters["c0_over_R"]) ** k
        self.stiffness = 2 ** (1 - k) * self.modulus / (1 + k)
        self.strength = (2 ** (1 + k) * arb.pi() / self.modulus).sqrt()
        self.work = arb(work)
        self.adhesion = self.strength * self.work.sqrt()
        self.front = (m / 2).gamma() * ((1 + k) / 2).gamma() / (2 * ((1 + k + m) / 2).gamma())
        waves = tuple(wave for wave in shape.harmonics if wave[1] != 0.0 or wave[2] != 0.0)
        self.amplitude = arb(parameters["A"]) if waves else arb(0)
        self.series = series_of(parameters["k"], waves if self.amplitude > 0 else ())
        self.wavelength = arb(parameters["lambda_over_R"]) if self.amplitude > 0 else self._natural_wavelength()
        self.trough = Control(arb(0), arb(1), pulling=True)
        self.compliance = arb(0)
        if shape.control == "machine":
            self.compliance = self.stiffness / (arb(parameters["machine_stiffness"]) * modulus)
        self.fold = Control(arb(0), arb(1)) if shape.control == "load" else Control(arb(1), self.compliance)
        rim = parameters["a_max_over_R"]
        self.rim = self.phase(arb(rim)).mid() if rim != float("inf") else None
        self.pattern = Pattern(parameters, shape)
        self.shortest = max(self.series.shortest, self.pattern.waves_in(self.wavelength))
        self.starts_rising = bool(self.tilt(bounds.first(self, self.fold), self.fold)[0] > 0)
        self.innermost = self._innermost()

    def _natural_wavelength(self) -> arb:
        """Give a smooth punch, which has none, a wavelength at which the phase of its jump-in is about 1."""
        jump_in = (self.strength / self.front) ** (1 / (self.m - self.c))
        return 2 * arb.pi() * arb(2) ** round(float(jump_in.log() / arb(2).log()))

    def _innermost(self) -> float:
        """Return a phase below which the energy of a jump has a branch point at 0 and is smooth besides."""
        alpha, beta, _ = self.fold
        nearest = 1.5 / self.shortest
        if alpha > 0 and beta > 0:  # the machine's share of the stiffness changes where tau = alpha
            nearest = min(nearest, 0.25 * float(self.phase((alpha / beta) ** (1 / (1 + self.k)))))
        return nearest

    def phase(self, a: arb) -> arb:
        """Return the phase z of the radius a."""
        return 2 * arb.pi() * a / self.wavelength

    def radius(self, z: arb) -> arb:
        """Return the radius a at the phase z."""
        return z * self.wavelength / (2 * arb.pi())

    def _powers(self, a: arb) -> tuple[arb, arb, arb]:
        """a^(1+k), F a^m and Delta; at a = 0 too."""
        if a == 0:
            return arb(0), arb(0), self.pattern.at(a)[0] * self.adhesion if self.k == 1 else arb(0)
        return a ** (1 + self.k), self.front * a**self.m, self.pattern.at(a)[0] * self.adhesion * a**self.c

    def _state(self, z: arb) -> tuple[arb, arb, arb, arb]:
        """a^(1+k), delta_H, P_H/(K a^(1+k)) and Delta."""
        a = self.radius(z)
        area, bend, gap = self._powers(a)
        depth, load = bend, self.m / (1 + self.k + self.m) * bend
        if self.amplitude > 0:
            w, u = self.series.pair(z)
            depth += 2 * arb.pi() * self.amplitude * a * w
            load += 2 * arb.pi() * self.amplitude * a * (w - u)
        return area, depth, load, gap

    def delta(self, z: arb) -> arb:
        """Indentation in equilibrium."""
        _, depth, _, gap = self._state(z)
        return depth - gap

    def force(self, z: arb) -> arb:
        """Load P in equilibrium."""
        area, _, load, gap = self._state(z)
        return self.stiffness * area * (load - gap)

    def coordinate(self, z: arb) -> arb:
        """Y in equilibrium."""
        area, depth, load, gap = self._state(z)
        alpha, beta, _ = self.fold
        return alpha * (depth - gap) + beta * area * (load - gap)

    def ratio(self, z: arb, level: arb) -> arb:
        """Rho = x/Delta at a coordinate that is held, Delta that of dgamma."""
        area, depth, load, _ = self._state(z)
        alpha, beta, _ = self.fold
        gap = self.strength * self.radius(z) ** self.c
        return (alpha * depth + beta * area * load - level) / ((alpha + beta * area) * gap)

    def release(self, z: arb) -> arb:
        """Work of adhesion at a radius, over dgamma."""
        kappa, _, _ = self.pattern.at(self.radius(z))
        return self.work * kappa * kappa

    def pinned(self, z: arb) -> arb:
        """Return what is prescribed, a depth under a load, between the curve of dgamma and that of the work."""
        area, _, _, _ = self._state(z)
        alpha, beta, _ = self.fold
        depth = self.pattern.at(self.radius(z))[0] * (self.strength - self.adhesion) * self.radius(z) ** self.c
        return depth if alpha == 0 else (alpha + beta * area) * depth

    def force_at_zero(self, z: arb) -> arb:
        """Load of a contact of this radius at the coordinate 0, in equilibrium or not."""
        area, _, _, _ = self._state(z)
        alpha, beta, _ = self.fold
        return self.force(z) - self.stiffness * area * self.coordinate(z) / (alpha + beta * area)

    def _level(self, area: arb, control: Control) -> tuple[arb, arb]:
        """Return q and a dq/da."""
        alpha, beta, _ = control
        tau, k = beta * area, self.k
        q = (alpha * self.c + tau * (3 + k) / 2) / (alpha + tau)
        return q, alpha * tau * ((1 + k) / (alpha + tau)) ** 2

    def tilt(self, z: arb, control: Control) -> tuple[arb, arb]:
        """Return T and its derivative in z (enclosures when z is a ball)."""
        a = self.radius(z)
        if control.alpha == 0 or control.beta == 0:
            q, change = self.c if control.beta == 0 else (3 + self.k) / 2, arb(0)
        else:
            q, change = self._level(a ** (1 + self.k), control)
        bend = self.m * self.front * a ** (self.m - 1)
        pull = self.adhesion * a ** (self.c - 1)
        kappa, first, second = self.pattern.at(a)
        grown = q * kappa + first
        value = bend - grown * pull
        slope = ((self.m - 1) * bend + (grown * (1 - self.c) - change * kappa - q * first - second) * pull) / z
        if self.amplitude > 0:
            v, rate = self.series.v(z)
            wave = 2 * arb.pi() * self.amplitude
            value, slope = value + wave * v, slope + wave * rate
        return value, slope

    def slope(self, z: arb) -> arb:
        """Return the derivative of Y in z."""
        a = self.radius(z)
        alpha, beta, _ = self.fold
        return (alpha + beta * a ** (1 + self.k)) * a / z * self.tilt(z, self.fold)[0]

    def grid(self, control: Control, end: arb | None) -> list[arb]:
        """Return phases that cut the window of a control's folds into pieces for `tilt`."""
        return bounds.grid(self, control, end)

    def depth_at_full_contact(self, level: arb) -> arb:
        """Depth of the contact pinned at the rim where the coordinate has reached `level`."""
        assert self.rim is not None
        alpha, beta, _ = self.fold
        area, depth, load, gap = self._state(self.rim)
        own = alpha * (depth - gap) + beta * area * (load - gap)
        return depth - gap + (level - own) / (alpha + beta * area)

    def work_at_rim(self, level: arb) -> arb:
        """Return the integral of P dY over the pinned contact, from the coordinate of the rim to `level`."""
        assert self.rim is not None
        pinned = level - self.coordinate(self.rim)
        area = self.radius(self.rim) ** (1 + self.k)
        spring = self.stiffness * area / (1 + self.fold.beta * area)
        return self.force(self.rim) * pinned + spring * pinned * pinned / 2

    def wave_size(self, z: arb) -> arb:
        """Return a bound of the size of the waves' part of delta, however much of it cancels."""
        if not self.amplitude > 0:
            return arb(0)
        a = self.radius(z)
        waves = ((n, n * math.hypot(even, odd)) for n, even, odd in self.series.harmonics)
        return 2 * arb.pi() * self.amplitude * a * sum((h * bounds.greatest(self, n * z) for n, h in waves), arb(0))

    def force_size(self, z: arb) -> arb:
        """Return the sum of the sizes of the terms of P."""
        area, bend, gap = self._powers(self.radius(z))
        return self.stiffness * area * (self.m / (1 + self.k + self.m) * bend + gap + self.wave_size(z))

    def coordinate_size(self, z: arb) -> float:
        """Return the size of the terms of Y."""
        area, bend, gap = self._powers(self.radius(z))
        alpha, beta, _ = self.fold
        return float((alpha + beta * area) * (bend + gap + self.wave_size(z)))

    def depth_size(self, z: arb) -> float:
        """Return the size of the terms of delta at a fold or the rim, with its change where the fold is not its own."""
        _, bend, gap = self._powers(self.radius(z))
        size = abs(self.delta(z)) + bend + gap + self.wave_size(z)
        if not z > 0:
            return float(size)
        change = self.radius(z) * abs(self.tilt(z, Control(arb(1), arb(0)))[0])
        if self.rim is None or z != self.rim:
            _, rate = self.tilt(z, self.fold)
            change *= max(1.0, float(self.tilt_size(z, self.fold) / abs(z * rate)))
        return float(size + change)

    def full_depth_size(self, z: arb) -> float:
        """Return the size of the depth at full contact, and of the coordinate, of the phase z, that it is made of."""
        assert self.rim is not None
        alpha, beta, _ = self.fold
        per_depth = float(alpha + beta * self.radius(self.rim) ** (1 + self.k))
        return self.depth_size(self.rim) + (self.coordinate_size(z) if z > 0 else 0.0) / per_depth

    def tilt_size(self, z: arb, control: Control) -> arb:
        """Return the size of the terms of T but the waves."""
        a = self.radius(z)
        q, _ = self._level(a ** (1 + self.k), control)
        pull = q * self.pattern.greatest + float(a) * self.pattern.steepest
        return self.m * self.front * a ** (self.m - 1) + pull * self.adhesion * a ** (self.c - 1)
