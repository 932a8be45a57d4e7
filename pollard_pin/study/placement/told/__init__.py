"""What is told of placements: sentences, tables, figures, page, JSON."""
