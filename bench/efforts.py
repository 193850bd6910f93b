"""How much cleaner prints come out where cleaner orders are searched for longer (`--set effort`), and the wall time of that.

PrusaSlicer, plain, and cleancolor with each effort take turns on two threads; wall times are shares of PrusaSlicer's in the same
run, medians of the rounds. Exit code 1 where the default effort takes longer than allowed.
"""

import argparse
import os
import platform
import statistics
import sys
from pathlib import Path

import models
from compare import FULL_RATIO_EACH, FULL_RATIO_MEDIAN, medians, our_command, prusa_command, timed
from judge import FIGURES, audited
from markdown import replace_between_markers
from peers import require_shared

EFFORTS = ("fast", "normal", "best")
DEFAULT = "normal"


def measured(program, name, rounds):
    """{effort: medians of its runs with its share of PrusaSlicer's wall time, and what the audit says}"""
    models.amf(name)
    outputs = {effort: models.CACHE / f"{name}.{effort}.gcode" for effort in EFFORTS}
    runs = {effort: [] for effort in EFFORTS}
    for _ in range(rounds):
        prusa = timed(prusa_command(name, models.CACHE / f"{name}.prusa.gcode"))
        for effort, output in outputs.items():
            run = timed(our_command(program, name, output, "--set", f"effort={effort}"))
            runs[effort].append(run | {"ratio": run["wall_s"] / prusa["wall_s"]})
    return {effort: medians(runs[effort]) | {"judged": audited(program, outputs[effort])} for effort in EFFORTS}


HEADER = ("| model | wall time, of PrusaSlicer's: " + " / ".join(EFFORTS) + " | CPU s | peak MB | "
          + " | ".join(title for _, title, _ in FIGURES) + " | print minutes |\n|" + "---|" * (len(FIGURES) + 5))


def row(name, efforts):
    def all_of(digits, value):
        return " / ".join(f"{value(run):.{digits}f}" for run in efforts.values())

    cells = [all_of(2, lambda run: run["ratio"]), all_of(2, lambda run: run["cpu_s"]), all_of(0, lambda run: run["memory_mb"])]
    cells += [all_of(digits, lambda run: run["judged"]["scenarios"]["worst"]["figures"][key]) for key, _, digits in FIGURES]
    return " | ".join([f"| {name}", *cells, all_of(0, lambda run: run["judged"]["print"]["time_s"] / 60)]) + " |"


def median_ratios(results):
    return {effort: statistics.median(efforts[effort]["ratio"] for efforts in results.values()) for effort in EFFORTS}


def failures(results):
    found = [f"{name}: wall time {efforts[DEFAULT]['ratio']:.2f} of PrusaSlicer's, allowed are {FULL_RATIO_EACH}"
             for name, efforts in results.items() if efforts[DEFAULT]["ratio"] > FULL_RATIO_EACH]
    if (median := median_ratios(results)[DEFAULT]) > FULL_RATIO_MEDIAN:
        found.append(f"median wall time {median:.2f} of PrusaSlicer's, allowed are {FULL_RATIO_MEDIAN}")
    return found


def main():
    parser = argparse.ArgumentParser(prog="scripts/bench efforts", description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, help="runs of each per model (default 3)")
    parser.add_argument("--models", default=",".join(models.NAMES), help="comma-separated, of: " + ", ".join(models.NAMES))
    parser.add_argument("--program", type=Path, help="our program (default: the release build, made first)")
    parser.add_argument("--write", action="store_true", help="write the table of docs/benchmarks.md")
    options = parser.parse_args()
    models.require(options.models, models.NAMES, "scripts/bench efforts")
    require_shared("scripts/bench efforts")
    results = {}
    print(HEADER)
    for name in options.models.split(","):
        try:
            results[name] = measured(options.program, name, options.rounds)
        except RuntimeError as trouble:
            sys.exit(f"scripts/bench efforts: {trouble}")
        print(row(name, results[name]), flush=True)
    medians_line = "Median of wall times: " + ", ".join(f"{e} {r:.2f}" for e, r in median_ratios(results).items()) + ".\n"
    print("", medians_line, sep="\n")
    if options.write:
        text = "\n".join([HEADER, *(row(*result) for result in results.items()), "", medians_line])
        notes = (f"Of three figures the first is with effort fast, the second with normal (the default), the third with best; "
                 f"wall and CPU times are medians of {options.rounds} rounds. Machine: {os.cpu_count()} cores, "
                 f"{platform.machine()}.\n\n")
        replace_between_markers(models.ROOT / "docs" / "benchmarks.md", "scripts/bench efforts --write", notes + text)
    found = failures(results)
    print(*found, "all bars hold" if not found else f"{len(found)} bars fail", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
