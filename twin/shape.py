"""What a scene of the twin is: a power m, a Fourier series, and displacement, load or a machine prescribed."""

from dataclasses import dataclass
from typing import Final

Harmonic = tuple[int, float, float]
"""n, cos_n, sin_n."""


@dataclass(frozen=True)
class Shape:
    """The power m of a punch, its waves, and what is prescribed: "displacement", "load" or "machine"."""

    exponent: float = 2.0
    harmonics: tuple[Harmonic, ...] = ((1, 1.0, 0.0),)
    control: str = "displacement"
    pattern: tuple[Harmonic, ...] = ()
    """The waves of a toughness that varies with the radius, and what they multiply: "toughness" or "work"."""
    pattern_of: str = "toughness"


PLAIN: Final = Shape()
"""A paraboloid with one cosine wave under displacement control."""
