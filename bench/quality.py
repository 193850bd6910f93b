"""How clean two-colour prints come out: other slicers with what they have against ooze, and cleancolor, judged alike.

Every slicer prints the pairs of ../shared/models/paper with the same layers, walls, infill, speeds and nozzle offsets, by
the command lines of ../shared/peers; `cleancolor audit` judges the G-code. What must hold (bench/bars.py) is said at the
end; exit code 1 where something does not. What is sliced is kept in build/bench/quality/, and so are the judgements of
other slicers' files. Needs what `scripts/setup peers` installs.
"""

import argparse
import sys
from pathlib import Path

import bars
import models
from judge import FIGURES, audited, audited_once, compares, figure, filament_mm3, part_percent, two_at_a_time
from markdown import replace_between_markers
from peers import COMPARED, OURS, RAMPARTS, VARIANTS, require_shared, sliced
from quality_plots import plots

DOCUMENT = models.ROOT / "docs" / "benchmarks.md"


def table(name, rows):
    """Markdown of one model. rows: {(slicer, variant): judgement}"""
    head = " | ".join(title for _, title, _ in FIGURES)
    lines = [f"| {name} | {head} | smear, model | holes, model | time | part, cm3 | thrown away, cm3 |",
             "|" + "---|" * (len(FIGURES) + 6)]
    for slicer, variant, title in COMPARED:
        judged = rows[slicer, variant]
        figures = " | ".join(f"{figure(judged, key):.{digits}f}" for key, _, digits in FIGURES)
        likely = " | ".join(f"{figure(judged, key, 'model'):.2f}" for key in ("smear_volume", "hole_volume"))
        minutes = judged["print"]["time_s"] / 60
        lines.append(f"| {title} | {figures} | {likely} | {minutes:.0f} min | {filament_mm3(judged, 'part') / 1000:.2f} | "
                     f"{filament_mm3(judged, 'auxiliary') / 1000:.2f} |")
    return "\n".join(lines) + "\n"


def different_parts(name, rows):
    """Sentences about files whose part differs too much to be compared."""
    return [f"{name}: the part of {title.strip('*')} takes {part_percent(rows, (slicer, variant)):+.1f} % plastic"
            for slicer, variant, title in COMPARED if not compares(name, rows, (slicer, variant))]


def rampart_table(results):
    """Markdown: what the rampart of each kind does and costs, all turned by the same azimuth but the first."""
    lines = ["| model | rampart | smear while printing, mm3 | while travelling | holes, mm3 | time | thrown away, cm3 | "
             "of vertical |", "|" + "---|" * 8]
    for name, rows in results.items():
        vertical = filament_mm3(rows["ours", "vertical"], "auxiliary")
        for variant, title in RAMPARTS:
            j = rows["ours", variant]
            wasted = filament_mm3(j, "auxiliary")
            lines.append(f"| {name} | {title} | {figure(j, 'smear_volume_print'):.2f} | "
                         f"{figure(j, 'smear_volume_travel'):.2f} | {figure(j, 'hole_volume'):.2f} | "
                         f"{j['print']['time_s'] / 60:.0f} min | {wasted / 1000:.2f} | {wasted / vertical:.2f} |")
    return "\n".join(lines) + "\n"


def write_markdown(results):
    plots(results, models.ROOT / "docs" / "pictures")
    tables = "\n".join(table(name, rows) for name, rows in results.items())
    notes = [note for name, rows in results.items() for note in different_parts(name, rows)]
    text = (
        "![Smear and holes by model and slicer](pictures/quality-figures.svg)\n\n"
        "![Smear and holes against print time](pictures/quality-time.svg)\n\n" + tables + "\n"
        + ("Parts that differ by more than 3 % (rose: 8 %) from PrusaSlicer's, so that their figures compare less well; "
           "hatched in the first picture, not in the second:\n"
           + "".join(f"\n* {note}" for note in notes) + "\n" if notes else ""))
    replace_between_markers(DOCUMENT, "scripts/bench quality --write", text)
    replace_between_markers(DOCUMENT, "scripts/bench quality --write, bars", bars.table(results))
    replace_between_markers(DOCUMENT, "scripts/bench quality --write, cost", bars.cost_table(results))
    replace_between_markers(DOCUMENT, "scripts/bench quality --write, rampart", rampart_table(results))


def judgement(program, name, slicer, variant, keep_audits):
    gcode = sliced(program, name, slicer, variant)
    if slicer == "ours":
        return audited(program, gcode)
    return audited_once(program, gcode, variant, keep_audits)


def compare(options):
    """All tables; the sentences about what does not hold."""
    names = options.models.split(",")
    others = [(slicer, variant) for slicer, variant, _ in COMPARED if slicer != "ours"]
    wanted = [(name, *row) for name in names for row in [*others, *(("ours", variant) for variant in OURS)]]
    results = {name: {} for name in names}
    judged = two_at_a_time(judgement, [(options.program, *row, options.keep_audits) for row in wanted])
    for (name, *row), judgement_of_row in zip(wanted, judged):
        results[name][tuple(row)] = judgement_of_row
        if row == ["ours", list(OURS)[-1]]:
            print(table(name, results[name]), *different_parts(name, results[name]), "", sep="\n", flush=True)
    print(bars.table(results), bars.cost_table(results), rampart_table(results), sep="\n")
    if options.write:
        write_markdown(results)
    return bars.failures(results)


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
    parser.add_argument("--keep-audits", action="store_true",
                        help="other slicers' files are not judged again where only our program has changed")
    parser.add_argument("--write", action="store_true", help="write the tables and plots of docs/benchmarks.md")
    parser.add_argument("--every-variant", action="store_true", help="read every G-code that the peers can make instead")
    options = parser.parse_args()
    models.require(options.models, models.PAIRS, "scripts/bench quality")
    require_shared("scripts/bench quality")
    try:
        if options.every_variant:
            sys.exit(1 if read_every_variant(options) else 0)
        found = compare(options)
    except RuntimeError as trouble:
        sys.exit(f"scripts/bench quality: {trouble}")
    print(*found, "all bars hold" if not found else f"{len(found)} bars fail", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
