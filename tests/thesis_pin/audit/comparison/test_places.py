"""Where two formulas differ, in words."""

from thesis_pin.audit.comparison.places import places


def test_places_point_at_symbols_and_columns_not_at_layout():
    assert places(r"\mathbf{j}_2 \times \mathbf{r}", r"\dot{\mathbf{j}}_2 \times \mathbf{r}") == [
        r"symbol 1: j_2 should be \dot{j}_2"
    ]
    assert places(r"(a + b", r"(a + b)") == ["symbol 5: ) is missing after b"]
    row = r"\begin{bmatrix} a & 0 & 0 & 0 & 0 & b \end{bmatrix}"
    more = r"\left[\begin{array}{ccccccc} a & 0 & 0 & 0 & 0 & 0 & b \end{array}\right]"
    assert places(row, more) == ["column 6: 0 is missing after 0"]
    assert places(r"\left(a\right)", "(a)") == []


def test_a_place_in_a_matrix_is_its_row_and_column():
    printed = r"\begin{bmatrix} a & 0 \\ b & c \\ & d \end{bmatrix}"
    mended = r"\begin{bmatrix} a & 0 \\ b & e \\ 0 & d \end{bmatrix}"
    assert places(printed, mended) == ["row 2, column 2: c, (empty) should be e, 0"]
    column = r"\begin{bmatrix} a \\ b \\ c \\ d \\ e \end{bmatrix}"
    assert places(column, column.replace("c", "f")) == ["row 3: c should be f"]
    assert places(column, "f") == [r"symbol 1: a \\ b \\ c \\ d \\ e should be f"]


def test_a_greek_subscript_and_a_letter_before_a_bold_one_stay_whole():
    assert places(r"\mathbf{J}_\tau a", r"\mathbf{J}_\tau b") == ["symbol 2: a should be b"]
    assert places(r"\delta\mathbf{q}", r"\delta\mathbf{r}") == ["symbol 2: q should be r"]


def test_a_run_of_equal_cells_is_counted():
    row = r"\begin{bmatrix} a & 0 & 0 & 0 & b \end{bmatrix}"
    assert places(row, row.replace("0", "c")) == ["column 2: 3 × 0 should be 3 × c"]
    assert places(row, row.replace("0", "c", 1)) == ["column 2: 0 should be c"]
