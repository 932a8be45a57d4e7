"""From LaTeX to nodes: layout, brackets, grammar, scripts, what factors beside each other mean."""
