"""Slips that several printed lines share: what they are and where they enter.

Each explanation that can be computed is: ``tests/pollard_pin/test_thesis_causes.py``
follows the slip by an independent route and finds the printed lines.
"""

from __future__ import annotations

from thesis_pin.causes import Cause

CAUSES = {
    "axis-index": Cause(
        "2.1: θ with an axis for its index, left only",
        "2.1",
        "The three rotations are introduced as functions of θ_x, θ_y, θ_z, and their matrices are "
        "those of θ. The index only says about which axis one turns; the rest of the thesis puts "
        "its angles in without it.",
    ),
    "base-frame": Cause(
        "(2.20): X, Z in the base frame, used in frame 3",
        "(2.12), kept by (2.20); for the side chains (2.138)",
        "Equation (2.3) turns the wrist's place into frame 3, which swings with the arm's θ21, and "
        "(2.18) needs it there: θ43 is counted from the arm. (2.12) prints the plain differences "
        "in the base's axes instead, so −Z/X is the tangent of θ21 + θ43, and whatever is "
        "differentiated from that X and Z takes the arm for fixed in direction. The side chains' "
        "places (2.100) are in turned axes, but their rates (2.138) are again those in the base's.",
    ),
    "half-circle": Cause(
        "arctan keeps half the circle",
        "(2.19)",
        "A quotient forgets the signs of its two parts, so a plain arctan can't tell an angle from "
        "the one half a turn away and always answers between −90° and 90°. Beyond that the joint "
        "comes out pointing backwards. The two-argument arctangent with both signs, and the choice "
        "of a branch, give the angle.",
    ),
    "stray-index": Cause(
        "a side chain's index left on chain 0",
        "(2.9)",
        "Lengths and angles of chain 0 carry a 1 at their end that belongs to a side chain, as "
        "chapter 4 still lists x_1514 and x_1918 once for chain 1 and once for chain 2. These are "
        "remains of a notation that repeated the end of chain 0 for each side chain. No symbol of "
        "that name is defined where it is used; without the 1 the lines hold.",
    ),
    "whole-matrices": Cause(
        "loops without ball or wrist joint, as matrices",
        "(2.2) and (2.89)",
        "The loop is cut at the wrist, or at the ball joint of a side chain, whose turns appear on "
        "neither side. Cut there, both sides end in the same point but not in the same "
        "orientation: twelve equations where only three hold. (2.3) and (2.90) then use just "
        "the last column, the place, which is right.",
    ),
    "one-for-i": Cause(
        "2.7.4: θ21i written for θ21",
        "(2.115), and V_44",
        "The shoulder of chain 0 (θ21) and that of a side chain (θ21i) differ by one letter and "
        "occur side by side in these products. Where one stands for the other, a turn of the "
        "wrong shoulder enters; V_59 and (2.132), made of the same elements, have the right one.",
    ),
    "shifted-V": Cause(
        "(2.60): V numbered one too low",
        "(2.60)",
        "(2.58) numbers the denominator V_15 and the seven coefficients after it V_16 to V_22, but "
        "(2.60) puts θ̇21 and θ̇43 into an expression where the count starts one lower and the "
        "term of θ̇21 is subtracted: it was made with an earlier draft of (2.58). As printed, "
        "what multiplies ẋ contains the denominator itself, and what multiplies ẏ the "
        "coefficient of ẋ.",
    ),
    "lost-arguments": Cause(
        "2.8: c and s of a sum without its bracket",
        "(2.133)",
        "When cos(a − b) was shortened to c, its bracket went as well, so that c β1413i − θ54 "
        "stands for c(β1413i − θ54): an angle is subtracted from a cosine. In (2.133) the terms of "
        "the sum that were left over even carry dots.",
    ),
    "lost-dots": Cause(
        "2.5: rates without their dots",
        "(2.62)",
        "Every term of a derivative has exactly one rate in it. In these lines some rates have "
        "lost their dot, so that an angle stands where its rate belongs, and a bracket with it; "
        "the same rates have their dots in the lines above and below.",
    ),
    "scanned-brackets": Cause(
        "brackets lost or added in long lines",
        "each line by itself",
        "Opening and closing brackets don't balance, or close one factor too early, in lines of "
        "a dozen products. With brackets alone put back each of them is exact, so nothing of the "
        "derivation is wrong; a reader who types them in meets an error, or a sum where a product "
        "is meant.",
    ),
    "lost-centre": Cause(
        "3.2.5: body 3 without its centre of gravity",
        "(3.22), fifth member",
        "The velocity of a centre of gravity sums each joint's rate times the whole lever from "
        "that joint to the centre. When the terms of ω_21 are gathered in (3.22), the last piece "
        "of its lever, r_G3', is dropped, though ω_43 and ω_54 keep it. k_8 and all that is "
        "differentiated from it inherit a lever that ends at the wrist. A centre of gravity in "
        "the wrist's middle hides the slip.",
    ),
    "offset-along-x": Cause(
        "3.4: the arm's offset −z_32i put on x",
        "3.4, r_32i in frame 2i",
        "(2.89) lowers the arm by z_32i along the shoulder's own axis, which moves no point when "
        "the shoulder turns. Chapter 3 writes the same length in the first component, along the "
        "arm: every velocity of the two side chains then has a lever that is shorter by z_32i.",
    ),
    "chain-rule": Cause(
        "3.3.2, 3.5.2: chain rule without all its variables",
        "(3.99), (3.108) and (3.138)",
        "A k is a formula in the pose and in several angles. For k_2, k_6 and k_7 the thesis adds "
        "∂k'/∂q_j, what the pose changes while the angles are held; for k_25 and the side chains' "
        "k_2i, k_6i, k_7i it forgets it, and for k_18 the angles θ1716 and θ1817. The rows above, "
        "which differentiate the V and E themselves, have everything.",
    ),
    "three-motors": Cause(
        "3.7: a 3×6 matrix is inverted",
        "(3.154)",
        "Q = J_τᵀ τ gives six generalized forces from three torques, so no inverse of J_τᵀ exists: "
        "a force in any direction needs six motors, and the robot has them, three at the base and "
        "three in the wrist. The virtual work (3.146) leaves the wrist's motors out.",
    ),
    "row-columns": Cause(
        "3.3.2, 3.5.2: rows set side by side as columns",
        "(3.80)",
        "J_2 collects the derivatives of the row k_2ᵀ by three angles. Rows side by side make one "
        "row of eighteen; what is meant are the columns ∂k_2/∂θ, and the product with ∂θ/∂q_j is "
        "then a column, the transpose of the left side. J_6, J_7, J_18, J_25 and those of the side "
        "chains are written the same way.",
    ),
    "reused-J": Cause(
        "one letter for two things: J, V",
        "(3.79), (3.153)",
        "J_1 … J_5, J_1i and J_2i are inertias in the Lagrangians and, a page on, matrices of "
        "derivatives; V_1 … V_6 are coefficients in chapter 2 and rows of V in 3.7. Read with the "
        "meaning given first, the lines multiply an inertia where a derivative is meant. In the "
        "corrections the matrices of derivatives are called J_θ1 and so on.",
    ),
    "chain-number": Cause(
        "3.6: k_2i and ω_2i with i put in",
        "(3.148)",
        "With i = 1 the side chain's k_2i and ω_2i become k_21 and ω_21, which chain 0 has used "
        "already, for a vector of body 5 and for the shoulder's own turn. In the corrections the "
        "chain's number stands in brackets: k_2(1).",
    ),
    "twice-V1": Cause(
        "3.7: V'_1j twice, V'_2j never",
        "3.7, second form of the sum",
        "Moving −∂L/∂q_j into the bracket of q̇ copies V'_1j into the place of V'_2j: body 2, the "
        "heaviest, loses half of its velocity terms and body 1 has them too often. (3.153) and the "
        "definition of V_j repeat it.",
    ),
    "R-for-B": Cause(
        "3.3.2: R_y where its derivative B_y belongs",
        "(3.85)",
        "Differentiating R_y(θ21) R_y(θ43) k_4 by θ43 replaces the second matrix by its derivative "
        "B_y. For the axis k_4 the letter stays R, though in the other factor of the same term it "
        "is changed; in two of the lines the axis is given in the base frame as well, and so is "
        "turned twice.",
    ),
    "turned-twice": Cause(
        "an axis in the base frame turned once more",
        "3.3.2, ∂k_16/∂q_j",
        "k_16 in the base frame is R_16 times the constant k_16 of frame 16; its derivative is the "
        "derivative of R_16 times that constant. With the superscript 0 the axis has been turned "
        "already and is turned again.",
    ),
    "dotted-J": Cause(
        "a dotted J read as j",
        "3.3.1, Ṅ_1",
        "The derivatives of the inertias in the base frame are printed with a dot above the J. The "
        "text has a j instead, the letter of an axis, with or without the dot; the formula beside "
        "it is that of J̇.",
    ),
    "lost-dots-3": Cause(
        "3.3.1, 3.5.1: a product's derivative without its dot",
        "3.3.1, Ṁ_4",
        "The derivative of a product has two terms with one dot each. In these lines a dot is "
        "missing or stands on the neighbour, so that a term is not differentiated at all; the "
        "same products have their dots for the other bodies.",
    ),
    "both-dotted": Cause(
        "3.3.1: both factors dotted",
        "3.3.1, k̇_15",
        "In the first term of the derivative of a cross product only the axis is differentiated. "
        "Here the lever beside it carries dots too, as it does in the second term.",
    ),
    "dotted-axis": Cause(
        "3.3.1: a dot on an axis that doesn't move",
        "3.3.1, k̇_19",
        "j_1 and j_3 are the base's y axis and constant. With a dot they are zero, and with them "
        "the only term there is; bodies 2 to 4 have no dot there.",
    ),
    "thin-theta": Cause(
        "the vector θ printed like the angle θ",
        "(3.79)",
        "Bold θ collects θ21, θ43 and θ54; thin θ is an angle of the tool. Where the bold type is "
        "lost, a matrix with three columns is multiplied by one number.",
    ),
    "open-brackets": Cause(
        "a factor behind the last of several terms",
        "(3.146), 3.3.2, ∂k_19/∂q_j",
        "Several terms belong to one factor or one sum, and the bracket around them is missing: "
        "read as printed, only the last (or the first) of them has it.",
    ),
}
"""Name of each shared slip, as the data give it → what it is."""
