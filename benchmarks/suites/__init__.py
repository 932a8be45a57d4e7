"""What is measured: each module's ``rows``."""
