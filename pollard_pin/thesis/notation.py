"""How the Pollard thesis writes: its functions, words, labels and what each chain has."""

from __future__ import annotations

from thesis_pin.equations.evaluation import FUNCTIONS
from thesis_pin.equations.notation import Notation

NOTATION = Notation(
    functions=FUNCTIONS,
    words=("signo", "Ec"),
    # A number above these is a frame, bold or not.
    labelled=frozenset("ijkrJ"),
    # What chapter 3 numbers anew for the side chains.
    chains=frozenset({*"kmJKLMNUVE", "omega", "bb:D", "bb:V", "bb:C"}),
)
