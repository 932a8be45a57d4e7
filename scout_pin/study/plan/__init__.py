"""Planning a walk: limits of sampled motions with their derivatives, cycles that keep them."""
