"""Solve or draw scenes without a file: parameters in, an xarray dataset out."""

import inspect
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any, Final, TypeVar

import numpy as np
import xarray
from numpy.typing import NDArray

import gradhesion.accessor  # noqa: F401 (registers `dataset.gr`)
from gradhesion.cli.dataset.describe import Variable, attributes, steep_contact, variables
from gradhesion.cli.dataset.read.model_range import slope_warnings
from gradhesion.cli.dataset.writer import compute
from gradhesion.cli.names.outputs import labels_of
from gradhesion.cli.names.scenes import REALISATION, SCENE, SOLVER, STEEP
from gradhesion.cli.study.reading import study_from
from gradhesion.cli.study.study import Study
from gradhesion.cli.terminal import messages
from gradhesion.cli.work.compiling import prepare
from gradhesion.cli.work.solve.scenes import scenes_from, solve_given
from gradhesion.core.closed.reduced import sources_of
from gradhesion.core.problem.inputs import INPUTS
from gradhesion.core.problem.profile import Profile
from gradhesion.core.problem.toughness import Rate, Toughness
from gradhesion.given import Given, is_monotone

Arrays = Mapping[str, float | xarray.DataArray]
"""By name; a number is the same in all scenes."""
_Function = TypeVar("_Function", bound=Callable[..., Any])
FORCE_AND_ENERGY: Final = ("pull_off_force", "dissipated_energy")


def _with_inputs(function: _Function) -> _Function:
    """Name every input of a study among the keywords of a function, for help and for editors to complete."""
    plain = inspect.signature(function)
    own = [one for one in plain.parameters.values() if one.kind is not one.VAR_KEYWORD]
    inputs = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Any) for name in INPUTS]
    function.__signature__ = plain.replace(parameters=[*own, *inputs])  # type: ignore[attr-defined]
    return function


@_with_inputs
def solve(
    parameters: Mapping[str, Any] | None = None,
    outputs: Sequence[str] | str = FORCE_AND_ENERGY,
    *,
    profile: Profile | Mapping[str, Any] | None = None,
    control: str | None = None,
    toughness: Toughness | Mapping[str, Any] | None = None,
    rate: Rate | Mapping[str, Any] | None = None,
    solver: str | Sequence[str] | None = None,
    check_contact: bool | None = None,
    threads: int | None = None,
    title: str | None = None,
    **more: Any,
) -> xarray.Dataset:
    """Solve scenes: every combination of axes, or arrays over named dimensions.

    Parameters
    ----------
    parameters, and keywords
        The inputs of a study by name, in a mapping, as keywords, or both (a keyword overrides the mapping): k, nu, the
        ratios modulus E* R/dgamma, c0_over_R (not needed if k = 0) and lambda_over_R (not needed if A = 0), A, and
        a_max_over_R, inf by default; their reduced forms (chi, lambda_over_L, ...); and quantities with units, such as
        R = "1 um" or one of pint, astropy or unyt (a plain number is in SI units: R = 1e-6). Each of them is

        - a number (or a quantity with its unit; for a ratio a dimensionless one, such as percent): the same in all
          scenes;
        - a list, a plain array of one dimension, or a range {"start": .., "stop": .., "num": .., "spacing": "log"}: an
          axis of the name of the parameter, as in a study. Two lists make a grid, whatever their lengths;
        - an xarray.DataArray: arrays broadcast by the names of their dimensions, so that A and k over the same
          dimension vary together. One over a single dimension of its own name is an axis. Its unit is that of
          pint-xarray or its attribute `units`; without either it is in SI units;
        - a column of pandas: an array over the dimension of its index. A DataFrame has one scene per row.

        A plain array of two or more dimensions is refused: their names are missing.
    outputs
        Names from `OUTPUTS`.
    profile
        The shape of the punch, a `Profile` or the table of a study; by default a paraboloid with one cosine wave.
    control
        "displacement" (the default), "load" or "machine".
    toughness
        How the toughness varies with the radius, a `Toughness` or the table of a study; constant by default.
    rate
        How the work of adhesion grows with the speed of the edge, a `Rate` or the table of a study; not at all by
        default.
    solver
        One of `SOLVERS`, "exact" by default; a list puts several side by side along the dimension `solver`.
    check_contact
        Whether `status` reports that the contact on loading is not one disc; True by default.
    threads
        Threads to use, all processors if None; the values do not depend on it.
    title
        The title of the dataset; by default the names of the outputs.

    Returns
    -------
    A dataset as `gradhesion run` writes it, with units, long names and flags: outputs and `status` over the named
    dimensions, in the order in which they occur, then over the axes in the order of a study; the values of an axis
    stay in the order in which they are given. Parameters are coordinates over their own dimensions. A scene without a
    value is NaN (counts of jumps: -1), and its status reports it. The attribute `study` is set if a study of at most
    10,000 values gives the same dataset, so that `verify` can recompute it.

    Raises
    ------
    StudyError
        Parameters, outputs or settings are unknown, missing or out of range, a unit is not that of a parameter, or
        dimensions are inconsistent; the error lists all mistakes.

    Notes
    -----
    A call of one scene costs about a millisecond more than `gradhesion.core.solve`, which takes and returns plain
    arrays that broadcast by position; use that one inside a loop. Accuracy and equations are the same, and are given
    there.

    Examples
    --------
    A grid of two amplitudes and three wavelengths:

    >>> import gradhesion as gr
    >>> punch = dict(k=0.5, nu=0.3, modulus=500.0, c0_over_R=0.01, a_max_over_R=1.0)
    >>> grid = gr.solve(punch, "pull_off_force", A=[0.0, 0.02], lambda_over_R=[0.1, 0.2, 0.4])
    >>> dict(grid["pull_off_force"].sizes)
    {'lambda_over_R': 3, 'A': 2}

    Pairs, by a dimension that both share:

    >>> import xarray
    >>> A, wavelength = xarray.DataArray([0.0, 0.02], dims="test"), xarray.DataArray([0.1, 0.2], dims="test")
    >>> pairs = gr.solve(punch, "pull_off_force", A=A, lambda_over_R=wavelength)
    >>> dict(pairs["pull_off_force"].sizes)
    {'test': 2}
    >>> bool(pairs["pull_off_force"][1] == grid["pull_off_force"].sel(lambda_over_R=0.2, A=0.02))
    True
    """
    settings: dict[str, Any] = {"outputs": outputs, "profile": profile, "control": control, "solver": solver}
    settings |= {"check_contact": check_contact, "title": title, "toughness": toughness, "rate": rate}
    given = Given("gr.solve", parameters, more, settings, threads)
    study = given.study()
    prepare(study)
    return _solved(replace(study, text=given.text(study)), given.parameters(study), threads)


