"""The twin of any profile under any control: m, a Fourier series, and displacement, load or a machine prescribed."""

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


PLAIN: Final = Shape()
"""A paraboloid with one cosine wave under displacement control."""
