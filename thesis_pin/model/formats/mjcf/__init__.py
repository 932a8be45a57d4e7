"""MJCF, compiled by MuJoCo → :class:`thesis_pin.model.mechanism.description.Description`."""
