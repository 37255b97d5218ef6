"""The data of a page: axes, parameters, variables and flags as its script reads them."""

import re
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
import xarray
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from gradhesion.cli.dataset.read.model_range import DOUBTS, doubts_of
from gradhesion.cli.dataset.read.sensitivities import PLAIN, part_of
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.names.curves import INTEGERS, curve_of
from gradhesion.cli.names.scenes import SCENE, SOLVER, SOLVERS
from gradhesion.cli.names.symbols import SYMBOLS
from gradhesion.cli.picture.curves import PLANES, wants_si
from gradhesion.cli.picture.labels import Unit, label, scale, unit_for
from gradhesion.cli.picture.looks import Looks
from gradhesion.cli.picture.tracks import JUMP, QUANTITIES, THIN, Dash, Plane, Track, faded, tracks_in
from gradhesion.core import FAILED
from gradhesion.core.answers.flags import FLAG_WORDS, FLAGS
from gradhesion.core.problem.inputs import INPUTS

DIGITS: Final = 6
"""Significant digits of a value: as many as single precision keeps of any decimal number."""
FEW: Final = 8
"""Values of an axis that are ticks of it; of more, round numbers are."""
WIDTH: Final = 1.5
"""Pixels for a point of a picture, in the width of a line: lines are seen from farther away."""
UNLOADING: Final = [9, 6]
"""The dash of unloading, in pixels: what is below it, loading on the same curve, shows in its gaps."""
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
Entry = dict[str, Any]


def rounded(values: NDArray[Any]) -> NDArray[np.floating[Any]]:
    """Round values to 6 digits, in single precision where its range holds them: written to 6 digits they are exact.

    >>> rounded(np.array([0.12345649, 1234565.1]))
    array([1.23456e-01, 1.23457e+06], dtype=float32)
    """
    exact = np.where(np.isfinite(values), np.asarray(values, dtype=float), np.nan)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        places = DIGITS - 1 - np.floor(np.log10(np.abs(exact)))
        # a power of ten up to 10^22 is exact: values of common sizes meet one rounding by it and one after it
        near = np.rint(exact * 10.0 ** np.maximum(places, 0) / 10.0 ** np.maximum(-places, 0))
        near = near * 10.0 ** np.maximum(-places, 0) / 10.0 ** np.maximum(places, 0)
    near = np.where((np.abs(places) < 300) & np.isfinite(near), near, exact)  # 0, and what has no such power of ten
    sizes = np.abs(near[np.isfinite(near) & (near != 0.0)])
    range_of = np.finfo(np.float32)
    fits = not sizes.size or (sizes.min() >= range_of.tiny and sizes.max() <= range_of.max)
    return near.astype(np.float32) if fits else near


def study_data(dataset: xarray.Dataset, units: Mapping[str, Unit] | None = None) -> tuple[Entry, list[Entry]]:
    """Make the data of a page from a dataset that is cut down to what it shall show; `units` are those of variables.

    Returns
    -------
    What distinguishes scenes: `axes`, `parameters` (fixed, or following from axes), `status`, `flags`; and a list of
    what has values, each flat in the order of the scenes, a row of `length` values for each of a curve.
    """
    dims = [str(axis) for axis in dataset["status"].dims]
    numeric = [axis for axis in dims if axis in dataset.coords and dataset[axis].dtype.kind in "fiu"]
    dataset = dataset.isel({axis: np.argsort(dataset[axis].values, kind="stable") for axis in numeric})
    axes = [axis for axis in dims if dataset.sizes[axis] > 1]
    dataset = dataset.isel({axis: 0 for axis in dims if axis not in axes})
    variables = [_variable(dataset, str(name), units or {}) for name in dataset.data_vars if name != "status"]
    if not any(np.isfinite(variable["values"]).any() for variable in variables):
        listed = ", ".join(variable["name"] for variable in variables)
        raise DatasetError(f"{listed}: no value in any scene; `gradhesion info` reports why")
    status = dataset["status"].values.astype(np.uint16).ravel()
    known = [name for name in (SOLVER, *INPUTS) if name in dataset.coords and name not in axes]
    study = {
        "axes": [_axis(dataset, axis) for axis in axes],
        "parameters": [_parameter(dataset, name, axes) for name in known],
        "status": status,
        "flags": [
            {"bit": bit, "words": FLAG_WORDS[name], "doubtful": bool(bit & DOUBTS), "failed": bool(bit & FAILED)}
            for name, bit in FLAGS.items()
        ],
        "found": int(np.bitwise_or.reduce(status, initial=0)),
    }
    return study, variables


def _axis(dataset: xarray.Dataset, name: str) -> Entry:
    """Describe an axis: its values, and where they stand along a picture."""
    if name in dataset.coords and dataset[name].dtype.kind in "fiu":
        named, values = _named(dataset, name)
        values = np.asarray(values, dtype=float)  # realisations are whole numbers
        return named | {"values": values} | _placed(values)
    size = dataset.sizes[name]
    values = np.arange(1, size + 1) if name == SCENE else dataset[name].values
    places = _placed(np.arange(size, dtype=float)) | {"listed": True, "log": False}
    return _words(name, "number of the scene" if name == SCENE else SOLVERS, [*map(str, values)]) | places


def _words(name: str, title: str, values: list[str]) -> Entry:
    """Describe what has words for values."""
    return {"name": name, "symbol": name, "title": title, "unit": "", "values": values}


