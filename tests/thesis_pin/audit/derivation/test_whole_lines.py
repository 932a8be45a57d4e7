"""Lines printed whole, "a = b", and what is said of symbols that can't be looked up."""

from pathlib import Path

import pytest

from thesis_pin import audit_derivation
from thesis_pin.errors import BadInput

FOLDER = Path(__file__).parents[4] / "examples" / "your_derivation"
RIGHT = r"(J + m \ell^2) \ddot\theta - m \ell \ddot x \cos\theta - m g \ell \sin\theta"
WRONG = RIGHT.replace("cos", "sin")
TAU = r"\tau_\theta"
WHY = "attribution = 'thesis'\nwhy = 'Lagrange'\n"


@pytest.fixture
def audited(tmp_path):
    """Audits a line of the cart-pole, given as TOML."""

    def audit(said, *changes):
        text = (FOLDER / "cart_pole.toml").read_text(encoding="utf-8").split("[[equation]]")[0]
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "mine.toml"
        path.write_text(f"{text}[[equation]]\nid = 'cartpole:1:e'\n{said}", encoding="utf-8")
        (row,) = audit_derivation(path, FOLDER / "cart_pole.urdf", with_effects=False).rows
        return row

    return audit


@pytest.mark.parametrize(
    "printed",
    [
        f"{RIGHT} = {TAU}",
        f"{TAU} = {RIGHT} = {TAU}",
        rf"\begin{{aligned}} {TAU} &= {RIGHT} \\ &= {TAU} \end{{aligned}}",
    ],
)
def test_a_line_printed_whole_has_its_sides(printed, audited):
    assert audited(f"printed = '''{printed}'''\n").verdict == "holds"


def test_the_first_index_of_a_sum_is_no_side(audited):
    row = audited(r"printed = 'U = \sum_{i=1}^{2} \frac12 m g \ell \cos\theta'")
    assert (row.left, row.verdict) == ("U", "holds")


@pytest.mark.parametrize(
    ("said", "place"),
    [
        (f"printed = '{TAU} = {WRONG}'\ncorrected = '{RIGHT}'\n", "symbol 14"),
        (f"printed = '{TAU} = {WRONG}'\ncorrected = '{TAU} = {RIGHT}'\n", "symbol 14"),
        (f"printed = '{WRONG} = {TAU}'\ncorrected = '{RIGHT} = {TAU}'\n", "left side, symbol 14"),
        (f"printed = ['{TAU}', '{WRONG}']\ncorrected.2 = '{RIGHT}'\n", "symbol 14"),
        (f"printed = ['{WRONG}', '{TAU}']\ncorrected.1 = '{RIGHT}'\n", "left side, symbol 14"),
        (f"left = '{TAU}'\nprinted = '{WRONG}'\ncorrected = '{RIGHT}'\n", "symbol 14"),
    ],
)
def test_corrections_of_a_whole_line_are_counted_as_it_is_printed(said, place, audited):
    row = audited(said + WHY)
    assert row.verdict == "misprint"
    assert row.places == (rf"{place}: \sin should be \cos",)


@pytest.mark.parametrize(
    ("printed", "told"),
    [
        (TAU, "printed whole, as a = b"),
        (f"= {RIGHT}", "printed whole, as a = b"),
        (f"{TAU} = ", "nothing is printed there"),
        (f"{TAU} = {RIGHT}) = {TAU}", "can't be read (cartpole:1:e)"),
    ],
)
def test_a_whole_line_with_a_side_missing_is_refused(printed, told, audited):
    with pytest.raises(BadInput) as error:
        audited(f"printed = '{printed}'\n")
    assert told in str(error.value)


@pytest.mark.parametrize(
    ("printed", "told"),
    [
        (r"F = \hat{k}_1", r"the symbol \hat{k}_1 isn't defined anywhere"),
        (r"F = \hat{\imath}", r"the symbol \hat{\imath} isn't defined anywhere"),
        (r"F = \mathcal{L}", r"the symbol \mathcal{L} isn't defined anywhere"),
        (r"F = m_i", "(if i counts, say so in the header: indices = { i = [1, 2] })"),
        (r"F = Q_k", "(if k counts, say so in the header: indices = { k = [1, 2] })"),
        (
            r"F = \frac{\partial T}{\partial \dot{q}_i}",
            "by q_i, which isn't a coordinate (if i counts",
        ),
    ],
)
def test_a_symbol_without_meaning_says_what_may_be_missing(printed, told, audited):
    numbered = ("'m' = \"250 g\"", "'m_1' = 1\n'm_2' = 2")
    vectors = ("'\\mathcal{D}' = \"mass matrix\"", "'Q' = 'torque'\n'q' = 'coordinates'")
    assert told in audited(f"printed = '{printed}'\n", numbered, vectors).reason


def test_bars_are_a_size_a_length_or_a_determinant(audited):
    line = r"\left|x\right|^2 \left|\dot{\mathbf{q}}\right|^2 \left|\mathcal{D}\right|"
    same = r"x^2 (\dot x^2 + \dot\theta^2) \det\mathcal{D}"
    vector = ("'\\tau_\\theta'", "'\\mathbf{q}' = 'coordinates'\n'\\tau_\\theta'")
    assert audited(f"printed = '{line} = {same}'\n", vector).verdict == "holds"
    rate = r"\frac{d}{dt}(\left|x\right|) = \frac{x \dot x}{\lvert x\rvert}"
    assert audited(f"printed = '{rate}'\n").verdict == "holds"
