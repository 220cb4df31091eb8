"""What the scene's probes measure: columns of the array `probe`, by the probe's kind (messages.proto, Frame)."""

import numpy as np

FORCES = {"force_x": "N", "force_y": "N", "force_z": "N", "moment_x": "N m", "moment_y": "N m", "moment_z": "N m"}
# Columns and their units; forces and moments are per metre of depth in two dimensions.
COLUMNS = {
    "point": {"pressure": "Pa", "velocity_x": "m/s", "velocity_y": "m/s", "velocity_z": "m/s", "wetness": "1"},
    "surface": {"height": "m"},
    "force": FORCES,
    "flow": {"rate": "kg/s", "mass_in": "kg", "mass_out": "kg"},
}


def columns(kind, rows):
    """The rows [..., 6] of a probe by column, each [...]; a height where there is no liquid is NaN."""
    rows = np.asarray(rows)
    if kind == "surface":
        return {"height": np.where(rows[..., 1] > 0, rows[..., 0], np.nan)}
    return {column: rows[..., c] for c, column in enumerate(COLUMNS[kind])}
