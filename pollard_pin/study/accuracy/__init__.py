"""How errors of lengths, angles, play and motors reach the spray tip, and which matter most."""
