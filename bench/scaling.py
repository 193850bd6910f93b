"""How time and memory grow with nozzles, layers and triangles, and whether the G-code is the same for any number of threads.

Columns of any size are made by bench/wedges.py and kept in build/bench/scaling/. Planning is the time of all against ooze less
that of the same with --set planner=plain. Runs of one comparison take turns; figures are medians. Exit code 1 where a bar fails.
"""

import argparse
import os
import platform
import sys
from pathlib import Path

import models
import outputs
from compare import medians, timed
from markdown import replace_between_markers
from peers import require_shared
from wedges import FOLDER, column

NOZZLES_TIMES = 2.0  # wall time with 4 nozzles, of that with 2 on the same parts
LAYERS_TIMES = 2.2  # wall time with twice the layers: 2, and 10 % for noise
KB_A_LAYER = 30
PEAK_MB = 500
OFFSETS = "0x0,33x0,0x33,33x33"


def machine(nozzles):
    """Arguments: that many nozzles on one carriage."""
    offsets = ",".join(OFFSETS.split(",")[:nozzles])
    return ["--printer", "generic-dual-marlin", "--set", "nozzle_diameter=" + ",".join(["0.4"] * nozzles),
            "--set", f"nozzle_offset={offsets}"]


def layer_height(height_mm):
    return ["--set", f"layer_height={height_mm}", "--set", f"first_layer_height={height_mm}"]


def column_case(wedges, rim_steps, levels, height_mm, layer_mm, *added):
    return [*column(wedges, rim_steps, levels, height_mm), *machine(wedges), *layer_height(layer_mm), *added]


def model_case(name, layer_mm):
    return [*models.stl_pair(name), "--load", models.SETTINGS, *layer_height(layer_mm)]


def cases():
    """What is sliced, by comparisons: [{title: arguments of cleancolor slice}]. The first is by nozzles, all of them with as many
    walls of the rampart as nozzles; the others double the layers, and double them again."""
    walls = "--set", "rampart_walls=double"
    halves, quarters = (column_case(wedges, 240, 240, 90, 0.3, *walls) for wedges in (2, 4))
    two_nozzles = [word for k, file in enumerate(column(4, 240, 240, 90)) for word in ("--extruder", str(k % 2 + 1), file)]
    comparisons = [{
        "column of 2 wedges, 2 nozzles": halves,
        "column of 4 wedges, 2 nozzles": [*two_nozzles, *machine(2), *layer_height(0.3), *walls],
        "column of 4 wedges, 4 nozzles": quarters,
    }, {f"column, {tall} mm tall": column_case(2, 240, 240, tall, 0.3) for tall in (50, 100, 200)}]
    for name in ("two-color-world-50mm", "dragon-heart"):
        comparisons.append({f"{name}, layers of {mm} mm": model_case(name, mm) for mm in (0.3, 0.15, 0.075)})
    return comparisons


LARGE = "column, 1 M triangles"


def large_case():
    return column_case(2, 1000, 500, 150, 0.1)


def measured(program, comparison, rounds):
    """{title: medians}, of all and of what the planner takes."""
    runs = {title: [] for title in comparison}
    output = FOLDER / "scaling.gcode"
    for _ in range(rounds):
        for title, arguments in comparison.items():
            command = [program, "slice", *arguments, "--threads", "2", "--quiet", "-o", output]
            run = timed(command)
            run["layers"] = output.read_text().count("\n;LAYER_CHANGE")
            plain = timed([*command, "--set", "planner=plain"])
            run |= {f"planning_{key}": run[key] - plain[key] for key in ("wall_s", "cpu_s")}
            runs[title].append(run)
    return {title: medians(several) for title, several in runs.items()}


