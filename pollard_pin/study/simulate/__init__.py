"""A path's torques replayed on the closed robot by an engine, open loop or under joint servos."""
