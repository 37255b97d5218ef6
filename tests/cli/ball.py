"""The study of a smooth ball that tests of fits share, as the parts of a text."""

from typing import Final

COLUMNS: Final = """indentation = { column = "depth", unit = "nm" }
load = { column = "force", unit = "nN" }
"""
BALL: Final = """[parameters]
k = 0.0
nu = 0.3
A = 0.0
[physical]
R = "5 um"
E_star = { start = "1 MPa", stop = "100 MPa" }
"""
WORK: Final = 'work_of_adhesion = { start = "5 mJ/m^2", stop = "200 mJ/m^2" }\n'
