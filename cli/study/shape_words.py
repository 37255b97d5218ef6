"""The shape of a punch and the control of its loading in words, for datasets and `gradhesion info`."""

from collections.abc import Iterable
from typing import Final

from gradhesion.core.answers.spectrum import Spectrum
from gradhesion.core.problem.profile import Harmonic, Profile
from gradhesion.core.problem.toughness import Rate, Toughness, ToughnessHarmonic

CONTROLS: Final = {
    "displacement": "displacement",
    "load": "load, so that the energy of the jump-out, which has no bound, is left out",
    "machine": "displacement through a machine of finite stiffness",
}
"""What is controlled."""


def shape_in_words(profile: Profile, spectrum: Spectrum | None = None) -> str:
    """Write the shape of a punch as a formula; of random roughness what it is drawn from."""
    m = profile.exponent
    power = {1.0: "", 2.0: " R"}.get(m, f" R^{m - 1.0:.15g}")
    own = f"r^{m:.15g}/({m:.15g}{power})" if m != 1.0 else "r"
    written = _series(profile.harmonics, "x", "1 - cos")
    if spectrum is not None:
        waves = f"random waves {spectrum.first} to {spectrum.last}, Hurst exponent {spectrum.hurst:.15g}"
        written = f"{waves}; {spectrum.realisations:,} realisations, seed {spectrum.seed}"
    return f"{own} + lambda A [{written}], x = r/lambda" if written else own


def profile_table(profile: Profile) -> str:
    """Write the shape of a punch as the keys of a table [profile]."""
    waves = "".join(f"    {{ n = {wave.n}, cos = {wave.cos!r}, sin = {wave.sin!r} }},\n" for wave in profile.harmonics)
    return f"exponent  = {profile.exponent!r}\nharmonics = [\n{waves}]"


def toughness_in_words(toughness: Toughness) -> str:
    """Write how the toughness varies with the radius as a formula.

    >>> toughness_in_words(Toughness((ToughnessHarmonic(n=1, cos=0.5), ToughnessHarmonic(n=2, sin=-0.1))))
    'K_c times 1 + t [0.5 cos(2 pi y) - 0.1 sin(4 pi y)], y = r/lambda_t'
    """
    written, what = _series(toughness.harmonics, "y", "cos"), {"toughness": "K_c", "work": "w"}[toughness.of]
    return f"{what} times 1 + t [{written}], y = r/lambda_t" if written else f"{what} times 1"


def rate_in_words(rate: Rate) -> str:
    """Write how the work of adhesion grows with the speed of the edge.

    >>> rate_in_words(Rate(exponent=0.6))
    'G = w_o [1 + (v/v*)^0.6] while the edge opens, G = w_c while it closes'
    """
    power = f"(v/v*)^{rate.exponent:.15g}"
    closing = f"G = w_c/[1 + {power}]" if rate.closing == "same" else "G = w_c"
    return f"G = w_o [1 + {power}] while the edge opens, {closing} while it closes"


def _series(harmonics: Iterable[Harmonic | ToughnessHarmonic], angle: str, cosine: str) -> str:
    """Write the waves that are there with their sizes as a sum."""
    sizes = [(size, f"{wave}({2 * one.n} pi {angle})") for one in harmonics
             for size, wave in ((one.cos, cosine), (one.sin, "sin")) if size != 0.0]  # fmt: skip
    text = ""
    for size, wave in sizes:
        bare = not wave.startswith("1") or (len(sizes) == 1 and size == 1.0)
        factor = "" if abs(size) == 1.0 else f"{abs(size):.15g} "
        text += f" {'-' if size < 0.0 else '+'} {factor}{wave if bare else f'({wave})'}"
    return f"-{text[3:]}" if text.startswith(" - ") else text[3:]
