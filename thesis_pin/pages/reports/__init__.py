"""Pages of the reports on any robot: torques, balance, workspace, what a robot is."""
