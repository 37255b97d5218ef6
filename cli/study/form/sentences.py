"""What is wrong with the value of a key, in sentences that say what to write instead."""

import math
from typing import Final

from pydantic_core import ErrorDetails

from gradhesion.cli.keys import INPUTS, Path
from gradhesion.cli.study.form.edge import FASTEST, SLOWEST
from gradhesion.cli.study.form.form import MOST_STATES
from gradhesion.cli.study.form.optimum import MOST_RESOLUTION
from gradhesion.cli.study.form.profile import MOST_REALISATIONS, MOST_WAVES
from gradhesion.cli.study.text.quantities import ratio_sentence
from gradhesion.cli.terminal.wording import did_you_mean, example
from gradhesion.core.problem.profile import MOST_HARMONICS

_OF_INPUTS: Final = ("parameters", "physical", "loading")
"""The tables whose keys are inputs."""


def sentence_of(detail: ErrorDetails, path: Path) -> str:
    """Say what pydantic found in the words of a study."""
    kind = detail["type"]
    value = detail["input"]
    last = path[-1]
    if kind == "value_error":  # of a quantity, in a sentence already
        return str(detail["ctx"]["error"])
    if path[0] == "profile" and len(path) > 1:
        return _profile_sentence(kind, path)
    if path[0] in ("toughness", "rate") and len(path) > 1:
        return _edge_sentence(kind, path)
    if path[0] == "optimum" and len(path) > 1:
        return _optimum_sentence(kind, path)
    if path[0] == "states" and len(path) > 1 and kind != "too_short":
        return _states_sentence(kind, path)
    if path == ("uncertainty", "seed"):
        return f"the seed is an integer of 0 or more; {example(path)}"
    if path[:2] == ("parameters", "points"):
        return _file_sentence(kind, path)
    if (
        path[:2] != ("loading", "control")
        and path[0] in _OF_INPUTS
        and len(path) > 1
        and last not in ("num", "spacing")
    ):
        return _parameter_sentence(kind, value, path)
    if path[:2] == ("states", "contact_radius_over_R") and len(path) > 2:
        return f"a contact radius is a number above 0, over R and without a unit; {example(path)}"
    if kind == "missing":
        return f"this key is required; {example(path)}"
    if kind == "too_short":
        return f"the list is empty; {example(path)}"
    if last == "solver":
        return f"this must be a string in quotes or a list of them; {example(path)}"
    if last == "check_contact":
        return f"this must be true or false; {example(path)}"
    if last == "num":
        return "num is the number of values, an integer of 1 or more; write for example num = 50"
    if last == "spacing":
        return 'spacing is "linear" or "log"; ' + did_you_mean(str(value), ("linear", "log"))
    wanted = {"string_type": "a string in quotes", "list_type": "a list in brackets"}.get(kind, "a table")
    return f"this must be {wanted}; {example(path)}"


def _parameter_sentence(kind: str, value: object, path: Path) -> str:
    """Say what is wrong with a parameter, an item of its list or an end of its range."""
    name, last = str(path[1]), path[-1]
    if kind == "missing":
        if len(path) > 2:
            return f"a range needs this key; {example(path)}"
        return f"this parameter is required; {example(path)}"
    if kind == "too_short":
        return "an axis needs at least one value; put values into the list, or write a single number to fix it"
    allowed = INPUTS[name].allowed
    if isinstance(value, str) and (sentence := ratio_sentence(value, name)):
        return sentence
    if kind == "float_type" and not (isinstance(value, int) and not isinstance(value, bool)):
        forms = "" if len(path) > 2 else ", a list of numbers or a range table"
        return f"this must be a number{forms}, with {allowed}; {example(path[:2])}"
    if last in ("start", "stop") and isinstance(value, float) and math.isinf(value):
        return "a range must end at finite values; write a list where inf is one of the values"
    unpressed = "; for a turn at zero depth write indentation_max_over_R = 0.0" if name == "load_max" else ""
    return f"out of range; choose a value with {allowed}{unpressed}"


