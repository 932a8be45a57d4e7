"""Motions for other programs: tables in any unit, ROS's joint trajectories, servo ticks."""
