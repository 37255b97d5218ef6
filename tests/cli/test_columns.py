"""Columns of numbers are read from text and NetCDF, and what is none is refused with a line and a remedy."""

import hashlib
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from gradhesion.cli.tables import reading
from gradhesion.cli.tables.columns import ColumnsError, Wanted
from gradhesion.cli.tables.reading import read_columns
from gradhesion.cli.tables.text import of_text


def written(folder: Path, text: str | bytes, name: str = "table.csv") -> Path:
    path = folder / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


TEXTS = [
    "A,R [um]\n0.5,1e3\ninf,-2\n",
    "\ufeff# a comment\n\nA ; R (um)\r\n0.5;1e3\r\n# another\r\ninf;-2",
    "  A   R [um]\n 0.5  1e3\n inf -2 # behind\n",
    '"A","R [um]"\n"0.5","1e3"\n"inf","-2"\n',
    "A;R [um]\n0,5;1000\ninf;-2\n",
    "A\tR [um]\n0,5\t1e3\ninf\t-2\n",
    'A,R [um]\n"0,5","1000"\n"inf","-2"\n',
    "sep=;\nA;R [um]\n0,5;1000\ninf;-2\n",
    "A,R\n-,um\n0.5,1000\ninf,-2\n",
    "A;R;\n;[um];\n0,5;1000;\ninf;-2;\n",
    "A,R [um]\n0.5,1000,,\n\n,\ninf,-2\n",
    "A;R [um];\r0.5;1000;\rinf;-2;\r",
    "A [-],R [um] # comment, and more\n0.5,1000 # comment, and more\ninf,-2\n",
    '"A" "R [um]"\n0.5 1000\ninf -2\n',
    "# A,R [um]\n0.5,1000\ninf,-2\n",
    "# an export\n#\n# columns: A R [um]\n# of 2 rows, as written\n0.5 1000\ninf -2\n",
    "A;R [um]\n0,5;1000\ninf;-2\n".encode("utf-16"),
    "A,R [um]\n.5,+1e+3\ninf,-20E-1\n".encode("utf-32"),
]


@pytest.mark.parametrize("text", TEXTS)
def test_what_a_spreadsheet_or_an_instrument_writes_is_read_with_its_units(text: str | bytes, tmp_path: Path) -> None:
    found = read_columns(path := written(tmp_path, text))
    assert {name: values.tolist() for name, values in found.values.items()} == {"A": [0.5, np.inf], "R": [1e3, -2.0]}
    assert found.units == {"R": "um"}
    assert found.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize("cell", ["", "nan", " ", "#N/A", "#DIV/0!", '""'])
def test_a_cell_without_a_number_is_missing(cell: str, tmp_path: Path) -> None:
    found = read_columns(written(tmp_path, f"A,k\n1,{cell}\n{cell},2\n"))
    np.testing.assert_array_equal(np.column_stack([*found.values.values()]), [[1.0, np.nan], [np.nan, 2.0]])


def test_what_is_not_read_may_be_anything_but_ragged(tmp_path: Path) -> None:
    text = ',A,note,note\n7,1,"a, b",\n8,2,\u00b5,#c\n'
    found = read_columns(written(tmp_path, text), only=["A", "k"])
    assert (found.values["A"].tolist(), found.others) == ([1.0, 2.0], ("", "note", "note"))


@given(hnp.arrays(np.float64, st.tuples(st.integers(1, 20), st.integers(1, 5)), elements=st.floats(width=64)))
def test_every_number_comes_back_and_quotes_change_none(table: np.ndarray) -> None:
    rows = [",".join(f"c{i}" for i in range(table.shape[1])), *(",".join(map(repr, row)) for row in table.tolist())]
    for text in ("\n".join(rows), "\n".join([*rows, '"",'])):
        found = of_text(text.encode(), "", Wanted())
        np.testing.assert_array_equal(np.column_stack(list(found.values.values())), table)


MISTAKES = {
    "": "is empty",
    " \n\t\n": "is empty",
    "# only\n": "comments only",
    "A,,k\n1,2,3\n": "column 2 of the header on line 1 has no name",
    "A\n1\n2 mm\n": "line 3 has 2 values under 1 name;",
    b"\x89HDF\r\n\x1a\nbroken": "cannot be read as NetCDF",
    "A," + 2**15 * "[" + "\n1,2\n": "line 1 is too long for a header, 32,771 characters",
}
"""Besides those of test_wrong_tables.py."""


@pytest.mark.parametrize("text", MISTAKES, ids=lambda text: repr(text)[:30])
def test_what_is_no_table_is_refused(text: str | bytes, tmp_path: Path) -> None:
    with pytest.raises(ColumnsError) as caught:
        read_columns(written(tmp_path, text))
    assert MISTAKES[text] in str(caught.value)
    assert ";" in str(caught.value), "what to do"


def test_a_file_that_is_none_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for path in (tmp_path / "absent.csv", tmp_path, tmp_path / "\0.csv", Path("/dev/zero")):
        with pytest.raises(ColumnsError, match="cannot be read"):
            read_columns(path)
    monkeypatch.setattr(reading, "MOST_BYTES", 100)
    with pytest.raises(ColumnsError, match="larger than"):
        read_columns(written(tmp_path, "A\n" + 100 * "1\n"))


def test_netcdf_has_variables_of_one_dimension(tmp_path: Path) -> None:
    path = tmp_path / "table.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("row", 3)
        file.createVariable("A", "f8", ("row",))[:] = [1.0, 2.0, 2.5]
        file.createVariable("n", "i8", ("row",), fill_value=-1)[:] = [2**52 + 1, -1, 2**52]
        file.createVariable("way", str, ("row",))[:] = np.array(["in", "out", "In"], object)
        file.createVariable("one", "f8", ())[...] = 1.0
        file["A"].units = "nm"
    found = read_columns(path, words={"way": {"in": 0.0, "out": 1.0}}, whole=["n"])
    assert found.values.pop("way").tolist() == [0.0, 1.0, 0.0]
    for one in (found, read_columns(path)):
        assert one.values.keys() == {"A", "n"}
        assert one.units == {"A": "nm"}
        np.testing.assert_array_equal(one.values["n"], [2.0**52 + 1, np.nan, 2.0**52])  # with all digits
    with pytest.raises(ColumnsError, match=r"row 2, .*: A is not a whole number of at most 15 digits; write one"):
        read_columns(path, whole=["A"])
    with netCDF4.Dataset(path, "a") as file:
        file.createDimension("other", 2)
        file.createVariable("b", "f8", ("other",))[:] = 0.0
    with pytest.raises(ColumnsError, match="differ in length"):
        read_columns(path)
    with netCDF4.Dataset(path, "w") as file:
        file.createVariable("one", "f8", ())[...] = 1.0
    with pytest.raises(ColumnsError, match="no variable of numbers"):
        read_columns(path)
