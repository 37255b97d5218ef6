"""One record that is the table of one exponent after the other."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gradhesion.core.problem.material import fill_stiffness, stiffness
from gradhesion.core.struve.current import ready, ready_for_theta
from gradhesion.core.struve.interpolated import complete, interpolated_tables, table_of_each
from gradhesion.core.struve.layout import TABLE
from gradhesion.core.struve.table import build_table

EXPONENTS = np.concatenate([np.random.default_rng(4).uniform(0.0, 1.0, 9), [0.0, 1.0]])
OF_CYCLES = (
    "jump_tail",
    "slow_tail",
    "inverse_stretch",
    "fractional",
    "moment_series",
    "moment_tail",
    "moment_constant",
)


def values_of(table: NDArray[Any]) -> dict[str, Any]:
    """Return what a table holds for its readers."""
    complete(table)
    used = [name for name in TABLE.names or () if name not in ("recipes", "for_forces")]
    return {name: table[0][name].tolist() for name in used}


@pytest.mark.parametrize("order", [np.arange(11), np.random.default_rng(5).permutation(11)])
def test_it_has_the_bits_of_a_table_for_that_exponent(order: NDArray[np.int64]) -> None:
    current = table_of_each(EXPONENTS, forces=False)
    for number in order.tolist():
        assert ready(current, number) == 0
        assert values_of(current) == values_of(interpolated_tables(EXPONENTS[number : number + 1]))


def test_the_same_exponent_again_keeps_what_is_filled() -> None:
    current = table_of_each(EXPONENTS, forces=True)
    ready(current, 3)
    complete(current)
    ready(current, 3)
    assert not current[0]["lacks_bin"].any()
    ready(current, 4)
    assert current[0]["lacks_bin"].all()


def test_forces_leave_out_what_they_do_not_read() -> None:
    current, whole = table_of_each(EXPONENTS, forces=True), table_of_each(EXPONENTS, forces=False)
    for name in OF_CYCLES:
        current[name] = -7.0
    ready(current, 5)
    ready(whole, 5)
    complete(current)
    for name, value in values_of(whole).items():
        if name in OF_CYCLES:
            assert (current[0][name] == -7.0).all(), name
        elif name != "moment_logarithm":
            np.testing.assert_array_equal(current[0][name], value, err_msg=name)


def test_theta_alone() -> None:
    """What theta needs is that of the exponent; the table of none follows, so that it is made when it is asked for."""
    current = table_of_each(EXPONENTS, forces=False)
    ready(current, 2)
    assert ready_for_theta(current, 6) == 0
    expected = interpolated_tables(EXPONENTS[6:7])[0]
    assert current[0]["theta"].tolist() == expected["theta"].tolist()
    assert current[0]["theta_front"] == expected["theta_front"]
    ready(current, 2)
    assert values_of(current) == values_of(interpolated_tables(EXPONENTS[2:3]))


def test_stiffness() -> None:
    k = EXPONENTS[:9]
    nu, modulus, depth = (np.full(9, value) for value in (0.3, 200.0, 0.02))
    out = np.empty(9)
    numbers = np.arange(9)
    fill_stiffness(table_of_each(k, forces=True), numbers, numbers, k, nu, modulus, depth, out)
    np.testing.assert_allclose(out, stiffness(k, nu, modulus, depth), rtol=64 * 2.0**-52)


def test_a_table_of_its_own_is_the_one_of_its_number() -> None:
    own = np.array([build_table(0.3), build_table(0.4)])
    before = own.tobytes()
    assert [ready(own, number) for number in (0, 1)] == [ready_for_theta(own, number) for number in (0, 1)] == [0, 1]
    assert own.tobytes() == before
