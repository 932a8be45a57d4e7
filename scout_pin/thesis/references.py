"""What each symbol of the thesis must equal, computed without its formulas.

Geometry comes from :mod:`scout_pin.thesis.state`: products of elementary
transforms, differentiated factor by factor. From these follow, by definition
and not by the thesis's derivations:

========================  ====================================================
symbol                    reference
========================  ====================================================
i, j, k with frame        column of a frame's rotation, or axis of ∂R/∂q Rᵀ
r, b                      differences of frame origins; centres of mass
v, a, ω, α                their time derivatives; axis of Ṙ Rᵀ and its derivative
u, e, J, W                columns ∂p_i/∂q, ∂b/∂q of Jacobians; axes
x_i, y_i                  Σ Ω̇ r and Σ Ω² r with Ω = Ṙ Rᵀ
D, V, C, N                :mod:`thesis_pin.equations.lagrangian` on those Jacobians
A_τ, δW                   power of the joint torques, τ·θ̇
p_ZMP                     balance of moments of all bodies' inertial forces
========================  ====================================================

A dot not listed is a complex step in time, ∂/∂q_j one along the coordinates.
"""

from __future__ import annotations

from scout_pin.thesis.symbols.forces import Forces


class References(Forces):
    """The reference environment: every symbol at a batch of states."""
