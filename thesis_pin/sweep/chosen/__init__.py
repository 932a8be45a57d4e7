"""Which designs are best: by several aims at once, and by a wish."""
