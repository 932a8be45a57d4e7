"""A second engine: any Pinocchio tree as MJCF, stepped and recorded by MuJoCo; drawn errors."""
