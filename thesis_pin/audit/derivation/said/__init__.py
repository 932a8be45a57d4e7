"""What the file of a derivation says: equations, and what their letters stand for."""
