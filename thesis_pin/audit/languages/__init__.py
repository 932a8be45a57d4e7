"""What the audits say in other languages than English."""
