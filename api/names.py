"""The parameters of a scene, with their meanings; outputs and curves are in `gradhesion.cli.names`."""

from typing import Any, Final, TypedDict

from gradhesion.core.problem import names
from gradhesion.core.problem.inputs import INPUTS

PARAMETERS: Final = {name: INPUTS[name].about for name in names.PARAMETERS}
"""Every parameter of a scene, in the order of a dataset's dimensions, with its `long_name`."""


class Given(TypedDict, total=False):
    """The keywords by which `gradhesion.solve` and `gradhesion.curves` take parameters, for editors to complete."""

    k: Any
    nu: Any
    R: Any
    E_star: Any
    E: Any
    work_of_adhesion: Any
    modulus: Any
    c0: Any
    c0_over_R: Any
    wavelength: Any
    lambda_over_L: Any
    lambda_over_R: Any
    amplitude: Any
    chi: Any
    A: Any
    spring_constant: Any
    machine_stiffness: Any
    a_max: Any
    a_max_over_L: Any
    a_max_over_a2: Any
    a_max_over_R: Any
    indentation_max: Any
    indentation_max_over_R: Any
    preload: Any
    load_max: Any
    work_of_adhesion_closing: Any
    closing_ratio: Any
    toughness_wavelength: Any
    toughness_wavelength_over_R: Any
    toughness_amplitude: Any
    speed: Any
    reference_speed: Any
    speed_over_reference: Any
    adhesion_range: Any
    adhesion_range_over_R: Any
