"""Any sole on the floor: what it can carry, and where the load acts."""
