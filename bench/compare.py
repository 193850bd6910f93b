"""cleancolor beside PrusaSlicer: wall time, CPU time, peak memory and plastic, on the same machine in the same run.

Both slice the eight pairs of bench/models.py with the same settings file, in turns. See scripts/bench --help.
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import models
from markdown import replace_between_markers
from plastic import NOT_THE_PART, plastic, plastic_per_tool

WALL_RATIO_EACH, WALL_RATIO_MEDIAN = 0.8, 0.5  # sliced as plainly as PrusaSlicer does
FULL_RATIO_EACH, FULL_RATIO_MEDIAN = 1.5, 1.0  # with all that keeps colours apart
MEMORY_MB = 300
PLASTIC_PERCENT = {"rose": 8.0}  # others: 3


def prusa_command(name, output):
    return ["prusa-slicer", "--loglevel", "1", "--load", models.SETTINGS, "--center", "0,0", "-g", "-o", output,
            models.amf(name)]


def our_command(program, name, output, *added):
    """On two threads; PrusaSlicer takes as many as the machine has."""
    return [program, "slice", *models.stl_pair(name), "--load", models.SETTINGS, "-o", output, "--quiet",
            "--threads", "2", *added]


def undisturbed():
    """Other work on the machine waits while a slicer runs, where we may ask for that: else wall times mean little."""
    try:
        Path("/proc/self/autogroup").write_text("-20")
    except OSError:
        pass


def timed(command):
    """Runs the command; {wall_s, cpu_s, memory_mb}. Its own messages are shown only where it fails."""
    with tempfile.NamedTemporaryFile("r") as figures:
        start = time.perf_counter()
        done = subprocess.run(["/usr/bin/time", "-o", figures.name, "-f", "%U %S %M", *map(str, command)],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              start_new_session=True, preexec_fn=undisturbed)
        wall_s = time.perf_counter() - start
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stdout[-2000:]}exit code {done.returncode}")
        user_s, system_s, memory_kb = map(float, figures.read().split())
    return {"wall_s": wall_s, "cpu_s": user_s + system_s, "memory_mb": memory_kb / 1024}


def medians(runs):
    return {key: statistics.median(run[key] for run in runs) for key in runs[0]}


def measure(name, program, rounds, ours_only):
    """Both slicers in turns, `rounds` times; figures are medians. PrusaSlicer's are kept for --filament-only."""
    kept = models.CACHE / f"{name}.prusa.json"
    prusa_gcode, our_gcode = models.CACHE / f"{name}.prusa.gcode", models.CACHE / f"{name}.ours.gcode"
    models.amf(name)
    full_gcode = models.CACHE / f"{name}.full.gcode"
    prusa_runs, our_runs, full_runs = [], [], []
    for _ in range(rounds):
        if not (ours_only and kept.exists()):
            prusa_runs.append(timed(prusa_command(name, prusa_gcode)))
        if program:
            our_runs.append(timed(our_command(program, name, our_gcode, "--protect", "none")))
            full_runs.append(timed(our_command(program, name, full_gcode, "--protect", "full")))
    if prusa_runs:
        laid = [[tool, kind, mm3] for (tool, kind), mm3 in plastic(prusa_gcode).items()]
        kept.write_text(json.dumps(medians(prusa_runs) | {"plastic": laid}))
    prusa = json.loads(kept.read_text())
    prusa["plastic"] = {(tool, kind): mm3 for tool, kind, mm3 in prusa["plastic"]}
    ours = medians(our_runs) | {"plastic": plastic(our_gcode), "full": medians(full_runs)} if our_runs else None
    return prusa, ours


def difference_percent(ours, theirs):
    return 100 * (ours - theirs) / theirs if theirs else float("inf") if ours else 0.0


def differences(prusa, ours):
    """Per tool, percent by which our plastic differs."""
    a, b = plastic_per_tool(ours["plastic"]), plastic_per_tool(prusa["plastic"])
    return {tool: difference_percent(a.get(tool, 0), b.get(tool, 0)) for tool in sorted(set(a) | set(b))}


def roles_table(name, prusa, ours):
    """Lines: plastic per tool and type of both."""
    lines = [f"{name}: plastic in mm3", f"  {'type':<26}{'PrusaSlicer':>12}{'cleancolor':>12}{'diff':>10}{'diff/total':>12}"]
    theirs, own = prusa["plastic"], ours["plastic"] if ours else {}
    for tool in sorted({tool for tool, _ in [*theirs, *own]}):
        total = plastic_per_tool(theirs).get(tool, 0)
        for kind in sorted({kind for t, kind in [*theirs, *own] if t == tool}):
            a, b = own.get((tool, kind), 0), theirs.get((tool, kind), 0)
            share = "not counted" if kind in NOT_THE_PART else f"{difference_percent(total + a - b, total):+.1f} %"
            lines.append(f"  T{tool} {kind:<23}{b:12.1f}{a:12.1f}{a - b:+10.1f}{share:>12}")
        a, b = plastic_per_tool(own).get(tool, 0), total
        lines.append(f"  T{tool} {'all of the part':<23}{b:12.1f}{a:12.1f}{a - b:+10.1f}{difference_percent(a, b):+10.2f} %")
    return lines


HEADER = ("| model | wall time in s: PrusaSlicer | cleancolor, as plain | ratio | all against ooze | ratio | CPU s | peak MB | "
          "plastic of extruder 1 / 2, cm3 | difference |\n|---|---|---|---|---|---|---|---|---|---|")


