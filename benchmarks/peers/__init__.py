"""Who else does the same: Newton on Pinocchio, SciPy, EAIK, MuJoCo."""
