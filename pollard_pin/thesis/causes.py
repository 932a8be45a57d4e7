"""Slips that several printed lines share: what they are and where they enter.

Each explanation that can be computed is: ``tests/pollard_pin/thesis/test_causes.py``
follows the slip by an independent route and finds the printed lines.
"""

from __future__ import annotations

from pollard_pin.thesis.causes_dynamics import DYNAMICS
from thesis_pin.audit.slips import Cause

CAUSES = {
    "axis-index": Cause(
        "2.1: θ_x, θ_y, θ_z for θ",
        "2.1",
        "The three rotations are introduced as functions of θ_x, θ_y, θ_z, and their matrices are "
        "those of θ. The index only says about which axis one turns; the rest of the thesis puts "
        "its angles in without it.",
    ),
    "base-frame": Cause(
        "(2.20): X, Z in the base frame",
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
        "a side chain's 1 on chain 0",
        "(2.9)",
        "Lengths and angles of chain 0 carry a 1 at their end that belongs to a side chain, as "
        "chapter 4 still lists x_1514 and x_1918 once for chain 1 and once for chain 2. They look "
        "like remains of a notation that repeated the end of chain 0 for each side chain. No "
        "symbol of that name is defined where it is used; without the 1 the lines hold.",
    ),
    "whole-matrices": Cause(
        "open loops equated as matrices",
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
        "term of θ̇21 is subtracted, as in an earlier draft of (2.58). As printed, "
        "what multiplies ẋ contains the denominator itself, and what multiplies ẏ the "
        "coefficient of ẋ.",
    ),
    "lost-arguments": Cause(
        "2.8: c, s without their bracket",
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
        "brackets lost in long lines",
        "each line by itself",
        "Opening and closing brackets don't balance, or close one factor too early, in lines of "
        "a dozen products and more. With the brackets put back they are exact (one has a wrong "
        "letter besides), so the derivation is right; a reader who types them in meets an error, "
        "or a sum where a product is meant.",
    ),
    "ball-frame": Cause(
        "A: base 11i turned backwards",
        "R_11i after (A.4)",
        "(2.89) goes from the forearm to a ball joint by turning −β1413i; appendix A writes the "
        "same bases with +β1413i. It also gives the last vector its components in base 5 (the "
        "superscript) and turns them on by β1413i as if they were those in base 11i. The anchors "
        "come out on the other side of the forearm, and so does all that is differentiated from "
        "them.",
    ),
    "minus-twice": Cause(
        "A: vectors taken off twice",
        "the components after (A.1) and (A.4)",
        "The loop equations (A.1) and (A.4) subtract the nozzle and the two anchor vectors. Their "
        "components are then printed negative as well, so that the way back becomes a way on: "
        "with them the loops don't close. The derivation goes on with the vectors' names and "
        "isn't touched by it.",
    ),
    "one-letter": Cause(
        "A: columns I, J, K, L mixed up",
        "the line before (A.6)",
        "The six columns of the side chain's loop are called r_G to r_L. Capital I and small l "
        "look alike, so the column of θ76i carries the name of that of θ54, and the definitions "
        "have small letters that nothing else uses. Named in order, the lines are exact.",
    ),
    "scanned-letters": Cause(
        "letters misread in long lines",
        "each line by itself",
        "In the longest lines some letters carry a dot too many or too few, an index is another, "
        "or a sine stands for a cosine, with no pattern from line to line. The same terms are "
        "right in the equations these lines are put together from, so they were lost on paper or "
        "in reading it, not in the derivation.",
    ),
    **DYNAMICS,
}
"""Name of each shared slip, as the data give it → what it is."""
