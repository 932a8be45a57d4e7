"""Printed equations as data: notation, formulas, values, exact derivatives."""
