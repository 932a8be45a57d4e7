"""The report's curves, figures, pages and scenes."""
