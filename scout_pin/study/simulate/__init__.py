"""A gait on servos, on a floor, in a second engine: does the robot do what its plan says?"""
