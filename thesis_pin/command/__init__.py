"""What the three commands share: parsing, output, progress, common verbs."""
