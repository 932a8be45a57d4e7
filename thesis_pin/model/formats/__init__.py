"""Formats of models: text → :class:`thesis_pin.model.description.Description`."""
