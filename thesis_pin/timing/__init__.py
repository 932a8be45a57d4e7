"""How fast a path can be followed: limits along it, the fastest law, laws of constant speed."""