@_with_inputs
def curves(
    parameters: Mapping[str, Any] | None = None,
    outputs: Sequence[str] | str = ("equilibrium", "path"),
    *,
    profile: Profile | Mapping[str, Any] | None = None,
    control: str | None = None,
    toughness: Toughness | Mapping[str, Any] | None = None,
    rate: Rate | Mapping[str, Any] | None = None,
    contact_radius_over_R: Sequence[float] | float | None = None,
    threads: int | None = None,
    title: str | None = None,
    **more: Any,
) -> xarray.Dataset:
    """Draw the curves of scenes: contact radius, depth and load at points that adapt to them.

    Parameters
    ----------
    parameters, and keywords
        As in `solve`, but for arrays over named dimensions, which are axes, or all of them over the one dimension
        `scene`; 1,000 scenes at most. The values of an axis must rise or fall.
    outputs
        Names from `CURVES`, such as "path", or single variables of them, such as "path_load".
    contact_radius_over_R
        For "pressure" and "surface": the radii of states of equilibrium, ratios; None for turning point, pull-off and
        jump-out.
    profile, control, toughness, rate, threads, title
        As in `solve`.

    Returns
    -------
    A dataset as `gradhesion run` writes it for a study of kind "curve": each curve along a dimension of its own,
    shorter ones padded with NaN (-1 where they are integers).

    Raises
    ------
    StudyError
        As in `solve`.

    Examples
    --------
    >>> import gradhesion as gr
    >>> punch = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, A=0.02, a_max_over_R=0.5)
    >>> force = gr.solve(punch, "pull_off_force")["pull_off_force"]
    >>> lowest = gr.curves(punch, "equilibrium")["load"].min()
    >>> bool(abs(lowest / -force - 1.0) < 1e-12)
    True
    """
    settings: dict[str, Any] = {"kind": "curve", "outputs": outputs, "profile": profile, "control": control}
    settings |= {"contact_radius_over_R": contact_radius_over_R, "title": title, "toughness": toughness, "rate": rate}
    given = Given("gr.curves", parameters, more, settings, threads)
    for name, array in given.arrays.items():
        if not (given.is_grid or given.is_points):
            if array.dims not in ((name,), (SCENE,)):
                given.refuse(name, f"curves are drawn over axes, or over one dimension {SCENE}; rename its dimensions")
        elif given.is_grid and not is_monotone(array):
            given.refuse(name, "the values of an axis of curves must rise or fall; sort them")
    given.study()
    return compute(study_from(given.whole(), "gr.curves"), threads=threads)


