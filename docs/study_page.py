"""The page of every key of a study, from the model that validation goes by."""

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

from docs.tables import code, table
from gradhesion.cli.names.outputs import OUTPUTS
from gradhesion.cli.study.rules.fit_form import OffsetsTable
from gradhesion.cli.study.rules.form import Form
from gradhesion.cli.study.text.quantities import WORDS
from gradhesion.core import SOLVERS
from gradhesion.core.problem.inputs import INPUTS, PHYSICAL, REDUCED

TYPES: Final = {"string": "string", "number": "number", "integer": "integer", "boolean": "true or false"}

HEADS: Final = ("key", "type", "allowed", "default", "meaning")


def page() -> str:
    """Write the page."""
    return "\n\n".join(_sections())


def _sections() -> Iterator[str]:
    """Write the sections."""
    schema = Form.model_json_schema()
    tables = {name: _target(entry, schema) for name, entry in schema["properties"].items()}
    yield "# Keys of a study file (TOML)"
    yield (
        "This page is generated from the model that `gradhesion validate` uses. `gradhesion schema` prints it as JSON "
        "Schema, for editors."
    )
    yield "## At the top"
    yield table(HEADS, (_row(name, schema) for name, own in tables.items() if own is None))
    yield (
        "Outputs of a map are listed under [variables of a map](dataset.md#variables-of-a-map), those of a curve study "
        "under [variables of curves](dataset.md#variables-of-curves)."
    )
    yield from _of_parameters(tables["parameters"], schema["$defs"]["File"])
    yield from _of_quantities()
    yield from _of_table("profile", tables["profile"])
    yield "The formula is under [other punches and machines](../punches.md). Each item of `harmonics`:"
    yield table(HEADS, _rows(schema["$defs"]["Harmonic"]))
    yield "The table `spectrum` ([random roughness](../punches.md#random-roughness)):"
    yield table(HEADS, _rows(schema["$defs"]["Spectrum"]))
    yield from _of_table("loading", tables["loading"])
    yield from _of_table("toughness", tables["toughness"])
    yield (
        "The series multiplies the toughness or the work of both closing and opening "
        "([a moving edge](../moving_edge.md#a-pattern-of-toughness)). Each item of `harmonics`:"
    )
    yield table(HEADS, _rows(schema["$defs"]["ToughnessHarmonic"]))
    yield from _of_table("rate", tables["rate"])
    yield "[A moving edge](../moving_edge.md#a-speed) describes it."
    yield from _of_table("states", tables["states"])
    yield from _of_optimum(tables["optimum"], schema["$defs"]["Require"])
    yield from _of_uncertainty(tables["uncertainty"])
    yield from _of_table("method", tables["method"])
    yield from _of_fits()
    yield "## Axes"
    yield (
        "A number is fixed. A list of numbers is an axis, and so is a range: a table with the keys below. A range has "
        "finite ends; a list may contain `inf`. An axis must not repeat a value."
    )
    yield table(HEADS, _rows(schema["$defs"]["Range_k"], bounds=False))


def _of_fits() -> Iterator[str]:
    """Write the tables of studies of kind "fit"."""
    own = Form.model_json_schema()["$defs"]
    yield '## Studies of `kind = "fit"`'
    yield (
        "[Fit a loop](../fit.md) describes them. Besides `title`, `kind` and `profile` they have the tables "
        "below, and no `outputs`, `layout`, `states` or `method`. In `[parameters]` and "
        "`[physical]` a number is fixed; a parameter with a range `{ start, stop }` is fitted within it. Ranges "
        'are above 0, except for `k` and `nu`. `indentation_max` may be `"data"`, the default: the cycle turns '
        "where the data turn. Reduced variables are as above, except `machine_stiffness`. Lists are not allowed, "
        "because a fit has no axes."
    )
    yield "### [data]"
    yield f"Required: {Form.model_fields['data'].description}."
    yield table(HEADS, _rows(own["DataTable"]))
    yield "A column as a table, instead of its name only:"
    yield table(HEADS, _rows(own["ColumnTable"]))
    yield "### [fit]"
    yield f"Optional: {Form.model_fields['fit'].description}."
    yield table(HEADS, _rows(own["FitTable"]))
    yield "The table `offsets`, in place of `true` or `false`:"
    yield table(HEADS, _rows(OffsetsTable.model_json_schema()))
    yield "The table `noise`, with the depth or the displacement, as the data have it:"
    yield table(HEADS, _rows(own["Noise"]))


