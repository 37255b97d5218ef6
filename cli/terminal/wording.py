"""Words that messages share: suggestions, and values as TOML writes them."""

import difflib
import json
from collections.abc import Mapping, Sequence
from typing import Final

from gradhesion.core.problem.inputs import INPUTS

SLIP: Final = 0.8
"""How like each other two words are, from 0 to 1, of which one is the other with a letter or two wrong."""
CALLED: Final[Mapping[str, tuple[str, ...]]] = {
    **{name: one.called for name, one in INPUTS.items()},
    "num": ("count", "n", "number", "points", "n_points", "steps", "size"),
    "spacing": ("scale", "space"),
    "start": ("from", "min", "low", "begin", "first"),
    "stop": ("to", "max", "high", "end", "last"),
}
"""What else keys are called, in small letters."""


def did_you_mean(word: str, known: Sequence[str]) -> str:
    """Suggest the nearest of the known words, or list them all.

    >>> did_you_mean("pull_of_force", ["pull_off_force", "delta_max"])
    'did you mean "pull_off_force"?'
    >>> did_you_mean("speed", ["pull_off_force", "delta_max"])
    'choose from "pull_off_force", "delta_max"'
    """
    near = nearest(word, known)
    return f'did you mean "{near}"?' if near else "choose from " + ", ".join(f'"{name}"' for name in known)


def nearest(word: str, known: Sequence[str]) -> str | None:
    """Find the known word that is most like this one, if any is: a slip of the pen, or the first with this part.

    >>> known = ["dissipated_energy", "energy_gain"]
    >>> nearest("energy", known), nearest("energy_gian", known)
    ('dissipated_energy', 'energy_gain')
    >>> nearest("gamma", ["a_max", "work_of_adhesion"])
    'work_of_adhesion'
    >>> nearest("cosine", ["sin", "cos"]), nearest("speed_over_referense", ["speed", "speed_over_reference"])
    ('cos', 'speed_over_reference')
    """
    if word in known:
        return word
    lower = {name.lower(): name for name in known}
    called = {other: name for name, others in CALLED.items() if name in known for other in others if other not in lower}
    for name in difflib.get_close_matches(word.lower(), [*called, *lower], n=1, cutoff=SLIP):
        return (called | lower)[name]
    parts = [name for name in lower if f"_{word.lower()}_" in f"_{name}_"] if word else []
    begun = sorted((name for name in lower if len(name) > 2 and word.lower().startswith(name)), key=len, reverse=True)
    near = [*parts, *begun, *difflib.get_close_matches(word.lower(), lower, n=1, cutoff=0.6)]
    return lower[near[0]] if near else None


def shown(value: object) -> str:
    """Write a value as TOML would, cut short where it is long.

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
