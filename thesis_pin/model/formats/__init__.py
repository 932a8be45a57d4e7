"""Formats of models: text → :class:`thesis_pin.model.mechanism.description.Description`."""
