"""What `cleancolor audit` says of a G-code file, and what of it the scripts read.

A judgement is the audit's JSON of one file with --sensitivity, without layers and places. Those of other slicers' files are
kept beside the file, and used again as long as the file and our program are the same.
"""

import functools
import hashlib
import json
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from peers import OFFSETS

FIGURES = [("smear_volume", "smear, mm3", 2), ("hole_volume", "holes, mm3", 2), ("zippers_visible", "zippers", 0)]
PART_PERCENT = {"rose": 8.0}  # others: 3; Cura prints skin between colours and counts roads as w x h
NOT_KEPT = ("layers", "places", "pairs")
NOT_SENSITIVITY = ("worst", "model")  # scenarios of every audit; all others are variants of worst


@functools.cache
def hash_of(program):
    return hashlib.sha256(Path(program).read_bytes()).hexdigest()[:16]


def audited(program, gcode, variant="", sensitivity=True):
    """The judgement of one file; sensitivity: with all scenarios, not `worst` and `model` alone.

    Where `variant` says fwoffset, the firmware makes up for the nozzles' offsets.
    """
    form = "firmware" if "fwoffset" in variant else "slicer"
    done = subprocess.run([program, "audit", gcode, "--nozzle-offset", OFFSETS, "--offsets-in", form, "--quiet",
                           *(["--sensitivity"] if sensitivity else []), "--threads", "1", "--json", "-"],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{gcode.name}: {done.stderr.strip()}")
    judged = json.loads(done.stdout)["files"][0]
    for scenario in judged["scenarios"].values():
        for key in NOT_KEPT:
            scenario.pop(key, None)
    return judged


def audited_once(program, gcode, variant, any_program=False, sensitivity=True):
    """As audited, from before where neither file nor program changed; any_program: where the file did not."""
    file = gcode.with_name(gcode.name + (".audit.json" if sensitivity else ".worst.json"))
    key = [gcode.stat().st_size, gcode.stat().st_mtime_ns]
    if file.exists():
        before = json.loads(file.read_text())
        if before["gcode"] == key and (any_program or before["program"] == hash_of(program)):
            return before["judged"]
    judged = audited(program, gcode, variant, sensitivity)
    file.write_text(json.dumps({"gcode": key, "program": hash_of(program), "judged": judged}))
    return judged


def two_at_a_time(function, arguments):
    """function(*a) for each of arguments, in their order; nothing timed may run so."""
    with ThreadPoolExecutor(2) as pool:
        futures = [pool.submit(function, *a) for a in arguments]
        try:
            yield from (future.result() for future in futures)
        finally:  # the first failure ends it all
            pool.shutdown(wait=False, cancel_futures=True)


def figure(judged, name, scenario="worst"):
    return judged["scenarios"][scenario]["figures"][name]


def sensitivity(judged):
    """Names of the variants of worst."""
    return [name for name in judged["scenarios"] if name not in NOT_SENSITIVITY]


def filament_mm3(judged, *kinds):
    """Plastic of all nozzles; kinds: part, auxiliary, or both where none is named."""
    return sum(nozzle[f"{kind}_mm3"] for nozzle in judged["print"]["nozzles"] for kind in kinds or ("part", "auxiliary"))


def part_percent(rows, row):
    """By how much more plastic the part of a row takes than PrusaSlicer's plain one. rows: {(slicer, variant): judgement}"""
    return 100 * (filament_mm3(rows[row], "part") / filament_mm3(rows["prusa", "plain"], "part") - 1)


def compares(name, rows, row):
    """Whether a row prints the same part as PrusaSlicer does, so that its figures compare."""
    return abs(part_percent(rows, row)) <= PART_PERCENT.get(name, 3.0)
