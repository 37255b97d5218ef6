"""Names as a page writes them: in Unicode, since a page with formulae would need a megabyte and a half more."""

import re
from typing import Final

from gradhesion.cli.dataset.read.sensitivities import part_of
from gradhesion.cli.names.outputs import SI, SPREADS, value_of
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.core.problem.inputs import INPUTS

_TEX: Final = (
    (r"\ln$ ", "ln "),
    (r"/d$ ", "/d"),
    (r"\ln", "ln"),
    (r"\frac{3}{2}\pi R\Delta\gamma", "1.5 πRΔγ"),
    (r"\Delta\gamma", "Δγ"),
    (r"\lambda", "λ"),
    (r"\delta", "δ"),
    (r"\nu", "ν"),
    (r"\chi", "χ"),
    (r"^{\ast}", "*"),
    ("^*", "*"),
    (r"_{\max}", "ₘₐₓ"),
    ("_0", "₀"),
    ("_2", "₂"),
    ("^2", "²"),
    (r"\,", " "),
    ("$", ""),
)
_SPREADS: Final = {
    "std": "standard deviation",
    "mean": "mean",
    "p05": "5 % quantile",
    "p50": "median",
    "p95": "95 % quantile",
    "std_linear": "linear standard deviation",
}
"""What the end of the name of a spread stands for."""
_WORDS: Final = {
    "lambda": "λ",
    "dgamma": "Δγ",
    "delta": "δ",
    "chi": "χ",
    "pi": "π",
    "E0": "E₀",
    "c0": "c₀",
    "a_2": "a₂",
    "a_max": "aₘₐₓ",
}


def symbol(name: str) -> str:
    """
    Name a variable at an axis.

    >>> symbol("a_max_over_R"), symbol("dissipated_energy"), symbol("load")
    ('aₘₐₓ/R', 'dissipated energy H/(R²Δγ)', 'load')
    """
    return plain(SYMBOLS.get(name, name.replace("_", " ")))


def plain(text: str) -> str:
    r"""
    Write what a picture writes in TeX in Unicode.

    >>> plain(r"load $P\,/\,\frac{3}{2}\pi R\Delta\gamma$"), plain("depth $a$ (nm)")
    ('load P/1.5 πRΔγ', 'depth a (nm)')
    """
    for tex, letters in _TEX:
        text = text.replace(tex, letters)
    return re.sub(r"  +", " ", text).replace(" / ", "/")


def title(name: str, long_name: str) -> str:
    """
    Name a variable with its letter first, so that a list that is cut short still shows it.

    >>> title("lambda_over_R", "wavelength lambda/R of the waviness"), title("nu", "Poisson's ratio")
    ('λ/R – wavelength of the waviness', "ν – Poisson's ratio")
    >>> title("pull_off_force", "pull-off force F/(1.5 pi R dgamma)"), title("loading_jumps", "number of jumps")
    ('F/(1.5 πRΔγ) – pull-off force', 'number of jumps')
    >>> title("pull_off_force_sensitivity_A", "sensitivity of the pull-off force F to each parameter p")
    'd ln F/d ln A – sensitivity of the pull-off force'
    >>> title("pull_off_force_p05_si", "5 % quantile of the pull-off force F, of samples")
    'F, 5 % quantile – pull-off force'
    """
    if part_of(name):
        return f"{symbol(name)} – {re.sub(' [FH]( to each .*)?$', '', words(long_name))}"
    written = words(long_name)
    whole = SYMBOLS.get(name, "")
    letter = plain("".join(re.findall(r"\$[^$]*\$", whole))).strip()
    if not letter or letter.startswith("/"):
        return written
    own = re.sub("^(linear std|std|mean) of ", "", plain(whole.partition("$")[0]).strip())
    rest = own or re.sub(r" \(inf: [^)]*\)$", "", written)
    spread = name.removesuffix(SI).removeprefix(f"{value_of(name)}_") if name.removesuffix(SI) in SPREADS else ""
    letter += f", {_SPREADS[spread]}" if spread else ""
    rest = re.sub(rf" {re.escape(letter)}(?=,| (?!=)|$)", "", rest, count=1)
    return f"{letter} – {rest}"


def words(long_name: str) -> str:
    """
    Write a `long_name` with the letters of the field.

    >>> words("pull-off force F/(1.5 pi R dgamma)"), words("reduced modulus E* = E0/(1 - nu^2)")
    ('pull-off force F/(1.5 π R Δγ)', 'reduced modulus E* = E₀/(1 − ν²)')
    """
    text = re.sub(r"[A-Za-z_0-9]+", lambda found: _WORDS.get(found[0], found[0]), long_name)
    return re.sub(r"\bnu\^2", "ν²", text).replace("^2", "²").replace(")^k", ")ᵏ").replace(" - ", " − ")


def in_order(names: list[str]) -> list[str]:
    """Put parameters into the order of a dataset."""
    return [name for name in INPUTS if name in names]
