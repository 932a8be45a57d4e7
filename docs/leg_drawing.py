"""Write docs/images/scout_left_leg.svg: x_0 to y_6 and β_1 to β_8 of the thesis's robot.

Run: python docs/leg_drawing.py
"""

from pathlib import Path

import scout_pin
from scout_pin.report.drawn.drawing import leg_drawing

path = Path(__file__).parent / "images" / "scout_left_leg.svg"
path.write_text(leg_drawing(scout_pin.load(), "left"), encoding="utf-8")
print(f"wrote {path}")
