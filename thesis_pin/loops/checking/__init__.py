"""What is checked of a robot with loops: its poses, its assembly, what moves and holds it."""