def _file_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with the name of a file, or its fingerprint."""
    if path[-1] == "sha256":
        return "a sha256 has 64 digits from 0 to f; write that of the file, or leave it out"
    if kind == "missing":
        return f"the name of the file is required; {example(path)}"
    return f"this must be the name of a file in quotes; {example(path)}"


def _spectrum_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with random roughness."""
    last = str(path[-1])
    allowed = {
        "hurst": "the Hurst exponent is a number from 0 to 1",
        "first": f"the longest wave is an integer from 1 to {MOST_WAVES:,}",
        "last": f"the shortest wave is an integer from 1 to {MOST_WAVES:,}",
        "realisations": f"the number of profiles is an integer from 1 to {MOST_REALISATIONS:,}",
        "seed": "the seed is an integer of 0 or more",
    }
    if kind == "missing":
        return f"a spectrum needs this key; {example(path)}"
    return f"{allowed.get(last, 'this must be a table')}; {example(path)}"


def _optimum_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with what is sought."""
    if path[-1] in ("minimum", "maximum") or (len(path) > 3 and path[2] in ("minimum", "maximum")):
        return f"this must be a table of outputs with finite numbers; {example(path[:3])}"
    allowed = {
        "maximise": "this must be the name of an output in quotes, or a list of two",
        "minimise": "this must be the name of an output in quotes, or a list of two",
        "over": "this must be a list of inputs",
        "resolution": f"the resolution is an integer from 3 to {MOST_RESOLUTION:,}",
        "one_disc": "this must be true or false",
    }
    word = str(path[2]) if path[1] == "require" and len(path) > 2 else str(path[1])
    required = "this key is required" if kind == "missing" else allowed.get(word, "this must be a table")
    return f"{required}; {example((*path[:1], word))}"


def _edge_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with a pattern of toughness, or with the law of a moving edge."""
    last = path[-1]
    if path == ("rate", "exponent"):
        missing = "this key is required" if kind == "missing" else "the power n of the speed is a number"
        return f"{missing}, from {SLOWEST:g} to {FASTEST:g}; write for example exponent = 0.6"
    if last == "n" and kind == "missing":
        return "a wave needs its number n; write for example { n = 1, cos = 0.2 }"
    if last in ("of", "closing"):
        return f"this must be a string in quotes; {example(path)}"
    if path[1] == "harmonics" and len(path) < 4:
        if kind == "too_long":
            return f"a series has {MOST_HARMONICS} terms at most; leave the smallest out"
        required = "this key is required: a" if kind == "missing" else "this must be a"
        return f"{required} list of tables, one for each wave; write for example harmonics = [{{ n = 1, cos = 0.2 }}]"
    return _profile_sentence(kind, path)


def _states_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with the states whose pressure and surface are drawn."""
    if len(path) > 2:
        return f"a contact radius a/R is a number above 0, and finite; {example(path)}"
    if kind == "too_long":
        return f"a study draws {MOST_STATES:,} states at most; leave some out"
    return f"this must be a list of numbers in brackets; {example(path)}"


def _profile_sentence(kind: str, path: Path) -> str:
    """Say what is wrong with the shape of the punch."""
    last = path[-1]
    if last in ("file", "sha256"):
        return _file_sentence(kind, path)
    if path[1] == "spectrum":
        return _spectrum_sentence(kind, path)
    if last == "terms":
        return f"terms is the number of harmonics, an integer from 1 to {MOST_HARMONICS}; {example(path)}"
    if last == "exponent":
        return f"the power of the punch is a number of 1 or more, and finite (1 is a cone); {example(path)}"
    if last == "n":
        return f"n is the number of waves per wavelength, an integer from 1 to {MOST_WAVES:,}; {example(path)}"
    if last in ("cos", "sin"):
        return f"this must be a number, and finite; {example(path)}"
    if kind == "too_long":
        return f"a series has {MOST_HARMONICS} terms at most; leave the smallest out"
    return f"this must be a list of tables, one for each wave; {example(path)}"
