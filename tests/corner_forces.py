"""What forces at a sole's corners can do, by linear programming: an oracle for wrench cones."""

import numpy as np
from scipy.optimize import linprog


def linear_programme_admits(contact, wrench):
    """Independent membership test: forces at the hull's corners by linear programming."""
    forces, columns = [], []
    for x, y in contact.hull:
        for k in range(8):
            angle = 2 * np.pi * k / 8
            force = np.array(
                [contact.friction * np.cos(angle), contact.friction * np.sin(angle), 1.0]
            )
            forces.append(force)
            columns.append(np.concatenate([force, np.cross([x, y, 0.0], force)]))
    matrix = np.array(columns).T
    return linprog(np.ones(matrix.shape[1]), A_eq=matrix, b_eq=wrench, method="highs").status == 0
