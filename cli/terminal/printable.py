"""Text that a terminal shows, and a file in UTF-8 holds, whatever stands in it."""

import re
from typing import Final

_UNSAFE: Final = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters, what turns the direction of text, and bytes of a name that are not UTF-8."""


def printable(text: str) -> str:
    r"""
    Write characters that a terminal would obey, or cannot show, as their escapes; ends of lines and tabs stay.

    >>> printable("\x1b[2Jout.nc"), printable("caf\u00e9\n\udcff")
    ('\\x1b[2Jout.nc', 'café\n\\udcff')
    """
    return _UNSAFE.sub(lambda found: found[0].encode("unicode_escape").decode(), text)


def printable_line(text: str) -> str:
    r"""
    Do so for a text that is to be one line: the name of a file may have several.

    >>> printable_line("out\n.nc")
    'out\\n.nc'
    """
    return printable(text).replace("\n", "\\n")
