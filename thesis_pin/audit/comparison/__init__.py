"""What differs between a printed formula and its correction: tokens, places, kinds of slips."""
