"""How the Scout thesis writes: its functions and its words of several letters."""

from __future__ import annotations

from thesis_pin.equations.evaluation import FUNCTIONS
from thesis_pin.equations.notation import Notation

NOTATION = Notation(
    functions=FUNCTIONS,
    words=("ZMP", "b1", "b2", "ai"),
    # A number above these is a label (the interval T_k, the foot), not a power.
    labelled=frozenset({"varphi", "lambda", "Gamma", "Phi", "omega", "alpha", "e", "i", "j", "k"}),
)