def table_row(name, prusa, ours):
    def both(key, digits):
        slicers = (prusa, ours, ours["full"]) if ours else (prusa,)
        return " / ".join(f"{slicer[key]:.{digits}f}" for slicer in slicers)

    laid = " / ".join(f"{mm3 / 1000:.2f}" for _, mm3 in sorted(plastic_per_tool((ours or prusa)["plastic"]).items()))
    walls, difference = "- | - | - | -", "-"
    if ours:
        walls = " | ".join(f"{run['wall_s']:.2f} | {run['wall_s'] / prusa['wall_s']:.2f}" for run in (ours, ours["full"]))
        difference = " / ".join(f"{percent:+.1f} %" for percent in differences(prusa, ours).values())
    return (f"| {name} | {prusa['wall_s']:.2f} | {walls} | {both('cpu_s', 2)} | {both('memory_mb', 0)} | "
            f"{laid} | {difference} |")


def failures(results, with_time):
    """What does not hold of the bars, as sentences."""
    found, ratios, full_ratios = [], [], []
    for name, (prusa, ours) in results.items():
        bar = PLASTIC_PERCENT.get(name, 3.0)
        for tool, percent in differences(prusa, ours).items():
            if abs(percent) > bar:
                found.append(f"{name}: plastic of T{tool} differs by {percent:+.1f} %, allowed are {bar:.0f} %")
        for run in (ours, ours["full"]):
            if run["memory_mb"] > MEMORY_MB:
                found.append(f"{name}: peak memory {run['memory_mb']:.0f} MB, allowed are {MEMORY_MB} MB")
        ratios.append(ours["wall_s"] / prusa["wall_s"])
        if with_time and ratios[-1] > WALL_RATIO_EACH:
            found.append(f"{name}: wall time {ratios[-1]:.2f} of PrusaSlicer's, allowed are {WALL_RATIO_EACH}")
        full_ratios.append(ours["full"]["wall_s"] / prusa["wall_s"])
        if with_time and full_ratios[-1] > FULL_RATIO_EACH:
            found.append(f"{name}: with all against ooze {full_ratios[-1]:.2f} of its time, allowed are {FULL_RATIO_EACH}")
    if with_time and statistics.median(ratios) > WALL_RATIO_MEDIAN:
        found.append(f"median wall time {statistics.median(ratios):.2f} of PrusaSlicer's, allowed are {WALL_RATIO_MEDIAN}")
    if with_time and statistics.median(full_ratios) > FULL_RATIO_MEDIAN:
        found.append(f"median with all against ooze {statistics.median(full_ratios):.2f}, allowed are {FULL_RATIO_MEDIAN}")
    return found


def write_markdown(results, rounds):
    """docs/benchmarks.md, and the table of the README between its two marks."""
    median = statistics.median(ours["wall_s"] / prusa["wall_s"] for prusa, ours in results.values())
    full = statistics.median(ours["full"]["wall_s"] / prusa["wall_s"] for prusa, ours in results.values())
    rows = "\n".join(table_row(name, *pair) for name, pair in results.items())
    table = f"{HEADER}\n{rows}\n\nMedian ratio of wall time: {median:.2f}, with all against ooze {full:.2f}.\n"
    notes = (
        f"A figure is the median of {rounds} rounds; of several the first is PrusaSlicer's, the second ours as plain, the third "
        f"with all against ooze. Machine: {os.cpu_count()} cores, "
        f"{platform.machine()}.\n\n")
    replace_between_markers(models.ROOT / "docs" / "benchmarks.md", "scripts/bench --write", notes + table)
    replace_between_markers(models.ROOT / "README.md", "scripts/bench --write", table)


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench", description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, help="runs of each slicer per model (default 3)")
    parser.add_argument("--models", default=",".join(models.NAMES), help="comma-separated, of: " + ", ".join(models.NAMES))
    parser.add_argument("--filament-only", action="store_true", help="one run of ours, PrusaSlicer's results from before")
    parser.add_argument("--roles", action="store_true", help="also the plastic per ;TYPE: of both")
    parser.add_argument("--prusa-only", action="store_true", help="only PrusaSlicer: fills build/bench/")
    parser.add_argument("--program", type=Path, help="our program (default: the release build, made first)")
    parser.add_argument("--write", action="store_true", help="write docs/benchmarks.md")
    options = parser.parse_args()
    models.require(options.models, models.NAMES, "scripts/bench")
    if not models.SETTINGS.exists():
        sys.exit(f"scripts/bench: {models.SETTINGS} is absent; the models and settings are looked for there, "
                 "or in the folder that CLEANCOLOR_SHARED names")

    results = {}
    print(HEADER)
    for name in options.models.split(","):
        rounds = 1 if options.filament_only else options.rounds
        program = None if options.prusa_only else options.program
        try:
            results[name] = measure(name, program, rounds, options.filament_only)
        except RuntimeError as failure:
            sys.exit(f"scripts/bench: {failure}")
        print(table_row(name, *results[name]), flush=True)
    if options.roles:
        for name, pair in results.items():
            print("", *roles_table(name, *pair), sep="\n")
    if options.prusa_only:
        return
    found = failures(results, with_time=not options.filament_only)
    if options.write:
        write_markdown(results, options.rounds)
    print("", *found, "all bars hold" if not found else f"{len(found)} bars fail", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
