"""Tables as people have them: dialects, columns with units and resolutions, and writing them."""
