"""URDF and URDF+ → :class:`thesis_pin.model.mechanism.description.Description`."""
