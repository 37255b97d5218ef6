"""Values of keys that were fitted, out of the dataset of a fit."""

from pathlib import Path

from gradhesion.cli.files import kind_of
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core.problem.status import ANOTHER_MINIMUM, FAILED, POOR_FIT


def fitted_value(path: Path, key: str) -> float | str:
    """
    Give the value of a key as a study writes it: in its unit if it has one.

    ValueError where the file is no fit of one loop, or the fit has no such key, or is flagged.
    """
    import netCDF4  # noqa: PLC0415 (180 ms, which other studies do without)

    try:
        with netCDF4.Dataset(path) as file:
            if not {"value", "parameter_units", "chi_square"} <= file.variables.keys():
                raise ValueError("the dataset is not that of a fit; name one that a study of kind fit gave")
            if "loop" in file.dimensions:
                one = f"`gradhesion select {path} --at loop=0 -o one.nc`"
                raise ValueError(f"fits of several loops; take one with {one}")
            names, units = (list(map(str, file[name][:])) for name in ("parameter", "parameter_units"))
            values, status, converged = file["value"][:].tolist(), int(file["status"][...]), int(file["converged"][...])
    except OSError as error:
        what = kind_of(path) or error.strerror or "it cannot be read"
        raise ValueError(f"not the dataset of a fit ({what}); name one, or give a value") from None
    if key not in names:
        raise ValueError(f"the fit has no {key}; {did_you_mean(key, names)}")
    if status & (FAILED | POOR_FIT | ANOTHER_MINIMUM) or not converged:
        raise ValueError("the fit is flagged, as `gradhesion info` reports; give the value as a number if it will do")
    value, unit = values[names.index(key)], units[names.index(key)]
    return value if unit == "1" else f"{value!r} {unit}"
