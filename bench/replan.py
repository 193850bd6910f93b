"""What re-planning makes of other slicers' G-code: whether it is the same print, and how clean it comes out.

Every slicer prints the pairs of ../shared/models/paper by the command lines of ../shared/peers; `cleancolor replan` re-plans
the files, `cleancolor audit` judges both (scenario worst), and this script itself reads both and compares their roads. What
must hold is said at the end; exit code 1 where something does not. Needs what `scripts/setup peers` installs.
"""

import argparse
import collections
import math
import re
import subprocess
import sys
import time
from pathlib import Path

import models
from compare import timed
from judge import audited_once, figure, two_at_a_time
from markdown import replace_between_markers
from peers import ADDED, OFFSETS, VARIANTS, kept, require_shared, slice_with_peer, sliced

DOCUMENT = models.ROOT / "docs" / "replan.md"
SLICERS = {"prusa": "PrusaSlicer", "slic3r": "Slic3r", "cura": "CuraEngine"}
# Models with overhangs, printed with all of ADDED.
SUPPORTED = ["crystal", "two-color-world-50mm"]
GOOD = ["plain", "support", "soluble", "raft"]  # ironing begins at many places in sight, and stays as it is
# Of these files: shares of the input's figures, and what is little enough.
SMEAR, LITTLE_SMEAR_MM3, HOLES, TIME = 1 / 8, 0.2, 1 / 4, 1.30
WORSE, HOLE_WEIGHT = 1.02, 4  # of any file, and 0.05 mm3: what docs/replan.md lets pass
FILAMENT = 1e-4  # of each nozzle and type of road
GLOBE = "two-color-world-50mm"
AGAINST_OOZE = [  # slicer, variant, the option that removes it
    ("draft shield", "prusa", "shield", "--remove-shield"),
    ("standby temperatures and shield", "prusa", "ooze", "--remove-shield"),
    ("wipe tower, 15 mm3 a change", "prusa", "tower", "--remove-tower"),
    ("Cura's ooze shield", "cura", "shield", "--remove-shield"),
    ("Cura's prime tower", "cura", "tower", "--remove-tower"),
]
# Plain files of 20 MB by finer layers: slicer, model, mm of a layer; and the wall time that they may take on two cores.
LARGE = [("prusa", "dragon-heart", 0.073), ("prusa", "spot-cow", 0.066), ("cura", "dragon-heart", 0.092)]
LARGE_S = 10
AUXILIARY = ("skirt", "brim", "tower", "custom", "wipe")
NEAR_MM = 0.003  # ends of roads are rounded to 0.001 mm
SEAM_GAP_MM = 0.3  # that slicers leave where a loop ends: PrusaSlicer 0.06, Cura up to 0.27

WORD = re.compile(r"([XYZEIJ])(-?[0-9.]+)")


def arc(begin, end, to_center, code):
    """Its centre, and the angle that it goes round."""
    center = tuple(round(at + by, 3) for at, by in zip(begin, to_center))
    angles = [math.atan2(y - center[1], x - center[0]) for x, y in (begin, end)]
    return center, (angles[1] - angles[0] if code == "3" else angles[0] - angles[1]) % (2 * math.pi)


def moves(gcode):
    """(tool, type, {axis: from}, {axis: to}, filament in mm, G code, (I, J), line) of each move that drives or feeds, in the file's
    coordinates.
    """
    at, relative, tool, kind = {"X": 0.0, "Y": 0.0, "Z": 0.0, "E": 0.0}, False, 0, ""
    for number, line in enumerate(gcode.read_text(errors="replace").splitlines(), 1):
        if line.startswith((";TYPE:", "; TYPE:", "; FEATURE:")):
            kind = line.split(":", 1)[1].lower().replace("unknown", "")
        elif line.startswith(("G0 ", "G1 ", "G2 ", "G3 ")):
            words = {axis: float(value) for axis, value in WORD.findall(line.split(";", 1)[0])}
            fed = words.get("E", 0.0) - (0.0 if relative or "E" not in words else at["E"])
            center = words.pop("I", 0.0), words.pop("J", 0.0)
            to = {**at, **words}
            if fed != 0 or to["X"] != at["X"] or to["Y"] != at["Y"]:
                yield tool, kind, at, to, fed, line[1], center, number
            at = to
        elif line.startswith("G92"):
            at = {**at, **{axis: float(value) for axis, value in WORD.findall(line)}}
        elif line.startswith(("M82", "M83")):
            relative = line.startswith("M83")
        elif found := re.match(r"(?:T|M135 T|M108 T)(\d+)", line):
            tool = int(found[1])


