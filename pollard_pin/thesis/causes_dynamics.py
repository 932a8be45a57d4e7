"""Slips that several lines of chapter 3 share: what they are and where they enter."""

from __future__ import annotations

from thesis_pin.audit.slips import Cause

DYNAMICS = {
    "offset-along-x": Cause(
        "3.4: z_32i along the x axis",
        "3.4, the components of r_32i",
        "(2.89) lowers a side chain's arm by z_32i along z. Chapter 3 and appendix A write the "
        "same vector with that length along x. There it would turn with the arm and move, where "
        "the real one keeps its place on the axis of θ21i.",
    ),
    "lost-centre": Cause(
        "(3.22): a lever without r_G3'",
        "(3.22), member 5",
        "The shoulder's turn carries body 3 along on a lever that ends in its centre of gravity, "
        "r_G3' beyond the wrist. From the fifth member of (3.22) on, this last part is missing "
        "from what θ̇21 multiplies, though the other angles keep it. k_8, its derivatives and the "
        "J_8 made of them inherit it.",
    ),
    "dotted-J": Cause(
        "J̇ printed as a dotted axis j",
        "3.3.1, the rate of J_1",
        "The rate of an inertia, J with a dot, stands in the text as a small j with one, which is "
        "an axis. The formula beside it is the derivative of R J Rᵀ, a matrix, so only the capital "
        "makes sense.",
    ),
    "lost-dots-3": Cause(
        "3.3, 3.5: dots out of place",
        "3.3.1, the rate of M_4",
        "Each term of a derivative has its dot on one factor. Here it is lost, or stands on an "
        "axis that doesn't move, or both terms of a product have it on the same factor. The other "
        "lines of the same family have it right.",
    ),
    "both-dotted": Cause(
        "3.3.1: both factors dotted",
        "3.3.1, the rate of k_15",
        "The rate of a vector product has two terms, with the dot once on the first factor and "
        "once on the second. In the first terms of these two lines both factors carry one: a "
        "product of two rates stands where one rate belongs.",
    ),
    "dotted-axis": Cause(
        "3.3.1: a dot on a fixed axis",
        "3.3.1, the rate of k_19",
        "j_1 and j_3 are the base's own y axis, so their rates are zero. With the dot on them the "
        "lines for k_19 and k_20 vanish; the rate lies in the vectors that the axes multiply.",
    ),
    "reused-J": Cause(
        "J_n, V_n: names used twice",
        "(3.79)",
        "J_1 to J_5 are the bodies' inertias, V_1 to V_6 coefficients of 2.5. From (3.79) on the "
        "same letters also name the derivatives of k_1 to k_5 by the angles, and in 3.7 the rows "
        "of the stacked equations. No program can hold both; the corrections give the second "
        "ones a name of their own.",
    ),
    "thin-theta": Cause(
        "the vector θ printed light",
        "each line by itself",
        "Bold θ is the column of θ21, θ43, θ54, light θ the tool's turn about x. Where the bold is "
        "lost, a matrix of three columns is multiplied by the derivative of a single angle, and of "
        "the wrong one.",
    ),
    "row-columns": Cause(
        "(3.80): rows put as columns",
        "(3.80)",
        "k_2 and its like are transposed, rows of six numbers, and their derivatives by three "
        "angles are set side by side as if they were columns. The product with the three angles' "
        "derivatives then has no fitting shape. With columns in the matrix and the product "
        "transposed it has, and is right.",
    ),
    "chain-rule": Cause(
        "3.3.2: chain rule cut short",
        "3.3.2, the derivative of k_18",
        "The rows k are quotients of coefficients that contain the pose and every angle before "
        "them. These lines differentiate by some of the angles only, or leave out the pose itself, "
        "which k_2, k_6 and k_7 have as a separate k'.",
    ),
    "R-for-B": Cause(
        "3.3.2: R_y for B_y of θ43",
        "3.3.2, the derivative of k_5",
        "To differentiate a product of rotations one factor at a time is replaced by its "
        "derivative B. In the terms by θ43 of these lines R_y has stayed, so nothing is "
        "differentiated; the terms by θ21 and θ54 beside them are right.",
    ),
    "turned-twice": Cause(
        "3.3.2: an axis turned twice",
        "3.3.2, the derivative of k_16",
        "R_16 turns an axis from its own frame, where it is a constant, into the base's. Here it "
        "is applied to the axis that already is in the base's: the superscript 0 should be that of "
        "its own frame.",
    ),
    "open-brackets": Cause(
        "a sum without its bracket",
        "3.3.2, the derivative of k_19",
        "Several terms belong to one angle, or to one sum, and are multiplied together. Without "
        "the bracket around them only the nearest one is.",
    ),
    "twice-V1": Cause(
        "3.7: V'_1j twice, V'_2j never",
        "3.7, the line before (3.153)",
        "When ∂L/∂q_j is put in, V'_1j is taken off twice and V'_2j not at all. The velocity "
        "terms of the upper arm then count double and those of the forearm are lost.",
    ),
    "chain-number": Cause(
        "3.6: k_2i read as k_21",
        "3.6, δQ_2",
        "k_2i and ω_2i belong to a side chain. With its number put in they read k_21, k_22 and "
        "ω_21, which chain 0 uses for other vectors: J_τ would be made of levers of centres of "
        "gravity. In the corrections the chain's number stands in brackets.",
    ),
    "three-motors": Cause(
        "(3.154): 3 torques, 6 equations",
        "3.7, the line before (3.154)",
        "J_τ has a row for each of the three base motors and six columns, one a coordinate: it has "
        "no inverse, and three torques can't answer six generalized forces. The wrist's three "
        "motors do no virtual work in 3.6, though 1.8 names them. With all six the matrix is "
        "square and the inversion is right.",
    ),
}
"""Name of each shared slip of chapter 3, as the data give it → what it is."""