def _solved(study: Study, parameters: Arrays, threads: int | None) -> xarray.Dataset:
    """Solve the scenes of a study whose parameters, in plain numbers (SI), stand over dimensions of any names.

    The study says what is asked for; its own parameters count by their names only, and without a text the dataset has
    no study. Of a grid or of points the dataset is that which `gradhesion.cli.dataset.compute` gives.
    """
    sizes = _sizes_of(parameters)
    arrays = {name: _along(sizes, value) for name, value in parameters.items()}
    scenes = scenes_from(arrays)
    whole = tuple(slice(0, size) for size in study.shape)
    watch = study.may_reach(scenes["a_max_over_R"])
    found = solve_given(study, arrays, whole, threads, watch=watch, scenes=scenes)
    steep = found.pop(STEEP, np.zeros(1, np.int8))
    described = variables(study)
    apart = {*sizes, *study.labels, SOLVER, REALISATION}
    beside = [name for name in described if name not in found and name not in apart]
    front, last = ([one] if one in described else [] for one in (SOLVER, REALISATION))
    made = {}
    for name, variable in described.items():
        own, values = [*variable.dimensions], variable.values
        if name in found:
            own, values = [*front, *sizes, *last, *filter(None, [labels_of(name)])], found[name]
        elif name in scenes or name in arrays:
            sources = [name] if name in arrays else sources_of(name, parameters)
            varying = {dim for source in sources for dim in getattr(parameters[source], "dims", ())}
            own = [dim for dim in sizes if dim in varying]
            values = (arrays if name in arrays else scenes)[name].reshape([sizes[dim] for dim in own])
        made[name] = _as_read(variable, own, np.asarray(values), beside if name in found else [])
    # Twice as fast as xarray.Dataset(made).set_coords(beside), and the same.
    dataset = xarray.Coordinates(made).to_dataset().reset_coords([name for name in described if name in found])
    dataset.attrs = attributes(study, "computed in memory")
    if not study.text:
        del dataset.attrs["study"], dataset.attrs["study_sha256"]
    if steep.any() and (mark := steep_contact(study)):
        dims = [str(dim) for dim in dataset["status"].dims]
        dataset = dataset.assign_coords({STEEP: _as_read(mark, dims, steep, [])})
    _say_once(tuple(slope_warnings(dataset)))
    others: dict[Hashable, xarray.DataArray] = {}  # coordinates that came with the parameters, and are not theirs
    for array in (array for array in parameters.values() if isinstance(array, xarray.DataArray)):
        for key, coordinate in array.coords.items():
            if key not in dataset.variables:
                others.setdefault(key, coordinate.reset_coords(drop=True))
    return dataset.assign_coords(others) if others else dataset


@cache
def _say_once(sentences: tuple[str, ...]) -> None:
    """Say what a call has to report; in a loop that is the same many times, and is said once."""
    for sentence in sentences:
        messages.say(f"gr.solve: {sentence}")


def _as_read(variable: Variable, dims: list[str], values: NDArray[Any], beside: list[str]) -> xarray.Variable:
    """Give a variable as xarray reads it from a file, by CF: what is said of its cells stands in `encoding`."""
    plain = {key: value for key, value in variable.attributes.items() if key != "coordinates"}
    encoding: dict[str, Any] = {} if variable.blank is None else {"_FillValue": values.dtype.type(variable.blank)}
    encoding |= {"coordinates": " ".join(beside)} if beside else {}
    return xarray.Variable(dims, values, plain, encoding | {"dtype": values.dtype})


def _sizes_of(parameters: Arrays) -> dict[str, int]:
    """List the dimensions of parameters: those of other names as they are met, then the axes as a study orders them.

    >>> A, k = xarray.DataArray([[0.1], [0.2]], dims=["nu", "x"]), xarray.DataArray([0.0, 0.5], dims="k")
    >>> _sizes_of({"A": A, "k": k, "modulus": 500.0})
    {'x': 1, 'k': 2, 'nu': 2}
    """
    arrays = (array for array in parameters.values() if isinstance(array, xarray.DataArray))
    met = {str(dim): size for array in arrays for dim, size in array.sizes.items()}
    others = {dim: size for dim, size in met.items() if dim not in INPUTS}
    return others | {key: met[key] for key in INPUTS if key in met}


def _along(sizes: Mapping[str, int], value: float | xarray.DataArray) -> NDArray[np.float64]:
    """Give a parameter with an axis for every dimension, of length 1 where it does not vary."""
    if isinstance(value, float):
        return np.full((1,) * len(sizes), value)
    return np.asarray(value.expand_dims([dim for dim in sizes if dim not in value.dims]).transpose(*sizes).values)
