"""Whether `cleancolor replan --order keep --travel keep` gives a file's own moves back.

Takes the files of `scripts/bench replan`, every variant. The moves of both files are compared one by one by this script's own
reader: place, filament and tool; of the height alone where the nozzle prints. Exit code 1 where something differs.
"""

import argparse
import sys
from pathlib import Path

import models
from judge import two_at_a_time
from peers import require_shared, sliced
from replan import SLICERS, files, moves, replanned

FILAMENT_MM = 2e-5  # rounded to 1e-5 mm


def told(gcode):
    """[(tool, x, y, height of a road, arc, filament in mm, line)] of each move that drives or feeds."""
    found = []
    for tool, _, at, to, fed, code, center, line in moves(gcode):
        drives = to["X"] != at["X"] or to["Y"] != at["Y"]
        if drives or abs(fed) > FILAMENT_MM / 2:
            arc = (code, *center) if code in "23" else None
            found.append((tool, to["X"], to["Y"], to["Z"] if drives and fed > 0 else None, arc, fed, line))
    return found


def alike(a, b):
    return a[:5] == b[:5] and abs(a[5] - b[5]) <= FILAMENT_MM


def differences(before, after):
    """How many places differ, and a sentence on the first."""
    old, new, i, k, places, first = told(before), told(after), 0, 0, 0, ""
    while i < len(old) and k < len(new):
        if alike(old[i], new[k]):
            i, k = i + 1, k + 1
            continue
        places += 1
        first = first or f"line {old[i][6]}: {old[i][:6]} became {new[k][:6]} in line {new[k][6]}"
        step = next(((a, s - a) for s in range(1, 60) for a in range(s + 1)
                     if all(i + a + n < len(old) and k + s - a + n < len(new) and alike(old[i + a + n], new[k + s - a + n])
                            for n in range(3))), None)
        if step is None:
            return places, first + "; from there on all differs"
        i, k = i + step[0], k + step[1]
    left = len(old) - i + len(new) - k
    return places + left, first or (f"{left} moves at the end" if left else "")


def row(program, name, slicer, variant):
    """One row of the table, and what does not hold of it."""
    gcode = sliced(program, name, slicer, variant)
    title = f"{name}, {SLICERS[slicer]} {variant}"
    kept, _, reason = replanned(program, gcode, variant, "--order", "keep", "--travel", "keep")
    if not kept:
        return f"| {title} | left as it is: {reason} |", [f"{title}: {reason}"]
    places, first = differences(gcode, kept)
    kept.unlink()
    faults = [f"{title}: {places} places differ, the first in {first}"] if places else []
    return f"| {title} | {places} |", faults


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench round-trip", description=__doc__)
    parser.add_argument("--models", default=",".join(models.PAIRS), help="comma-separated, of: " + ", ".join(models.PAIRS))
    parser.add_argument("--program", type=Path, help="our program (default: the release build, made first)")
    options = parser.parse_args()
    models.require(options.models, models.PAIRS, "scripts/bench round-trip")
    require_shared("scripts/bench round-trip")
    rows = [(options.program, *file) for file in files(options.models.split(","), every_variant=True)]
    failures = []
    print("| file | places that differ |", "|---|---|", sep="\n")
    for text, faults in two_at_a_time(row, rows):
        print(text, flush=True)
        failures += faults
    print(*failures, sep="\n")
    print(f"{len(rows)} files, {len(failures)} bars fail" if failures else f"{len(rows)} files; all bars hold")
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
