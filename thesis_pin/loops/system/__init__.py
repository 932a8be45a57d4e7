"""The equations of closed loops as linear algebra: rows, scales, rank, closing steps, shares."""
