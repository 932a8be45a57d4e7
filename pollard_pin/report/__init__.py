"""The trajectory report: numbers, motors' limits, documents, figures, page, animation."""
