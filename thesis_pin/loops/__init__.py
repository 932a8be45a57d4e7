"""Any robot with closed loops: closure files, configurations, inverse and forward dynamics."""
