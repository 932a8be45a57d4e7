"""The gait report: numbers, servos' limits, verdict, documents, figures, page, animation."""
