"""MJCF, compiled by MuJoCo → :class:`thesis_pin.model.description.Description`."""
