"""The zeros of an instrument: which are fitted, under which names."""

from typing import Any

import pytest

from gradhesion.core.loops.paths.offsets import NAMES, NO_OFFSETS, Offsets


def test_both_zeros_are_fitted_unless_said_otherwise() -> None:
    assert Offsets().names == NAMES[:2]
    assert NO_OFFSETS.names == ()
    assert Offsets(indentation=(-1e-6, 2e-6), load=False, slope=True).names == ("indentation_offset", "load_slope")
    assert Offsets(indentation="contact").names == ("load_offset",)


@pytest.mark.parametrize("name", ["indentation", "load"])
@pytest.mark.parametrize("wrong", ["fre", (1.0, 1.0), (0.0, float("inf")), (1.0,)])
def test_what_is_no_zero_is_refused(name: str, wrong: Any) -> None:
    for given in ({name: wrong}, {"indentation": True}, {"load": "contact"}):
        with pytest.raises(ValueError, match="or the rising ends of a range"):
            Offsets(**given)