def extrusions(gcode):
    """(tool, type, z, (x, y) from, (x, y) to, filament in mm, arc) of each road of part and supports, in the file's coordinates;
    arc: (centre, angle in rad), or nothing.
    """
    for tool, kind, at, to, fed, code, center, _ in moves(gcode):
        ends = (at["X"], at["Y"]), (to["X"], to["Y"])
        if fed > 0 and ends[0] != ends[1] and not any(word in kind for word in AUXILIARY):
            yield tool, kind, round(to["Z"], 3), *ends, fed, arc(*ends, center, code) if code in "23" else None


def roads(gcode):
    """{(tool, z): Counter of ((x, y), (x, y))}, {(tool, z, centre): mm of arcs} and {(tool, type): filament, mm}"""
    placed, round_mm, filament = collections.defaultdict(collections.Counter), collections.Counter(), collections.Counter()
    for tool, kind, z, begin, end, fed, round_about in extrusions(gcode):
        if round_about:
            center, angle = round_about
            round_mm[tool, z, center] += angle * math.dist(center, begin)
        else:
            placed[tool, z][min(begin, end), max(begin, end)] += 1
        filament[tool, kind] += fed
    return placed, round_mm, filament


def order(gcode):
    """Of each (tool, z): whether all supports come before the part, and the ironing, directed, if it comes last; else nothing."""
    kinds, ironed = collections.defaultdict(list), collections.defaultdict(list)
    for tool, kind, z, begin, end, *_ in extrusions(gcode):
        own = "support" if "support" in kind else "ironing" if kind == "ironing" else "part"
        if not kinds[tool, z] or kinds[tool, z][-1] != own:
            kinds[tool, z].append(own)
        if own == "ironing":
            ironed[tool, z].append((begin, end))
    return {place: ("support" not in own[1:], ironed[place] if "ironing" not in own[:-1] else None) for place, own in kinds.items()}


def order_faults(before, after):
    """Sentences on supports that come after the part, and on ironing in another order, where the file has it otherwise."""
    old, new = order(before), order(after)
    late = [place for place in old if old[place][0] and place in new and not new[place][0]]
    ironed = [place for place in old if old[place][1] is not None and place in new and old[place][1] != new[place][1]]
    return ([f"nozzle {late[0][0]} prints supports after the part at z {late[0][1]}"] if late else []) + (
        [f"nozzle {ironed[0][0]} irons otherwise at z {ironed[0][1]}"] if ironed else [])


def lies_on(shorter, longer):
    """Whether both ends of the shorter road are on the line of the longer."""
    (ax, ay), (bx, by) = longer
    return all(abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) < NEAR_MM * math.dist(*longer) for x, y in shorter)


def uncovered_mm(road, others):
    """The longest piece of a road that no other lies on."""
    (ax, ay), (bx, by) = road
    length = math.dist(*road)
    ux, uy = (bx - ax) / length, (by - ay) / length
    covered = []
    for other in others:
        along = sorted((x - ax) * ux + (y - ay) * uy for x, y in other)
        if along[1] > 0 and along[0] < length and lies_on(*sorted((road, other), key=lambda ends: math.dist(*ends))):
            covered.append(along)
    longest = reached = 0.0
    for begin, end in sorted(covered):
        longest, reached = max(longest, begin - reached), max(reached, end)
    return max(longest, length - reached)


def lost_roads(before, after):
    """Roads of the one that do not lie on those of the other, but for the gap that a loop has where it ends."""
    lost = []
    for place in before.keys() | after.keys():
        old, new = before.get(place, collections.Counter()), after.get(place, collections.Counter())
        gone, come = list((old - new).elements()), list((new - old).elements())
        lost += [(place, road) for road in gone if uncovered_mm(road, come) > SEAM_GAP_MM]
        lost += [(place, road) for road in come if uncovered_mm(road, gone) > SEAM_GAP_MM]
    return lost