def _target(entry: Mapping[str, Any], schema: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """Find what a key of the top stands for if it is a table, one that may be left out among them."""
    form = next((one for one in entry.get("anyOf", ()) if "$ref" in one), entry)
    name = str(form.get("$ref", "")).rpartition("/")[2]
    return schema["$defs"][name] if name else None


def _of_parameters(own: Mapping[str, Any] | None, files: Mapping[str, Any]) -> Iterator[str]:
    """Write the table [parameters]."""
    assert own
    yield "## [parameters]"
    yield f"Required: {Form.model_fields['parameters'].description}."
    rows = [_row(name, own) for name in own["properties"] if name not in REDUCED]
    yield table(HEADS, rows)
    yield "`points` as a table, instead of the name of the file ([more](../scenes.md#points-from-a-table)):"
    yield table(HEADS, _rows(files))
    yield "Reduced variables, each instead of another parameter:"
    yield table(
        ("key", "instead of", "allowed", "meaning"),
        ([code(name), code(key.gives), code(key.allowed), key.about] for name, key in REDUCED.items()),
    )


def _of_quantities() -> Iterator[str]:
    """Write the table [physical]."""
    yield "## [physical]"
    yield (
        f"{_opens('physical')}. Each is a string with a number and a unit, a list of them, or a "
        "range from one to another. With this table, `R`, `E_star` (or `E`) and `work_of_adhesion` are "
        "required, and `modulus`, `c0_over_R`, `lambda_over_R` and `a_max_over_R` are not allowed under `[parameters]`."
    )
    yield table(
        ("key", "quantity", "unit in the dataset", "allowed", "for example", "meaning"),
        (
            [code(name), WORDS[key.unit], code(key.unit), code(key.allowed), code(key.example), key.about]
            for name, key in PHYSICAL.items()
        ),
    )


def _opens(name: str) -> str:
    """Say what a table is about that may be left out."""
    return f"Optional: {Form.model_fields[name].description}"


def _of_table(name: str, own: Mapping[str, Any] | None) -> Iterator[str]:
    """Write one of the other tables."""
    assert own
    yield f"## [{name}]"
    yield f"{_opens(name)}."
    yield table(HEADS, _rows(own))


def _of_optimum(own: Mapping[str, Any] | None, requirements: Mapping[str, Any]) -> Iterator[str]:
    """Write the table of what is sought."""
    assert own
    yield "## [optimum]"
    yield (
        'Required for `kind = "optimum"`: goal, searched inputs and requirements ([optima](../optima.md#optima)). '
        "Such a study has no `outputs`. It has one goal or two: any output with one value per scene except counts, in "
        "SI units with the suffix `_si`."
    )
    yield table(HEADS, _rows(own))
    yield "The table `require`:"
    yield table(HEADS, _rows(requirements))


def _of_uncertainty(own: Mapping[str, Any] | None) -> Iterator[str]:
    """Write the table of uncertain inputs."""
    assert own
    yield "## [uncertainty]"
    yield f"{_opens('uncertainty')} ([uncertain inputs](../optima.md#uncertain-inputs))."
    yield (
        "Any key of `[parameters]`, `[physical]` or `[loading]` that the study gives: a percentage of the value of "
        'each scene (`modulus = "5 %"`), a standard deviation in the unit of the key (`A = 0.002`, `c0 = "1 nm"`), or '
        "a uniform distribution (`nu = { low = 0.28, high = 0.32 }`). Normal distributions are truncated at the bounds "
        "of the key. Besides:"
    )
    yield table(HEADS, _rows({"properties": {name: own["properties"][name] for name in ("samples", "seed")}}))
    yield "A uniform distribution:"
    allowed = "that of the key"
    yield table(
        HEADS,
        (
            [code(name), "number or string", allowed, "required", f"{end} end of a uniform distribution"]
            for name, end in (("low", "lower"), ("high", "upper"))
        ),
    )


def _rows(own: Mapping[str, Any], *, bounds: bool = True) -> Iterator[list[str]]:
    """Write the rows of all keys of a table, without the bounds of numbers where these are those of another key."""
    for name in own["properties"]:
        row = _row(name, own)
        if not bounds and name in ("start", "stop"):
            row[2] = "as the key"
        yield row


def _row(name: str, own: Mapping[str, Any]) -> list[str]:
    """Write the row of a key."""
    entry = own["properties"][name]
    default = "required" if name in own.get("required", ()) else _default(name, entry)
    return [code(name), _type(entry), _allowed(name, entry), default, entry["description"]]


def _default(name: str, entry: Mapping[str, Any]) -> str:
    """Report what holds where a key is left out."""
    if name in INPUTS and INPUTS[name].is_parameter and not INPUTS[name].group and name not in ("k", "nu"):
        tied = [code(key.name) for key in REDUCED.values() if key.gives == name]
        united = [code(key.name) for key in PHYSICAL.values() if key.gives == name and not key.instead_of]
        given = ", ".join(["this", *tied]) + f" or {' and '.join(united)} under `[physical]`"
        if name == "a_max_over_R":
            return f"`inf`; {given}"
        zero = INPUTS[name].idle_without
        return f"{given}; none where `{zero} = 0` everywhere" if zero else given
    default = entry.get("default")
    return "" if default in (None, "", []) or isinstance(default, dict) else code(json.dumps(default))


def _type(entry: Mapping[str, Any]) -> str:
    """Report the forms that a value takes."""
    if isinstance(entry.get("type"), str) and "anyOf" in entry:
        return TYPES[entry["type"]]
    forms = [form for form in entry.get("oneOf", entry.get("anyOf", [entry])) if form.get("type") != "null"]
    forms = [inner for form in forms for inner in form.get("oneOf", [form])]
    if any("Range_" in str(form.get("$ref")) for form in forms):
        return "number, list or range"
    names = {"array": "list", "": "table", "object": "table"} | TYPES
    return " or ".join(names[form.get("type", "")] for form in forms)


def _enum(entry: Mapping[str, Any]) -> Iterable[str]:
    """List the words that a key takes, if it takes some alone."""
    forms = [entry, *entry.get("anyOf", ())]
    return next((form["enum"] for form in forms if "enum" in form), ())


def _allowed(name: str, entry: Mapping[str, Any]) -> str:
    """Report which values are allowed."""
    if name in INPUTS:
        return code(INPUTS[name].allowed)
    words = SOLVERS if name == "solver" else _enum(entry)
    if words:
        return ", ".join(code(json.dumps(word)) for word in words)
    if name == "outputs":
        return f"{len(OUTPUTS)} names of a map, or curves"
    least, most = entry.get("minimum"), entry.get("maximum")
    items = [form["maxItems"] for form in (entry, *entry.get("anyOf", ())) if "maxItems" in form]
    if items:
        return f"1 to {items[0]} waves" if name == "harmonics" else f"1 to {items[0]} values > 0"
    if least is None:
        return ""
    return f"{least:,} or more" if most is None or most >= 2**62 else f"{least:,} to {most:,}"
