"""Changes with which a failing line would hold are tried in the order of their likelihood."""

from thesis_pin.audit.derivation.mends import _replaced as replaced


def test_a_symbol_gives_way_to_others_of_its_letter_apart_from_those_of_another():
    def tried(alike):
        found = replaced("a_1 b", ["b", "a_2", "a_1"], alike=alike)
        return [" ".join(text.split()) for text in found]

    assert tried(alike=True) == ["a_2 b"]
    assert tried(alike=False) == ["b b", "a_1 a_2", "a_1 a_1"]
