"""Words that messages share: suggestions, values as TOML writes them, and lines that would do."""

import difflib
import json
from collections.abc import Mapping, Sequence

from gradhesion.cli.names import MACHINE, OUTPUTS, PARAMETERS
from gradhesion.cli.study.places import Path


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
    """Find the known word that is most like this one, if any is."""
    lower = {name.lower(): name for name in known}
    near = difflib.get_close_matches(word.lower(), lower, n=1, cutoff=0.6)
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
    """Write a line that would do."""
    examples: dict[str, str] = {
        "title": 'title = "Pull-off force against wavelength"',
        "kind": 'kind = "map"',
        "layout": 'layout = "grid"',
        "outputs": f"outputs = {json.dumps(list(OUTPUTS)[::2][:2])}",
        "parameters": "a table [parameters] with " + ", ".join(PARAMETERS),
        "method": 'a table [method] with solver = "exact", "asymptotic" or "envelope"',
        "solver": 'solver = "exact" or solver = ["exact", "envelope"]',
        "check_contact": "check_contact = false",
        "k": "k = 0.5 or k = [0.0, 0.5]",
        "nu": "nu = 0.3",
        "modulus": "modulus = 500.0",
        "c0_over_R": "c0_over_R = 0.01",
        "lambda_over_R": 'lambda_over_R = { start = 0.02, stop = 1.0, num = 200, spacing = "log" }',
        "A": "A = 0.1",
        "a_max_over_R": "a_max_over_R = inf",
        "lambda_over_L": "lambda_over_L = 0.5",
        "chi": "chi = 0.5",
        "a_max_over_L": "a_max_over_L = 5.0",
        "a_max_over_a2": "a_max_over_a2 = 2.0",
        "physical": 'a table [physical] with R = "1 mm" and other quantities',
        "R": 'R = "1 mm"',
        "E_star": 'E_star = "50 kPa"',
        "work_of_adhesion": 'work_of_adhesion = "20 mJ/m^2"',
        "c0": 'c0 = "0.1 mm"',
        "wavelength": 'wavelength = "20 um"',
        "amplitude": 'amplitude = "0.5 um"',
        "spring_constant": 'spring_constant = "0.2 N/m"',
        "a_max": 'a_max = "0.5 mm" or a_max = inf',
        "profile": "a table [profile] with exponent or harmonics",
        "exponent": "exponent = 2.0",
        "harmonics": "harmonics = [{ n = 1, cos = 1.0 }, { n = 2, sin = 0.3 }]",
        "n": "n = 1",
        "cos": "cos = 1.0",
        "sin": "sin = 0.3",
        "loading": 'a table [loading] with control = "displacement", "load" or "machine"',
        "control": 'control = "load"',
        MACHINE: f"{MACHINE} = 10.0",
        "start": "start = 0.1",
        "stop": "stop = 1.0",
        "num": "num = 50",
    }
    named = [step for step in path if isinstance(step, str)]
    if path[0] == "physical" and named[-1] in ("start", "stop"):
        return examples[named[1]].replace(named[1], named[-1], 1)
    return examples[named[-1]]