def triangles(arguments):
    return sum((file.stat().st_size - 84) // 50 for file in arguments if str(file).endswith(".stl"))


HEADER = ("| model | thousand triangles | layers | wall s | CPU s | planning: wall s | CPU s | peak MB |\n" + "|" + "---|" * 8)


def row(title, arguments, run):
    return (f"| {title} | {triangles(arguments) / 1000:.0f} | {run['layers']:.0f} | {run['wall_s']:.2f} | {run['cpu_s']:.2f} | "
            f"{run['planning_wall_s']:.2f} | {run['planning_cpu_s']:.2f} | {run['memory_mb']:.0f} |")


def promises(comparisons):
    """[(what, figure, allowed; None: told without a bar)] of measured cases, in the order of `cases`."""
    by_nozzles, *by_layers, large = [list(runs.items()) for runs in comparisons]
    (_, halves), (_, same_parts), (_, quarters) = by_nozzles
    found = [("4 nozzles, of 2, on the same 4 wedges: wall time", quarters["wall_s"] / same_parts["wall_s"], NOZZLES_TIMES),
             ("planning alone", quarters["planning_wall_s"] / same_parts["planning_wall_s"], None),
             ("4 nozzles on 4 wedges, of 2 on 2: wall time", quarters["wall_s"] / halves["wall_s"], None)]
    for runs in by_layers:
        (title, first), (_, last) = runs[0], runs[-1]
        growth = [b["wall_s"] / a["wall_s"] for (_, a), (_, b) in zip(runs, runs[1:])]
        kept_kb = 1024 * (last["memory_mb"] - first["memory_mb"]) / (last["layers"] - first["layers"])
        name = title.partition(",")[0]
        found += [(f"{name}: wall time with twice the layers, the greater of two doublings", max(growth), LAYERS_TIMES),
                  (f"{name}: kB of peak memory for each further layer", kept_kb, KB_A_LAYER)]
    title, most = max((case for runs in (by_nozzles, *by_layers, large) for case in runs), key=lambda case: case[1]["memory_mb"])
    return [*found, (f"peak MB ({title})", most["memory_mb"], PEAK_MB)]


def promise_table(found):
    lines = ["| what must hold | measured | at most |", "|---|---|---|"]
    for what, figure, allowed in found:
        mark = "" if allowed is None or figure <= allowed else "**"
        lines.append(f"| {what} | {mark}{figure:.2f}{mark} | {'-' if allowed is None else f'{allowed:g}'} |")
    return "\n".join(lines) + "\n"


def measure(options):
    """The tables as Markdown, and sentences about what fails."""
    results, lines = [], [HEADER]
    print(HEADER)
    for comparison in [*cases(), {LARGE: large_case()}]:
        results.append(measured(options.program, comparison, 1 if LARGE in comparison else options.rounds))
        lines += [row(title, comparison[title], run) for title, run in results[-1].items()]
        print(*lines[-len(comparison):], sep="\n", flush=True)
    found = promises(results)
    notes = (f"A figure is the median of {options.rounds} rounds, of the large model one run. Machine: {os.cpu_count()} cores, "
             f"{platform.machine()}.\n\n")
    failed = [f"{what}: {figure:.2f}; allowed are {allowed:g}" for what, figure, allowed in found if allowed is not None and figure > allowed]
    print("", promise_table(found), sep="\n")
    return notes + "\n".join(lines) + "\n\n" + promise_table(found), failed


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench scaling", description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, help="runs of each case (default 3)")
    parser.add_argument("--program", type=Path, help="our program (default: the release build, made first)")
    parser.add_argument("--outputs-only", action="store_true", help="time and memory are left out")
    parser.add_argument("--models", default=",".join(models.NAMES),
                        help="whose G-code is compared and read; comma-separated, of: " + ", ".join(models.NAMES))
    parser.add_argument("--write", action="store_true", help="write the tables of docs/benchmarks.md")
    options = parser.parse_args()
    models.require(options.models, models.NAMES, "scripts/bench scaling")
    require_shared("scripts/bench scaling")
    document = models.ROOT / "docs" / "benchmarks.md"
    failed = []
    try:
        if not options.outputs_only:
            text, failed = measure(options)
            if options.write:
                replace_between_markers(document, "scripts/bench scaling --write", text)
        table, wrong = outputs.checked(options.program, options.models.split(","))
        print(table)
    except RuntimeError as trouble:
        sys.exit(f"scripts/bench scaling: {trouble}")
    failed += wrong
    if options.write:
        replace_between_markers(document, "scripts/bench scaling --write, outputs", table)
    print(*failed, "all bars hold" if not failed else f"{len(failed)} bars fail", sep="\n")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
