"""What :mod:`scout_pin.study.plan.samples` is made of: states, soles on the floor, derivatives."""