def _placed(values: NDArray[np.float64]) -> Entry:
    """Place rising numbers along a picture, at their logarithms if it has that scale; inf stands one step beyond.

    >>> _placed(np.array([1.0, 2.0, np.inf]))["places"]
    array([1., 2., 3.])
    """
    own = scale(values)
    places = np.log10(own.positions) if own.log else own.positions
    unique = np.unique(places)
    return {
        "places": places,
        "log": own.log,
        "ends": [unique[0], unique[-2 if own.infinite and unique.size > 1 else -1]],
        "infinity": unique[-1] if own.infinite else None,
        "few": unique if unique.size <= FEW else unique[:0],
        "listed": False,
    }


def _named(dataset: xarray.Dataset, name: str, unit: Unit | None = None) -> tuple[Entry, NDArray[Any]]:
    """Name a variable in its ways, and give its values in a unit (one that suits them if None)."""
    values = dataset[name].values
    unit = unit or unit_for(name, values)
    named = {
        "name": name,
        "symbol": symbol(name),
        "title": title(name, str(dataset[name].attrs.get("long_name", name))),
        "unit": plain(unit.symbol),
        "infinite": "unbounded" if name in INPUTS and INPUTS[name].infinite else "",
    }
    return named, np.asarray(values, dtype=float) / 10.0**unit.power if unit.power else values


def _parameter(dataset: xarray.Dataset, name: str, axes: Sequence[str]) -> Entry:
    """Describe a parameter that is no axis: fixed, or following from axes, or one of the points."""
    if name == SOLVER:
        return _words(name, SOLVERS, [str(dataset[name].item())]) | {"axes": []}
    own = [axis for axis in axes if axis in dataset[name].dims]
    named, values = _named(dataset.transpose(*own, ...), name)
    values = np.asarray(values, dtype=float).ravel()
    entry = named | {"axes": [axes.index(axis) for axis in own], "values": values}
    if own == [SCENE] and np.unique(values).size > 1:
        order = np.argsort(values, kind="stable")
        placed = _placed(values[order])
        entry |= placed | {"places": placed["places"][np.argsort(order, kind="stable")]}
    return entry


def _variable(dataset: xarray.Dataset, name: str, units: Mapping[str, Unit]) -> Entry:
    """Describe a variable: its values to 6 digits, and which flags cast doubt on them."""
    named, values = _named(dataset, name, units.get(name))
    if values.dtype.kind in "iu" and name not in INTEGERS:
        values = np.where(values < 0, np.nan, values)  # a count that is missing is -1
    flat = rounded(values.ravel())
    finite = flat[np.isfinite(flat)]
    positive = finite[finite > 0]
    part = part_of(name)
    return named | {
        "sensitivity": part and {"of": part[0], "to": symbol(part[1]), "plain": part[1] in PLAIN},
        "values": flat,
        "length": values.shape[-1] if curve_of(name) else 1,
        "curve": curve_of(name) or "",
        "doubts": doubts_of(name, dataset),
        "least": float(finite.min()) if finite.size else None,
        "greatest": float(finite.max()) if finite.size else None,
        "gaps": bool(finite.size < flat.size),
        "leastPositive": float(positive.min()) if positive.size else None,
    }


def lines_of(dataset: xarray.Dataset) -> tuple[list[Plane], dict[str, Unit], Entry]:
    """List the planes that a dataset of curves fills, and the lines in them, in units if it has them.

    Returns
    -------
    The planes, the unit of each variable, and for the script the lines and how an axis names each quantity.
    """
    names = [str(name) for name in dataset.data_vars]
    there = tracks_in(names, si=wants_si(names, ()))
    if not there:
        raise DatasetError('a page shows whole curves; name some in the outputs of the study, as in outputs = ["path"]')
    labels: dict[str, str] = {}
    units: dict[str, Unit] = {}
    for quantity in QUANTITIES:
        own = [track.variables[quantity] for track in there]
        values = [dataset[name].values.ravel() for name in own if name in dataset]
        unit = unit_for(own[0], np.concatenate([np.empty(0), *values]))
        labels[quantity] = plain(label(own[0], unit))
        units |= dict.fromkeys(own, unit)
    planes = [plane for plane in PLANES if any({track.variables[one] for one in plane} <= {*names} for track in there)]
    return planes, units, {"tracks": [_line(track) for track in there], "labels": labels}


def _line(track: Track) -> Entry:
    """Describe a line for the script."""
    colour = track.colour(Looks().colours)
    return {**track.variables} | {
        "curve": track.curve,
        "label": track.label,
        "colour": to_hex(colour),
        "faded": to_hex(faded(colour)),
        "dash": UNLOADING if track.unloading else _pixels(track.dash, track.width),
        "jumpDash": _pixels(JUMP, THIN),
        "jumpWidth": WIDTH * THIN,
        "width": WIDTH * track.width,
        "unloading": track.unloading,
        "flag": f"{track.curve}_jump",
    }


def _pixels(dash: Dash, width: float) -> list[int]:
    """Write a dash in pixels; none is a full line.

    >>> _pixels("-", 1.0), _pixels((0, (3, 2)), 2.0)
    ([], [9, 6])
    """
    return [] if isinstance(dash, str) else [max(1, round(WIDTH * width * length)) for length in dash[1]]


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
