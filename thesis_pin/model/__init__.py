"""Single robots, read and written: specifications, samples, inertias, URDFs, models."""
