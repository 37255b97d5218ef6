"""Names as a page writes them: in Unicode, since a page with formulae would need a megabyte and a half more."""

import re
from typing import Final

from gradhesion.cli.names.symbols import SYMBOLS

_TEX: Final = {
    r"\ln$ ": "ln ", r"/d$ ": "/d", r"\ln": "ln", r"\frac{3}{2}\pi R\Delta\gamma": "1.5 πRΔγ", r"\Delta\gamma": "Δγ",
    r"\lambda": "λ", r"\delta": "δ", r"\nu": "ν", r"\chi": "χ",
    r"\mu": "μ", r"\alpha": "α", r"^{\ast}": "*", "^*": "*", r"_{\max}": "ₘₐₓ",
    "_0": "₀", "_2": "₂", "^2": "²", r"\,": " ", "$": "",
}  # fmt: skip
_WORDS: Final = {
    "lambda": "λ", "dgamma": "Δγ", "delta": "δ", "chi": "χ", "pi": "π", "E0": "E₀", "c0": "c₀", "a_2": "a₂",
    "a_max": "aₘₐₓ",
}  # fmt: skip


def symbol(name: str) -> str:
    """Name a variable at an axis.

    >>> symbol("a_max_over_R"), symbol("dissipated_energy"), symbol("load")
    ('aₘₐₓ/R', 'dissipated energy H/(R²Δγ)', 'load')
    """
    return plain(SYMBOLS.get(name, name.replace("_", " ")))


def plain(text: str) -> str:
    r"""Write what a picture writes in TeX in Unicode.

    >>> plain(r"load $P\,/\,\frac{3}{2}\pi R\Delta\gamma$"), plain("depth $a$ (nm)")
    ('load P/1.5 πRΔγ', 'depth a (nm)')
    """
    for tex, letters in _TEX.items():
        text = text.replace(tex, letters)
    return re.sub(r"  +", " ", text).replace(" / ", "/")


def title(name: str, long_name: str) -> str:
    """Name a variable in a list that may be cut short: as a picture does, a letter alone with its meaning behind it.

    >>> title("lambda_over_R", "wavelength lambda/R of the waviness"), title("pull_off_force", "pull-off force F/...")
    ('λ/R – wavelength of the waviness', 'pull-off force F/(1.5 πRΔγ)')
    """
    whole = SYMBOLS.get(name, "")
    if not whole.startswith("$"):
        return plain(whole) or words(long_name)
    meaning = re.sub(r" \(inf: [^)]*\)$", "", words(long_name))
    return f"{plain(whole)} – {meaning.replace(f' {plain(whole)} ', ' ', 1)}"


def words(long_name: str) -> str:
    """Write a `long_name` with the letters of the field.

    >>> words("pull-off force F/(1.5 pi R dgamma)"), words("reduced modulus E* = E0/(1 - nu^2)")
    ('pull-off force F/(1.5 π R Δγ)', 'reduced modulus E* = E₀/(1 − ν²)')
    """
    text = re.sub(r"[A-Za-z_0-9]+", lambda found: _WORDS.get(found[0], found[0]), long_name)
    return re.sub(r"\bnu\^2", "ν²", text).replace("^2", "²").replace(")^k", ")ᵏ").replace(" - ", " − ")
