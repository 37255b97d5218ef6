"""The shape of a punch and the control of its loading in words, for datasets and `gradhesion info`."""

from gradhesion.core.answers.spectrum import Spectrum
from gradhesion.core.problem.control import Loading
from gradhesion.core.problem.profile import Harmonic, Profile
from gradhesion.core.problem.toughness import Rate, Toughness


def shape_in_words(profile: Profile, spectrum: Spectrum | None = None) -> str:
    """
    Write the shape of a punch as a formula; of random roughness what it is drawn from.

    >>> shape_in_words(Profile())
    'r^2/(2 R) + lambda A [1 - cos(2 pi x)], x = r/lambda'
    >>> shape_in_words(Profile(exponent=1.5, harmonics=(Harmonic(n=1, cos=0.0, sin=1.0), Harmonic(n=3, cos=-0.25))))
    'r^1.5/(1.5 R^0.5) + lambda A [sin(2 pi x) - 0.25 (1 - cos(6 pi x))], x = r/lambda'
    """
    m = profile.exponent
    power = {1.0: "", 2.0: " R"}.get(m, f" R^{m - 1.0:.15g}")
    own = f"r^{m:.15g}/({m:.15g}{power})" if m != 1.0 else "r"
    if spectrum is not None:
        waves = f"random waves {spectrum.first} to {spectrum.last}, Hurst exponent {spectrum.hurst:.15g}"
        drawn = f"{spectrum.realisations:,} realisations, seed {spectrum.seed}"
        return f"{own} + lambda A [{waves}; {drawn}], x = r/lambda"
    written = _series([term for harmonic in profile.harmonics for term in _terms(harmonic)])
    return f"{own} + lambda A [{written}], x = r/lambda" if written else own


def profile_table(profile: Profile) -> str:
    """
    Write the shape of a punch as the keys of a table [profile].

    >>> print(profile_table(Profile(exponent=1.5)))
    exponent  = 1.5
    harmonics = [
        { n = 1, cos = 1.0, sin = 0.0 },
    ]
    """
    waves = "".join(f"    {{ n = {wave.n}, cos = {wave.cos!r}, sin = {wave.sin!r} }},\n" for wave in profile.harmonics)
    return f"exponent  = {profile.exponent!r}\nharmonics = [\n{waves}]"


def control_in_words(loading: Loading) -> str:
    """
    Say what is controlled.

    >>> control_in_words(Loading(control="load"))
    'load, so that the energy of the jump-out, which has no bound, is left out'
    """
    return {
        "displacement": "displacement",
        "load": "load, so that the energy of the jump-out, which has no bound, is left out",
        "machine": "displacement through a machine of finite stiffness",
    }[loading.control]


def toughness_in_words(toughness: Toughness) -> str:
    """
    Write how the toughness varies with the radius as a formula.

    >>> from gradhesion.core.problem.toughness import ToughnessHarmonic
    >>> toughness_in_words(Toughness((ToughnessHarmonic(n=1, cos=0.5), ToughnessHarmonic(n=2, sin=-0.1))))
    'K_c times 1 + t [0.5 cos(2 pi y) - 0.1 sin(4 pi y)], y = r/lambda_t'
    """
    waves = ((one.n, size, wave) for one in toughness.harmonics for size, wave in ((one.cos, "cos"), (one.sin, "sin")))
    written = _series([(size, f"{wave}({2 * n} pi y)") for n, size, wave in waves if size != 0.0])
    what = {"toughness": "K_c", "work": "w"}[toughness.of]
    return f"{what} times 1 + t [{written}], y = r/lambda_t" if written else f"{what} times 1"


def rate_in_words(rate: Rate) -> str:
    """
    Write how the work of adhesion grows with the speed of the edge.

    >>> rate_in_words(Rate(exponent=0.6))
    'G = w_o [1 + (v/v*)^0.6] while the edge opens, G = w_c while it closes'
    """
    power = f"(v/v*)^{rate.exponent:.15g}"
    closing = f"G = w_c/[1 + {power}]" if rate.closing == "same" else "G = w_c"
    return f"G = w_o [1 + {power}] while the edge opens, {closing} while it closes"


def _terms(harmonic: Harmonic) -> list[tuple[float, str]]:
    """List the waves of a harmonic that are there, with their sizes."""
    angle = f"{2 * harmonic.n} pi x"
    waves = ((harmonic.cos, f"1 - cos({angle})"), (harmonic.sin, f"sin({angle})"))
    return [(size, wave) for size, wave in waves if size != 0.0]


def _series(terms: list[tuple[float, str]]) -> str:
    """Write waves with their sizes as a sum."""
    written = "".join((" - " if size < 0.0 else " + ") + _term(size, wave, len(terms)) for size, wave in terms)
    return ("-" if written.startswith(" -") else "") + written[3:]


def _term(size: float, wave: str, terms: int) -> str:
    """Write one of so many waves with its size, its sign apart."""
    factor = "" if abs(size) == 1.0 else f"{abs(size):.15g} "
    return factor + (f"({wave})" if wave.startswith("1") and not (terms == 1 and size == 1.0) else wave)
