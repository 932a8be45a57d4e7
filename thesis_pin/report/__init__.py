"""What torque reports share: summaries, branches, writers, figures."""
