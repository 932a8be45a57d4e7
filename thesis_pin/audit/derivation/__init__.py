"""Anyone's derivation audited: a file of printed equations, and a robot they are about."""
