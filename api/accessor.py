"""The accessor `dataset.gr` of xarray: the meaning of the status of its scenes."""

from typing import Any

import numpy as np
import xarray

from gradhesion.cli.dataset.read.model_range import LIMITS, beyond_by, doubts_of, is_cone
from gradhesion.cli.dataset.read.reader import check_ours
from gradhesion.cli.errors import DatasetError
from gradhesion.cli.terminal.wording import did_you_mean
from gradhesion.core.answers.flags import FLAGS
from gradhesion.core.problem.status import ANOTHER_MINIMUM, FAILED, OF_FITS, POOR_FIT


@xarray.register_dataset_accessor("gr")  # type: ignore[no-untyped-call]
class Accessor:
    """What the bits of `status` say, scene by scene; `dataset.gr` of any dataset of this program.

    Raises
    ------
    DatasetError
        The dataset is of another program.

    Examples
    --------
    >>> import gradhesion as gr
    >>> punch = dict(k=0.0, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, a_max_over_R=1.0)
    >>> rough = gr.solve(punch, A=[0.0, 0.1])
    >>> rough.gr.flagged("loading_contact_not_one_disc").values.tolist()
    [False, True]
    >>> rough.gr.valid("dissipated_energy").values.tolist(), rough.gr.valid("pull_off_force").values.tolist()
    ([True, False], [True, True])
    """

    def __init__(self, dataset: xarray.Dataset) -> None:
        check_ours(dataset)
        self._dataset = dataset

    def __repr__(self) -> str:
        """Say what the dataset has, how many of its scenes are flagged, and what can be asked."""
        status = self._dataset["status"]
        flags = [f"  {name}: {int(self.flagged(name).sum()):,}" for name in FLAGS | OF_FITS if self.flagged(name).any()]
        scenes = f"{status.size:,} {'scene' if status.size == 1 else 'scenes'}"
        return "\n".join(
            [
                f"gradhesion: {scenes}, {', '.join(str(name) for name in self._dataset.data_vars if name != 'status')}",
                *(["flagged scenes", *flags] if flags else ["no scene is flagged"]),
                "methods: flagged(flag), valid(variable), outside(number), plot(...)",
            ]
        )

    def valid(self, variable: str | None = None) -> xarray.DataArray:
        """Report which scenes have valid values.

        Parameters
        ----------
        variable
            A variable of the dataset: True where it has a value and no flag casts doubt on it. Whether contact on
            loading is one disc is tested where an output of the cycle is asked for, not for the pull-off force alone.
            Without a variable: True where the scene has values at all.

        Returns
        -------
        Booleans over the dimensions of `status`, for `where`: `dataset["dissipated_energy"].where(dataset.gr.valid(
        "dissipated_energy"))`.

        Raises
        ------
        DatasetError
            The dataset has no such variable.
        """
        bits = FAILED
        if variable is not None:
            known = [str(name) for name in self._dataset.data_vars if name != "status"]
            if variable not in known:
                raise DatasetError(f"{variable}: not a variable of this dataset; {did_you_mean(variable, known)}")
            bits |= doubts_of(variable, self._dataset) | POOR_FIT | ANOTHER_MINIMUM
        status = self._dataset["status"]
        sound = (status.astype(np.int16) & bits) == 0
        if variable is not None and self._dataset[variable].dims == status.dims:
            sound = sound & self._dataset[variable].notnull()  # beyond a million waves there is no saturation radius
        return sound

    def flagged(self, flag: str) -> xarray.DataArray:
        """Report which scenes have a flag.

        Parameters
        ----------
        flag
            A name from `FLAGS`, or for fits "poor_fit" or "another_minimum".

        Returns
        -------
        Booleans over the dimensions of `status`.

        Raises
        ------
        DatasetError
            There is no such flag.
        """
        known = FLAGS | OF_FITS
        if flag not in known:
            raise DatasetError(f"{flag}: not a flag of status; {did_you_mean(flag, list(known))}")
        return (self._dataset["status"].astype(np.int16) & known[flag]) != 0

    def outside(self, number: str = "contact_slope") -> xarray.DataArray:
        """Report which scenes leave the range of the model, by a validity number.

        Parameters
        ----------
        number
            "contact_slope", which is available for every dataset, or a validity number that is a variable of this one.

        Returns
        -------
        Booleans over the dimensions of the number, for `where`: `dataset.where(~dataset.gr.outside())`.

        Raises
        ------
        DatasetError
            The dataset does not have this number.
        """
        beyond = beyond_by(number, self._dataset) if number in LIMITS else None
        if beyond is None and number != "contact_slope":
            raise DatasetError(f"{number}: not a variable of this dataset; add it to the outputs of the study")
        if beyond is None:
            beyond = xarray.full_like(self._dataset["status"], is_cone(self._dataset), dtype=bool)
        return beyond

    def plot(self, variables: Any = None, **choices: Any) -> Any:
        """Draw the dataset, as `gradhesion.plot(dataset, variables, ...)`; the axes of its panels are returned."""
        import gradhesion  # noqa: PLC0415 (which may be importing this module)

        return gradhesion.plot(self._dataset, variables, **choices)
