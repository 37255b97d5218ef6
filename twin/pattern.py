"""A toughness that varies with the radius: kappa(a) multiplies the adhesive part of depth and load.

t(a) = 1 + amplitude sum_n [cos_n cos(2 pi n a/lambda_t) + sin_n sin(2 pi n a/lambda_t)],   kappa = t or sqrt(t)
"""

import math
from collections.abc import Mapping

from flint import arb

from gradhesion.twin.shape import Shape


class Pattern:
    """Kappa of one scene, with what its derivatives by ln a are, and bounds of them."""

    def __init__(self, parameters: Mapping[str, float], shape: Shape) -> None:
        """Read wavelength and amplitude; without waves kappa is 1."""
        self.rows, self.of_work = shape.pattern, shape.pattern_of == "work"
        size = arb(parameters.get("toughness_amplitude", 1.0)) if self.rows else arb(0)
        self.numbers = [2 * arb.pi() * n / arb(parameters["toughness_wavelength_over_R"]) for n, _, _ in self.rows]
        self.waves = [(size * even, size * odd) for _, even, odd in self.rows]
        heights = [float(size) * math.hypot(even, odd) for _, even, odd in self.rows]
        self.greatest = 1.0 + sum(map(abs, heights))
        self.steepest = sum(abs(height) * float(number) for height, number in zip(heights, self.numbers, strict=True))
        if self.of_work:  # of its root, as far as t is bounded away from 0
            least = 1.0 - sum(map(abs, heights))
            self.steepest = self.steepest / (2 * math.sqrt(least)) if least > 0 else math.inf

    def waves_in(self, wavelength: arb) -> int:
        """Return how many of the shortest waves are in a length, rounded up."""
        shortest = max((float(number) for number in self.numbers), default=0.0)
        return math.ceil(shortest * float(wavelength) / (2 * math.pi))

    def at(self, a: arb) -> tuple[arb, arb, arb]:
        """Return kappa, a kappa', and a (a kappa')' (enclosures when a is a ball)."""
        t, first, second = arb(1), arb(0), arb(0)
        for number, (even, odd) in zip(self.numbers, self.waves, strict=True):
            phase = number * a
            sine, cosine = phase.sin(), phase.cos()
            wave, turned = even * cosine + odd * sine, odd * cosine - even * sine
            t += wave
            first += phase * turned
            second += phase * turned - phase * phase * wave
        if not self.of_work:
            return t, first, second
        kappa = t.sqrt()
        return kappa, first / (2 * kappa), second / (2 * kappa) - first * first / (4 * t * kappa)
