"""The closed form of a leg: stacks of foot poses, one pose, and poses that leave a value free."""
