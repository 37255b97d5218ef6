"""The parameters of a scene, with what they are; outputs and curves are in `gradhesion.cli.names`."""

from typing import Final

from gradhesion.cli import keys

PARAMETERS: Final = {name: key.about for name, key in keys.PARAMETERS.items()}
"""Every parameter of a scene, in the order of a dataset's dimensions, with its `long_name`."""
