"""Tables from text files: dialects, widths, numbers, places, limits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.errors import BadInput, TrajectoryError
from thesis_pin.model.limits import LIMITS, Limits
from thesis_pin.tables import reading
from thesis_pin.tables.dialect import Dialect
from thesis_pin.tables.reading import read_table
from thesis_pin.tables.table import check_increasing, finite
from thesis_pin.tables.units import LENGTH, PLAIN, TIME

SI = PLAIN[0]


def table(tmp_path, text, **how):
    file = tmp_path / "a.csv"
    file.write_bytes(text.encode() if isinstance(text, str) else text)
    return read_table("gait", file, **how)


def columns(found):
    return [found.column(k, SI, name).values.tolist() for k, name in enumerate(found.header)]


def test_comments_and_empty_lines_are_skipped_and_lines_keep_their_numbers(tmp_path):
    found = table(tmp_path, "# note, with a comma\nt, x\n\n , \n 0 ,1\n")
    assert found.header == ("t", "x")
    assert found.rows == [("0", "1")]
    assert found.where(0).endswith("a.csv:5")


@pytest.mark.parametrize(
    ("text", "dialect"),
    [
        ("t,x\n0.5,1.25\n2,-1e-3\n", Dialect()),
        ("t;x\n0.5;1.25\n2;-1e-3\n", Dialect(";")),
        ("t;x\r\n0,5;1,25\r\n2;-1e-3\r\n", Dialect(";", ",")),
        ("\ufefft;x\n0,5;1,25\n2;-1e-3\n", Dialect(";", ",")),
        ("sep=;\nt;x\n0,5;1,25\n2;-1e-3\n", Dialect(";", ",")),
        ('"sep=;"\nt;x\n0,5;1,25\n2;-1e-3\n', Dialect(";", ",")),
        ("sep=,\nt,x\n0.5,1.25\n2,-1e-3\n", Dialect()),
        ("t\tx\n0.5\t1.25\n2\t-1e-3\n", Dialect("\t")),
        ("t\tx\n0,5\t1,25\n2\t-1e-3\n", Dialect("\t", ",")),
        ("t,\tx\n0.5,\t1.25\n2,\t-1e-3\n", Dialect()),
        ("t x\n 0.5   1.25\n2 -1e-3  \n", Dialect(" ")),
        ("t|x\n0.5|1.25\n2|-1e-3\n", Dialect("|")),
        ('"t","x"\n"0.5","1.25"\n"2","-1e-3"\n', Dialect()),
        ('"t","x"\n"0,5","1,25"\n"2","-1e-3"\n', Dialect(",", ",")),
        ("t;x;;\n0,5;1,25;;\n2;-1e-3;;\n;;;\n", Dialect(";", ",")),
        ("t,x\n0.5,1.25,\n2,-1e-3,\n", Dialect()),
        ("# made by a logger\n# t,x\n0.5,1.25\n2,-1e-3\n", Dialect(header=2)),
        ("# t x\n0.5 1.25\n2 -1e-3\n", Dialect(" ", header=1)),
        ("t;x\n,5;1,25\n2;-1E-3\n", Dialect(";", ",")),
    ],
)
def test_every_dialect_gives_the_same_numbers(tmp_path, text, dialect):
    found = table(tmp_path, text)
    assert found.header == ("t", "x")
    assert found.dialect == dialect
    assert columns(found) == [[0.5, 2.0], [1.25, -1e-3]]
    assert bool(dialect.notes) == (dialect != Dialect())


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("t;x\n1;1,234\n2;5,678\n", r"nothing tells whether the comma in .*a\.csv:2: '1,234' is"),
        ("t;x\n0.5;1\n1;0,5\n", r"with points \(.*:2: '0\.5'\) and with commas \(.*:3: '0,5'\)"),
        (
            "t,x\n0,5,1,25\n",
            r"a\.csv:2: 4 cells; allowed: 2.*If commas are decimal marks, separate",
        ),
        ("t;x\n0;1.234,5\n", r"a\.csv:2: the number '1\.234,5' groups its digits"),
        ("t;x\n0;1,234,567\n", r"a\.csv:2: the number '1,234,567' groups its digits"),
        ('t,x\n0,"1,234.5"\n', r"a\.csv:2: the number '1,234\.5' groups its digits"),
    ],
)
def test_numbers_that_can_be_read_in_two_ways_are_refused_with_their_place(tmp_path, text, says):
    with pytest.raises(BadInput, match=says):
        table(tmp_path, text)


def test_one_cell_that_can_only_be_a_decimal_settles_those_that_could_be_thousands(tmp_path):
    assert columns(table(tmp_path, "t;x\n1;1,234\n2;0,500\n"))[1] == [1.234, 0.5]


def test_words_may_hold_the_other_mark(tmp_path):
    found = table(tmp_path, "t;note\n0,5;as planned, more or less\n1,5;v1.2\n")
    assert found.column(0, SI, "t").values.tolist() == [0.5, 1.5]
    assert found.texts(1) == ["as planned, more or less", "v1.2"]


@pytest.mark.parametrize(
    ("text", "says"),
    [("", "empty"), ("# only\n", "empty"), (b"\xff\xfe", "empty"), ("t," + "9" * 200_000, "CSV")],
)
def test_a_file_without_samples_is_refused(tmp_path, text, says):
    with pytest.raises(BadInput, match=says):
        table(tmp_path, text)


def test_a_table_without_a_header_is_refused_unless_its_columns_are_known(tmp_path):
    with pytest.raises(BadInput, match=r"a\.csv:2: the gait has 2 columns without a header"):
        table(tmp_path, "# a note\n0,1\n1,2\n")
    found = table(tmp_path, "0,1\n1,2\n", bare=("t", "x"))
    assert (found.header, len(found)) == (("t", "x"), 2)
    with pytest.raises(BadInput, match="3 columns without a header; allowed: 2: t, x"):
        table(tmp_path, "0,1,2\n1,2,3\n", bare=("t", "x"))


def test_a_comment_that_names_other_columns_is_believed_before_the_order(tmp_path):
    found = table(tmp_path, "# x,t\n0,1\n1,2\n", bare=("t", "x"))
    assert found.header == ("x", "t")


@pytest.mark.parametrize(("more", "told"), [("", "1 cell"), (",5", "3 cells")])
def test_a_line_of_another_width_is_refused_with_its_number(tmp_path, more, told):
    with pytest.raises(BadInput, match=rf"a\.csv:3: {told}; allowed: 2"):
        table(tmp_path, f"t,x\n0,1\n1{more}{more}\n")


def test_a_cell_that_is_no_number_is_refused_with_line_and_column(tmp_path):
    found = table(tmp_path, "t,x\n0,1\n1,inf\n\n2,\n")
    with pytest.raises(BadInput, match=r"a\.csv:3, column 2: x is 'inf'"):
        found.column(1, SI, "x")
    assert found.column(0, SI, "t").values.tolist() == [0.0, 1.0, 2.0]
    with pytest.raises(BadInput, match=r"a\.csv:3, column 2: x is empty"):
        table(tmp_path, "t,x\n0,1\n1,\n").column(1, SI, "x")


def test_time_must_increase_strictly(tmp_path):
    found = table(tmp_path, "t\n0\n\n1\n1\n")
    with pytest.raises(TrajectoryError, match=r"a\.csv:5: time goes from 1 to 1"):
        check_increasing(found, found.column(0, SI, "t"))


def test_steps_of_time_too_short_to_divide_by_are_refused(tmp_path):
    found = table(tmp_path, "t\n0\n1e-300\n")
    with pytest.raises(TrajectoryError, match="steps of at least 1e-09"):
        check_increasing(found, found.column(0, SI, "t"))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_finite_number_reads_back_exactly(value):
    assert finite(repr(value)) == value


@given(st.decimals(-1000, 1000, places=9), st.sampled_from([LENGTH, TIME]), st.booleans())
def test_a_number_in_another_power_of_ten_is_the_same_to_the_bit(value, units, scientific):
    for unit in units:
        text = f"{value.scaleb(-unit.tens):{'E' if scientific else 'f'}}"
        assert finite(text, unit.tens) == float(value)


@given(st.text())
def test_any_other_text_is_no_number(text):
    value = finite(text)
    assert value is None or np.isfinite(value)


@pytest.mark.parametrize("cell", ["1e308", "-2e12", "1_0", "nan", "1e999", "\x1b[31m", "0x10"])
def test_a_cell_beyond_the_magnitude_or_in_pythons_own_writing_is_refused(tmp_path, cell):
    with pytest.raises(BadInput, match=r"a\.csv:2, column 1: t is '") as caught:
        table(tmp_path, f"t\n{cell}\n").column(0, SI, "t")
    assert "\x1b" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("0\n" + "1," * LIMITS.columns, r"a\.csv:2: the gait has 201 columns"),
        ("1\n" * 1_001, r"a\.csv:1001: the gait has 1,001 lines"),
        ("1,2,3,4\n" * 900, r"a\.csv:751: the gait has 3,004 cells"),
        ("1 2 3 4\n" * 900, r"a\.csv:751: the gait has 3,004 cells"),
    ],
)
def test_too_many_columns_lines_or_cells_are_refused_where_they_begin(
    tmp_path, monkeypatch, text, says
):
    monkeypatch.setattr(reading, "LIMITS", Limits(rows=1_000, cells=3_000))
    with pytest.raises(BadInput, match=says):
        table(tmp_path, text)


@pytest.mark.parametrize(
    ("codec", "encoding"),
    [
        ("utf-8", ""),
        ("utf-8-sig", ""),
        ("cp1252", "Windows-1252"),
        ("utf-16", "UTF-16"),
        ("utf-16-le", "UTF-16"),
        ("utf-16-be", "UTF-16"),
    ],
)
@pytest.mark.parametrize("separator", [",", "\t"])
def test_what_spreadsheets_write_instead_of_utf_8_is_read_and_said(
    tmp_path, codec, encoding, separator
):
    text = "t,ψ [°]\r\n0,1.5\r\n1,2.5\r\n".replace(",", separator)
    if codec == "cp1252":
        text = text.replace("ψ", "psi")
    found = table(tmp_path, text.encode(codec))
    assert found.header[1].endswith(" [°]")
    assert columns(found) == [[0.0, 1.0], [1.5, 2.5]]
    assert found.dialect.encoding == encoding
    assert any(encoding in note for note in found.dialect.notes) or not encoding


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"PK\x03\x04\x14\x00\x06\x00\x08\x00\x00\x00!\x00\xfe\x81", "Save the sheet as CSV"),
        (b"PK\x03\x04\x14\x00 plain", "Save the sheet as CSV"),
        (b"t,x\n0,\x81\n", "isn't text in UTF-8, UTF-16 or Windows-1252"),
        (b"t,x\n0,\xb0\x00\n", "isn't text"),
        (b"\xff\xfet", "isn't text"),
    ],
)
def test_what_is_no_text_is_refused(tmp_path, content, says):
    with pytest.raises(BadInput, match=says):
        table(tmp_path, content)


def test_prices_do_not_decide_which_mark_decimals_have(tmp_path):
    def used(heading):
        return heading in ("t", "x")

    grouped = 't,price,x\n0.5,"1,299.00",1.5\n1.5,"19,90",2.5\n'
    assert columns_named(table(tmp_path, grouped, means=used)) == [[0.5, 1.5], [1.5, 2.5]]
    commas = "t;price;x\n0,5;1.299,00;1,5\n1,5;19.90;2,5\n"
    assert columns_named(table(tmp_path, commas, means=used)) == [[0.5, 1.5], [1.5, 2.5]]
    with pytest.raises(BadInput, match="groups its digits"):
        table(tmp_path, grouped)


def columns_named(found):
    return [found.column(found.header.index(n), SI, n).values.tolist() for n in ("t", "x")]


def test_a_line_of_units_below_the_header_is_the_columns_units(tmp_path):
    found = table(tmp_path, "t,x,psi,q\nms,[mm],°,-\n0,1,2,3\n1,2,3,4\n")
    assert found.header == ("t [ms]", "x [mm]", "psi [°]", "q")
    assert found.rows[0] == ("0", "1", "2", "3")
    assert found.dialect.notes == ("the table is read with the units in line 2",)


@pytest.mark.parametrize("line", ["a,b", "s,5", "s,inch", "-,-"])
def test_a_line_that_isn_t_units_is_a_row(tmp_path, line):
    found = table(tmp_path, f"t,x\n{line}\n1,2\n")
    assert found.rows[0] == tuple(line.split(","))


def test_comments_and_headers_as_matlab_writes_them_are_read(tmp_path):
    found = table(tmp_path, "% made in a lab\n% t x\n0 1\n1 2\n")
    assert (found.header, len(found)) == (("t", "x"), 2)
