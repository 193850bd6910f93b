"""Plastic that a G-code file lays down, in mm3, per tool and per ;TYPE: comment.

Only moves that extrude on the way count, so that retraction and priming cancel out. Skirt, brim, prime lines and what
custom G-code extrudes are told apart by their type and left out of plastic_per_tool.

    python3 bench/plastic.py FILE.gcode      prints the table
"""

import math
import re
import sys
from collections import defaultdict

NOT_THE_PART = {"Skirt/Brim", "Skirt", "Brim", "Custom", "Prime", "Wipe tower", ""}
WORD = re.compile(r"([XYZE])(-?\d*\.?\d+)")


def plastic(file, filament_diameter_mm=1.75):
    """{(tool, type): mm3}.  Understands G0-G3, G92, M82, M83, T<n> and the tool changes of Replicators, M108 T and M135 T."""
    area_mm2 = math.pi / 4 * filament_diameter_mm**2
    laid_mm = defaultdict(float)
    tool, kind, e_mm, relative = 0, "", 0.0, False
    tool_change = re.compile(r"(?:M108 |M135 )?T(\d+)")
    with open(file, errors="replace") as lines:
        for line in lines:
            if line.startswith(";"):
                if line.startswith(";TYPE:"):
                    kind = line[6:].strip()
                continue
            if line.startswith(("G0 ", "G1 ", "G2 ", "G3 ")):
                if "E" not in line:
                    continue
                words = dict(WORD.findall(line.split(";", 1)[0]))
                if "E" not in words:
                    continue
                step_mm = float(words["E"]) if relative else float(words["E"]) - e_mm
                e_mm = 0.0 if relative else float(words["E"])
                if step_mm > 0 and ("X" in words or "Y" in words):
                    laid_mm[tool, kind] += step_mm
            elif line.startswith("G92"):
                words = dict(WORD.findall(line))
                e_mm = float(words.get("E", 0 if not words else e_mm))
            elif line.startswith("M82"):
                relative = False
            elif line.startswith("M83"):
                relative = True
            elif change := tool_change.match(line):
                tool = int(change[1])
    return {key: length * area_mm2 for key, length in laid_mm.items()}


def plastic_per_tool(by_tool_and_type):
    """{tool: mm3} of the printed part alone."""
    total = defaultdict(float)
    for (tool, kind), volume in by_tool_and_type.items():
        if kind not in NOT_THE_PART:
            total[tool] += volume
    return dict(total)


if __name__ == "__main__":
    for (tool, kind), volume in sorted(plastic(sys.argv[1]).items()):
        print(f"T{tool}  {kind:<24} {volume:10.1f} mm3")
