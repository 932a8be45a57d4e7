"""The smallest servos for a gait at any speed, or for a walking speed."""
