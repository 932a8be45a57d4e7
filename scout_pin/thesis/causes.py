"""Slips that several printed lines of the Scout thesis share, explained."""

from __future__ import annotations

from thesis_pin.audit.slips import Cause

CAUSES = {
    "reaction-torques": Cause(
        "A_τ: reaction torques forgotten",
        "(4.12)",
        "(4.12) lets each servo's torque work on the whole turn of its own link in space. A servo "
        "turns two links against each other: the equal and opposite torque on the link before "
        "does work as well, and together they do τ δθ of the joint alone. With it left out, servos "
        "push the whole robot about from inside, and A_τ has entries where there should be none.",
    ),
    "constraints": Cause(
        "Φ fixes directions, not feet",
        "(4.15)",
        "The vectors in (4.15) are directions of the foot and have no place in them, so the "
        "constraints hold a foot's orientation but let it slide and fly. The columns of the "
        "torso's x, y, z in their Jacobian are zero, and no ground force can carry the weight; a "
        "foot that stands must fix the place of its sole too.",
    ),
    "columns": Cause(
        "runs of zero columns miscounted",
        "4.1, from the first rows of vectors on",
        "A row of vectors has one column for each of the 18 coordinates, most of them zero. Where "
        "a run of equal zeros is a column short or long, or two lines have run into one, every "
        "column after it belongs to another joint: the right leg's are read as the left one's.",
    ),
    "dots": Cause(
        "dots lost, lines merged",
        "4.3, each line by itself",
        "The derivative of a product puts one dot on one factor of each term. In these lines a dot "
        "is missing, or stands on both factors or on the wrong line; the other lines of the same "
        "family, which differ only in their numbers, have it right.",
    ),
    "dotted-capitals": Cause(
        "dotted capitals read as small",
        "4.3.1",
        "The rates of the matrices J, I and the like stand in the text as the small letters j, i, "
        "which are axes. The line before names what is differentiated, so only the capital with "
        "its dot makes sense there, and with it the line is exact.",
    ),
    "old-frames": Cause(
        "4.3, 4.4: older frames",
        "4.3.2, the rate of R_1i",
        "4.3 differentiates rotations that chapter 3 doesn't have: angles β count from zero and an "
        "extra R_y(β_1i) stands in the first one, as in the program of appendix D. Chapter 3's "
        "frames were redone afterwards and these pages weren't; with (3.7)'s angles they hold.",
    ),
    "ddot-q": Cause(
        "∂q̈/∂q̇_j for ∂q̇/∂q̇_j",
        "4.3, the line before (4.8)",
        "Taking N out as symmetric, the factor before it gets a second dot. Accelerations don't "
        "depend on rates, so ∂q̈/∂q̇_j is zero and, read literally, the whole mass matrix "
        "disappears; the definitions of D after (4.8) repeat it. With one dot it is the row that "
        "picks the jth equation.",
    ),
    "shifted-columns": Cause(
        "∂W: one column too many",
        "4.4.1",
        "The torso's first axis is fixed, so its derivative is the zero vector and its column a "
        "0. These rows write that 0 and the derivative of the axis as well, so the other two axes "
        "of the torso, and all after them, stand one column too far right.",
    ),
    "inertia-reading": Cause(
        "B.6 used as centroidal tensors",
        "4.1, the kinetic energy",
        "4.1 says that the CAD program took the inertias about the joint frames' axes, and then "
        "puts them where the energy needs them about the centres of gravity. The products of "
        "inertia keep the program's sign as well. Read as tensors several of them belong to no "
        "body; as products about the joint all are possible.",
    ),
}
"""Name of each shared slip, as the data give it → what it is."""
