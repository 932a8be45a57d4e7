"""SDF → :class:`thesis_pin.model.description.Description`; its loops are cut."""
