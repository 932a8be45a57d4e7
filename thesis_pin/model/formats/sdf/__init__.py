"""SDF → :class:`thesis_pin.model.mechanism.description.Description`; its loops are cut."""
