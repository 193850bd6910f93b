"""How clean two-colour prints come out: other slicers with what they have against ooze, and cleancolor, judged alike.

Every slicer prints the pairs of ../shared/models/paper with the same layers, walls, infill, speeds and nozzle offsets, by
the command lines of ../shared/peers; `cleancolor audit` judges the G-code. What is sliced is kept in build/bench/quality/.
Needs what `scripts/setup peers` installs.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import models
from markdown import replace_between_markers

KEPT = models.CACHE / "quality"
PEERS = models.SHARED / "peers"
OFFSETS = "0x0,33x0"

# (slicer, variant of ../shared/peers/slice-<slicer>.sh, what it is called in the tables)
COMPARED = [
    ("prusa", "plain", "PrusaSlicer"),
    ("prusa", "shield", "PrusaSlicer, draft shield"),
    ("prusa", "tower", "PrusaSlicer, wipe tower"),
    ("prusa", "ooze", "PrusaSlicer, ooze prevention"),
    ("cura", "plain", "Cura"),
    ("cura", "shield", "Cura, ooze shield"),
    ("cura", "shield+tower", "Cura, shield + prime tower"),
    ("ours", "none", "cleancolor, --protect none"),
    ("ours", "rampart", "cleancolor, --protect rampart"),
    ("ours", "default", "**cleancolor**"),
]
# Our own variants: what each adds to the command line.
OURS = {
    "none": ["--protect", "none"],
    "rampart": ["--protect", "rampart"],
    "default": [],
    "vertical": ["--protect", "rampart", "--rampart", "vertical", "--set", "rampart_walls=double"],
    "conforming": ["--protect", "rampart", "--rampart", "conforming", "--set", "rampart_walls=double"],
    "layer_start": ["--protect", "rampart", "--set", "rampart_order=layer_start", "--set", "rampart_walls=double"],
}
RAMPARTS = [("none", "off"), ("vertical", "vertical, two walls (the paper's)"), ("conforming", "conforming, two walls"),
            ("layer_start", "conforming, both walls at layer start"), ("rampart", "**conforming, split (the default)**")]
# Everything that ../shared/peers can make: --every-variant reads it all.
VARIANTS = {
    "prusa": ["plain", "tower", "tower140", "shield", "ooze", "tower+shield", "acp", "tower+acp", "fwoffset",
              "sailfish+fwoffset", "makerware+fwoffset", "cool"],
    "slic3r": ["plain", "skirt", "ooze", "acp", "fwoffset", "sailfish+fwoffset", "makerware+fwoffset"],
    "cura": ["plain", "shield", "tower", "shield+tower", "nocomb", "standby", "cool", "fwoffset", "makerbot+fwoffset"],
}
FIGURES = [("smear_volume", "smear, mm3", 2), ("hole_volume", "holes, mm3", 2), ("zippers_visible", "zippers", 0)]
PART_PERCENT = {"rose": 8.0}  # others: 3; Cura prints skin between colours and counts roads as w x h


def kept(name, slicer, variant):
    return KEPT / f"{name}.{slicer}.{variant}.gcode"


def slice_with_peer(name, slicer, variant, output):
    unfinished = output.with_name("unfinished-" + output.name)  # an interrupted run leaves nothing that looks whole
    log = subprocess.run(["bash", PEERS / f"slice-{slicer}.sh", *models.stl_pair(name), unfinished, variant],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if log.returncode != 0 or not unfinished.exists():
        raise RuntimeError(f"{slicer} {variant} does not slice {name}:\n{log.stdout[-1500:]}")
    unfinished.rename(output)


def slice_with_ours(program, name, variant, output):
    subprocess.run([program, "slice", *models.stl_pair(name), "--load", models.SETTINGS, "-o", output, "--quiet",
                    *OURS[variant]], check=True, stderr=subprocess.DEVNULL)


def sliced(program, name, slicer, variant):
    """The G-code file; other slicers' from before where it is there."""
    output = kept(name, slicer, variant)
    KEPT.mkdir(parents=True, exist_ok=True)
    if slicer == "ours":
        slice_with_ours(program, name, variant, output)
    elif not output.exists():
        slice_with_peer(name, slicer, variant, output)
    return output


