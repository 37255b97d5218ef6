"""Words that messages share: suggestions, values as TOML writes them, and lines that would do."""

import difflib
import json
from collections.abc import Mapping, Sequence
from typing import Final

from gradhesion.cli.keys import KEYS, Path

SLIP: Final = 0.8
"""How like each other two words are, from 0 to 1, of which one is the other with a letter or two wrong."""

MEANT: Final[Mapping[str, tuple[str, ...]]] = {
    "work_of_adhesion": (
        "gamma", "dgamma", "delta_gamma", "deltagamma", "w", "w_adh", "adhesion", "adhesion_energy", "surface_energy",
    ),
    "nu": ("poisson", "poisson_ratio", "poissons_ratio", "v"),
    "E_star": ("e*", "estar", "e_eff", "reduced_modulus", "effective_modulus", "plane_strain_modulus"),
    "E": ("young", "youngs_modulus", "young_modulus", "elastic_modulus", "e0"),
    "R": ("radius", "tip_radius", "curvature_radius", "r0"),
    "wavelength": ("lambda", "lam", "period"),
    "lambda_over_R": ("wavelength_over_r", "lam_over_r", "lambda", "lam", "wavelength"),
    "amplitude": ("height", "wave_height"),
    "A": ("amplitude_over_wavelength", "amplitude_over_lambda", "a_over_lambda", "amplitude"),
    "k": ("exponent", "gradient", "gradient_exponent"),
    "c0": ("gradient_depth", "characteristic_depth"),
    "spring_constant": ("stiffness", "spring", "spring_stiffness", "cantilever_stiffness"),
    "machine_stiffness": ("stiffness", "machine"),
    "preload": ("load", "maximum_load", "max_load", "setpoint"),
    "indentation_max": ("depth", "indentation", "max_indentation", "max_depth"),
    "a_max": ("contact_radius", "max_radius"),
    "adhesion_range": ("z0", "range", "interaction_range"),
    "num": ("count", "n", "number", "points", "n_points", "steps", "size"),
    "spacing": ("scale", "space"),
    "start": ("from", "min", "low", "begin", "first"),
    "stop": ("to", "max", "high", "end", "last"),
}  # fmt: skip
"""What else keys are called, in small letters."""


def did_you_mean(word: str, known: Sequence[str]) -> str:
    """
    Suggest the nearest of the known words, or list them all.

    >>> did_you_mean("pull_of_force", ["pull_off_force", "delta_max"])
    'did you mean "pull_off_force"?'
    >>> did_you_mean("speed", ["pull_off_force", "delta_max"])
    'choose from "pull_off_force", "delta_max"'
    """
    near = nearest(word, known)
    return f'did you mean "{near}"?' if near else "choose from " + ", ".join(f'"{name}"' for name in known)


def nearest(word: str, known: Sequence[str]) -> str | None:
    """
    Find the known word that is most like this one, if any is: a slip of the pen, or the first with this part.

    >>> known = ["dissipated_energy", "energy_gain"]
    >>> nearest("energy", known), nearest("energy_gian", known)
    ('dissipated_energy', 'energy_gain')
    >>> nearest("gamma", ["a_max", "work_of_adhesion"])
    'work_of_adhesion'
    """
    if word in known:
        return word
    lower = {name.lower(): name for name in known}
    called = {other: name for name, others in MEANT.items() if name in known for other in others if other not in lower}
    for name in difflib.get_close_matches(word.lower(), [*called, *lower], n=1, cutoff=SLIP):
        return (called | lower)[name]
    parts = [name for name in lower if f"_{word.lower()}_" in f"_{name}_"] if word else []
    near = [*parts, *difflib.get_close_matches(word.lower(), lower, n=1, cutoff=0.6)]
    return lower[near[0]] if near else None


def shown(value: object) -> str:
    """
    Write a value as TOML would, cut short where it is long.

    >>> shown(True), shown("a"), shown([1.0, float("inf")])
    ('true', '"a"', '[1.0, inf]')
    """
    if isinstance(value, bool):
        text = str(value).lower()
    elif isinstance(value, str):
        text = json.dumps(value[:80], ensure_ascii=False)
    elif isinstance(value, list):
        text = "[" + ", ".join(shown(item) for item in value[:8]) + (", ...]" if len(value) > 8 else "]")
    elif isinstance(value, Mapping):
        text = "{ " + ", ".join(f"{key} = {shown(item)}" for key, item in list(value.items())[:8]) + " }"
    elif isinstance(value, int):
        text = str(value) if abs(value) < 10**40 else "an integer of more than 40 digits"
    else:
        text = str(value)
    return text if len(text) <= 80 else text[:76] + " ..."


def example(path: Path) -> str:
    """Show a line that would do."""
    return f"write for example {line_of(path)}"


def line_of(path: Path) -> str:
    """
    Write a line that would do.

    >>> line_of(("parameters", "k", 3)), line_of(("physical", "R", "stop"))
    ('k = 0.5 or k = [0.0, 0.5]', 'stop = "1 mm"')
    """
    named = [step for step in path if isinstance(step, str)]
    if path[0] == "physical" and named[-1] in ("start", "stop"):
        return KEYS[named[1]].example.replace(named[1], named[-1], 1)
    return KEYS[named[-1]].example
