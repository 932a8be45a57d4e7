"""What a sweep varies of a biped, its gait or the walk it is planned for, and what judges it."""