def same_print(before, after):
    """Sentences on what is not the same of the part."""
    (old_roads, old_arcs, old_filament), (new_roads, new_arcs, new_filament) = roads(before), roads(after)
    faults = []
    for key in old_filament.keys() | new_filament.keys():
        if abs(old_filament[key] - new_filament[key]) > FILAMENT * old_filament[key] + 1e-3:
            faults.append(f"nozzle {key[0]}, {key[1]}: {old_filament[key]:.2f} mm of filament became {new_filament[key]:.2f}")
    lost = lost_roads(old_roads, new_roads)
    if lost:
        faults.append(f"{len(lost)} roads differ, the first of nozzle {lost[0][0][0]} at z {lost[0][0][1]}: {lost[0][1]}")
    bent = [place for place in old_arcs.keys() | new_arcs.keys() if abs(old_arcs[place] - new_arcs[place]) > SEAM_GAP_MM]
    if bent:
        faults.append(f"{len(bent)} arcs differ, the first of nozzle {bent[0][0]} at z {bent[0][1]} about {bent[0][2]}")
    return faults + order_faults(before, after)


def replanned(program, gcode, variant, *added):
    """The re-planned file and the seconds it took, or the reason why there is none. added: to the command line."""
    output = gcode.with_name(gcode.name.replace(".gcode", f".replanned{''.join(added)}.gcode"))
    output.unlink(missing_ok=True)
    begin = time.monotonic()
    done = subprocess.run([program, "replan", gcode, "-o", output, "--nozzle-offset", OFFSETS, "--offsets-in",
                           "firmware" if "fwoffset" in variant else "slicer", "--quiet", *added],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    seconds = time.monotonic() - begin
    if done.returncode != 0:
        said = done.stderr.strip().rpartition(".gcode: ")[2].splitlines()
        return None, seconds, said[-1] if said else f"exit code {done.returncode}"
    return output, seconds, ""


def stays_as_it_is(program, gcode, variant):
    """Whether re-planning changes nothing of what was re-planned before."""
    again = replanned(program, gcode, variant, "--keep-going")[0]
    same = again is not None and again.read_bytes() == gcode.read_bytes()
    if again:
        again.unlink()
    return same


def judged_row(program, name, slicer, variant):
    """One row of the table, and what does not hold of it."""
    before = sliced(program, name, slicer, variant)
    title = f"{name}, {SLICERS[slicer]} {variant}"
    after, seconds, reason = replanned(program, before, variant)
    if not after:
        return f"| {title} | left as it is: {reason} | | | |", [f"{title}: {reason}"]
    faults = same_print(before, after)
    if not stays_as_it_is(program, after, variant):
        faults.append("re-planned again it is another file")
    old, new = (audited_once(program, file, variant, sensitivity=False) for file in (before, after))
    pairs = {key: (figure(old, key), figure(new, key)) for key in ("smear_volume", "hole_volume")}
    minutes = [j["print"]["time_s"] / 60 for j in (old, new)]
    (old_smear, smear), (old_holes, holes) = pairs.values()
    if variant in GOOD and slicer != "slic3r":  # its files tell no roles
        if smear > SMEAR * old_smear and smear >= LITTLE_SMEAR_MM3:
            faults.append(f"smears {smear:.2f} of {old_smear:.2f} mm3")
        if holes > HOLES * old_holes:
            faults.append(f"holes {holes:.2f} of {old_holes:.2f} mm3")
        if minutes[1] > TIME * minutes[0]:
            faults.append(f"takes {minutes[1]:.0f} instead of {minutes[0]:.0f} min")
    spoilt, old_spoilt = smear + HOLE_WEIGHT * holes, old_smear + HOLE_WEIGHT * old_holes
    if spoilt > WORSE * old_spoilt + 0.05:
        faults.append(f"smears and weighted holes {spoilt:.2f} instead of {old_spoilt:.2f} mm3")
    row = (f"| {title} | {old_smear:.2f} / {smear:.2f} | {old_holes:.2f} / {holes:.2f} | {minutes[0]:.0f} / {minutes[1]:.0f} | "
           f"{seconds:.1f} |")
    return row, [f"{title}: {fault}" for fault in faults]


def kept_row(program, title, slicer, variant, remove):
    """One row of the table of what slicers do against ooze: of the globe, kept and removed."""
    before = sliced(program, GLOBE, slicer, variant)
    files = [before, *(replanned(program, before, variant, *added)[0] for added in ([], [remove]))]
    judged = [audited_once(program, file, variant, sensitivity=False) for file in files]
    cells = [[figure(j, key) for j in judged] for key in ("smear_volume", "hole_volume")]
    minutes = " / ".join(f"{j['print']['time_s'] / 60:.0f}" for j in judged)
    return f"| {title} | " + " | ".join(" / ".join(f"{value:.1f}" for value in cell) for cell in cells) + f" | {minutes} |"


def speed_row(program, slicer, name, layer_mm):
    """One row on a large file, and whether it takes too long."""
    gcode = kept(name, slicer, f"plain-{layer_mm:g}mm")
    gcode.parent.mkdir(parents=True, exist_ok=True)
    if not gcode.exists():
        slice_with_peer(name, slicer, "plain", gcode, LAYER=f"{layer_mm:g}")
    output = gcode.with_name(gcode.name.replace(".gcode", ".replanned.gcode"))
    run = timed([program, "replan", gcode, "-o", output, "--nozzle-offset", OFFSETS, "--offsets-in", "slicer", "--quiet",
                 "--threads", "2"])
    row = (f"| {name}, {SLICERS[slicer]}, {layer_mm:g} mm | {gcode.stat().st_size / 1e6:.1f} | {run['wall_s']:.1f} | "
           f"{run['cpu_s']:.1f} | {run['memory_mb']:.0f} |")
    return row, run["wall_s"] > LARGE_S


def speed(program, writes):
    """Prints how long large files take; whether one takes too long."""
    table = ["| file | MB | wall time, s | CPU s | peak MB |", "|---|---|---|---|---|"]
    late = False
    print(*table, sep="\n")
    for large in LARGE:
        row, is_late = speed_row(program, *large)
        print(row, flush=True)
        table.append(row)
        late = late or is_late
    if writes:
        replace_between_markers(DOCUMENT, "scripts/bench replan --speed --write", "\n".join(table) + "\n")
    print(f"some take more than {LARGE_S} s" if late else f"none takes more than {LARGE_S} s")
    return late


def files(names, every_variant):
    """(name, slicer, variant) of what is re-planned."""
    rows = [(name, slicer, variant) for slicer, variants in VARIANTS.items()
            for variant in (variants if every_variant else variants[:1]) for name in names]
    return rows + [(name, slicer, variant) for slicer, variants in ADDED.items() for variant in variants
                   for name in names if name in SUPPORTED]


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench replan", description=__doc__)
    parser.add_argument("--models", default=",".join(models.PAIRS), help="comma-separated, of: " + ", ".join(models.PAIRS))
    parser.add_argument("--program", type=Path, help="our program (default: the release build, made first)")
    parser.add_argument("--every-variant", action="store_true", help="all that ../shared/peers can make, not only plain files")
    parser.add_argument("--speed", action="store_true", help=f"only how long files of 20 MB take; at most {LARGE_S} s")
    parser.add_argument("--write", action="store_true", help="write the tables of docs/replan.md")
    options = parser.parse_args()
    models.require(options.models, models.PAIRS, "scripts/bench replan")
    require_shared("scripts/bench replan")
    if options.speed:
        sys.exit(speed(options.program, options.write))
    rows = [(options.program, *file) for file in files(options.models.split(","), options.every_variant)]
    table = ["| file | smears, mm3, before / after | holes, mm3 | time, min | seconds |", "|---|---|---|---|---|"]
    failures = []
    print(*table, sep="\n")
    for row, faults in two_at_a_time(judged_row, rows):
        print(row, flush=True)
        table.append(row)
        failures += faults
    if options.write:
        replace_between_markers(DOCUMENT, "scripts/bench replan --write", "\n".join(table) + "\n")
        kept = two_at_a_time(kept_row, [(options.program, *row) for row in AGAINST_OOZE])
        head = "| globe sliced with | smears, mm3: before / kept / removed | holes, mm3 | time, min |\n|---|---|---|---|\n"
        replace_between_markers(DOCUMENT, "scripts/bench replan --write: kept", head + "\n".join(kept) + "\n")
    print(*failures, sep="\n")
    print(f"{len(rows)} files, {len(failures)} bars fail" if failures else f"{len(rows)} files; all bars hold")
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