def audited(program, gcode, variant):
    """The audit's JSON of one file."""
    form = "firmware" if "fwoffset" in variant else "slicer"
    done = subprocess.run([program, "audit", gcode, "--nozzle-offset", OFFSETS, "--offsets-in", form, "--quiet",
                           "--json", "-"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{gcode.name}: {done.stderr.strip()}")
    return json.loads(done.stdout)["files"][0]


def figure(judged, name, scenario="worst"):
    return judged["scenarios"][scenario]["figures"][name]


def filament_mm3(judged, kind):
    return sum(nozzle[f"{kind}_mm3"] for nozzle in judged["print"]["nozzles"])


def table(name, rows):
    """Markdown of one model; time and plastic are compared with the plain slicing of the same slicer."""
    head = " | ".join(title for _, title, _ in FIGURES)
    lines = [f"| {name} | {head} | smear, model | holes, model | time | part, cm3 | thrown away, cm3 |",
             "|" + "---|" * (len(FIGURES) + 6)]
    for (_, _, title), judged in rows:
        figures = " | ".join(f"{figure(judged, key):.{digits}f}" for key, _, digits in FIGURES)
        likely = " | ".join(f"{figure(judged, key, 'model'):.2f}" for key in ("smear_volume", "hole_volume"))
        minutes = judged["print"]["time_s"] / 60
        lines.append(f"| {title} | {figures} | {likely} | {minutes:.0f} min | {filament_mm3(judged, 'part') / 1000:.2f} | "
                     f"{filament_mm3(judged, 'auxiliary') / 1000:.2f} |")
    return "\n".join(lines) + "\n"


def part_percent(rows, k):
    """By how much more plastic the part of row k takes than PrusaSlicer's plain one."""
    return 100 * (filament_mm3(rows[k][1], "part") / filament_mm3(rows[0][1], "part") - 1)


def compares(name, rows, k):
    """Whether row k prints the same part as PrusaSlicer does, so that its figures compare."""
    return abs(part_percent(rows, k)) <= PART_PERCENT.get(name, 3.0)


def different_parts(name, rows):
    """Sentences about files whose part differs too much to be compared."""
    for k, ((_, _, title), _) in enumerate(rows):
        if not compares(name, rows, k):
            yield f"{name}: the part of {title.strip('*')} takes {part_percent(rows, k):+.1f} % plastic"


def plots(results, folder):
    """Two pictures of all models: smear and holes of every slicer, and both against time, as shares of PrusaSlicer's.
    Where another part was printed, the bars are hatched and the points left out."""
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "cleancolor", "svg.fonttype": "none", "font.size": 9})
    from matplotlib import pyplot
    from matplotlib.patches import Patch

    titles = [title.strip("*") for _, _, title in COMPARED]
    palette = ["#56B4E9", "#0072B2", "#00528A", "#8CC7E8", "#E69F00", "#D55E00", "#A04000", "#D9D9D9", "#A5D6C5", "#009E73"]
    plot, axes = pyplot.subplots(2, 1, figsize=(9, 6), sharex=True, constrained_layout=True)
    for axis, (key, label, _) in zip(axes, FIGURES):
        for k, title in enumerate(titles):
            places = [m + (k - len(titles) / 2 + 0.5) * 0.09 for m in range(len(results))]
            bars = axis.bar(places, [figure(rows[k][1], key) for rows in results.values()], 0.09, color=palette[k])
            for bar, (name, rows) in zip(bars, results.items()):
                if not compares(name, rows, k):
                    bar.set(hatch="//////", edgecolor="white", linewidth=0)
        axis.set_ylabel(f"{label}, worst case")
        axis.set_yscale("symlog", linthresh=1)
        axis.grid(axis="y", alpha=0.3)
        axis.set_ylim(bottom=0)
    axes[1].set_xticks(range(len(results)), results.keys())
    axes[0].legend(handles=[Patch(color=c, label=t) for c, t in zip(palette, titles)], ncol=4, fontsize=7, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    plot.savefig(folder / "quality-figures.svg", metadata={"Date": None})
    pyplot.close(plot)

    plot, axis = pyplot.subplots(figsize=(9, 4.5), constrained_layout=True)
    def minutes(judged):
        return judged["print"]["time_s"] / 60

    def dirt(judged):
        return figure(judged, "smear_volume") + figure(judged, "hole_volume")

    for k, title in enumerate(titles):
        pairs = [(rows[k][1], rows[0][1]) for name, rows in results.items() if compares(name, rows, k)]
        axis.scatter([100 * (minutes(own) / minutes(plain) - 1) for own, plain in pairs],
                     [100 * dirt(own) / dirt(plain) for own, plain in pairs], s=28, color=palette[k], label=title)
    axis.set_xlabel("print time, % over PrusaSlicer's plain print of the same model")
    axis.set_ylabel("smear + holes, worst case, % of its")
    axis.set_yscale("log")
    axis.grid(alpha=0.3)
    axis.legend(ncol=4, fontsize=7, loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False)
    plot.savefig(folder / "quality-time.svg", metadata={"Date": None})
    pyplot.close(plot)


def rampart_table(program, names):
    """Markdown: what the rampart of each kind does and costs, all turned by the same azimuth but the first."""
    lines = ["| model | rampart | smear while printing, mm3 | while travelling | holes, mm3 | time | thrown away, cm3 | "
             "of vertical |", "|" + "---|" * 8]
    for name in names:
        judged = {v: audited(program, sliced(program, name, "ours", v), v) for v, _ in RAMPARTS}
        vertical = filament_mm3(judged["vertical"], "auxiliary")
        for variant, title in RAMPARTS:
            j = judged[variant]
            wasted = filament_mm3(j, "auxiliary")
            lines.append(f"| {name} | {title} | {figure(j, 'smear_volume_print'):.2f} | "
                         f"{figure(j, 'smear_volume_travel'):.2f} | {figure(j, 'hole_volume'):.2f} | "
                         f"{j['print']['time_s'] / 60:.0f} min | {wasted / 1000:.2f} | {wasted / vertical:.2f} |")
    return "\n".join(lines) + "\n"


def write_markdown(results, notes):
    pictures = models.ROOT / "docs" / "pictures"
    plots(results, pictures)
    tables = "\n".join(table(name, rows) for name, rows in results.items())
    text = (
        "![Smear and holes by model and slicer](pictures/quality-figures.svg)\n\n"
        "![Smear and holes against print time](pictures/quality-time.svg)\n\n" + tables + "\n"
        + ("Parts that differ by more than 3 % (rose: 8 %) from PrusaSlicer's, so that their figures compare less well; "
           "hatched in the first picture, not in the second:\n"
           + "".join(f"\n* {note}" for note in notes) + "\n" if notes else ""))
    replace_between_markers(models.ROOT / "docs" / "benchmarks.md", "scripts/bench quality --write", text)


def compare(options):
    results, notes = {}, []
    for name in options.models.split(","):
        rows = []
        for entry in COMPARED:
            gcode = sliced(options.program, name, entry[0], entry[1])
            rows.append((entry, audited(options.program, gcode, entry[1])))
        results[name] = rows
        notes += different_parts(name, rows)
        print(table(name, rows), flush=True)
    print(*notes, sep="\n")
    ramparts = rampart_table(options.program, results)
    print(ramparts)
    if options.write:
        write_markdown(results, notes)
        replace_between_markers(models.ROOT / "docs" / "benchmarks.md", "scripts/bench quality --write, rampart", ramparts)


def unknown_moves(judged):
    return [u["name"] for u in judged["unknown_commands"] if u["name"].startswith("G")]


def read_every_variant(options):
    """Every G-code that ../shared/peers can make; exit code 1 where a move is not understood or plastic is lost."""
    failed = count = 0
    for name in options.models.split(","):
        for slicer, variants in VARIANTS.items():
            plain = None
            for variant in variants:
                try:
                    judged = audited(options.program, sliced(options.program, name, slicer, variant), variant)
                except RuntimeError as trouble:
                    print(trouble)
                    failed += 1
                    continue
                count += 1
                part = filament_mm3(judged, "part")
                plain = plain or part
                faults = unknown_moves(judged)
                labelled = not any("skirts and towers count as part" in warning for warning in judged["warnings"])
                if labelled and abs(part / plain - 1) > 0.03:
                    faults.append(f"{part:.0f} mm3 of the part, in the plain file {plain:.0f}")
                failed += bool(faults)
                unknown = ", ".join(u["name"] for u in judged["unknown_commands"]) or "none"
                print(f"{name} {slicer} {variant}: {'; '.join(faults) or 'read'} (unknown commands: {unknown})", flush=True)
    print(f"{count} files read, {failed} with trouble")
    return failed


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench quality", description=__doc__)
    parser.add_argument("--models", default=",".join(models.PAIRS), help="comma-separated, of: " + ", ".join(models.PAIRS))
    parser.add_argument("--program", type=Path, help="our program (default: the release build, made first)")
    parser.add_argument("--write", action="store_true", help="write the tables and plots of docs/benchmarks.md")
    parser.add_argument("--every-variant", action="store_true", help="read every G-code that the peers can make instead")
    options = parser.parse_args()
    if not PEERS.exists():
        sys.exit(f"scripts/bench quality: {PEERS} is absent; it is looked for there, or in the folder that "
                 "CLEANCOLOR_SHARED names")
    os.environ.setdefault("OFFSET", "33,0")
    try:
        if options.every_variant:
            sys.exit(1 if read_every_variant(options) else 0)
        compare(options)
    except RuntimeError as trouble:
        sys.exit(f"scripts/bench quality: {trouble}")


if __name__ == "__main__":
    main()
