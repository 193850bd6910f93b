"""What the weights of the planner bring: prints with several values of one of them, all others as they are by default.

Weights are chosen on the tuning half of the models; the other half shows whether that holds for models they were not chosen on.
Smear and holes are those of the audit's scenario worst, summed over the models; time is print time. The value that is now the
default is bold.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

import models
from judge import audited, figure, two_at_a_time
from markdown import replace_between_markers
from peers import require_shared, slice_with_ours

FOLDER = models.CACHE / "tune"
HALVES = {"tuning half": ["crystal", "dragon-heart", "rose", "4-cones"],
          "other half": ["two-color-world-50mm", "robot-ice", "spot-cow"]}
FACTORS = (0, 0.25, 0.5, 1, 2, 4)  # of the default, where no values are named


def defaults(program):
    """{option: value} of the planner's weights, by the print profile that holds where none is named."""
    shown = subprocess.run([program, "profiles", "show", "paper"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return {name: float(value) for name, value in re.findall(r"^(weight_\w+) = (\S+)", shown, re.M)}


def refused(program, option, value):
    """Why the program does not take the value; empty where it does."""
    done = subprocess.run([program, "slice", "absent.stl", "-o", FOLDER / "none.gcode", "--set", f"{option}={value:g}"],
                          stderr=subprocess.PIPE, text=True)
    return done.stderr.strip() if "--set" in done.stderr else ""


def wanted(options, weights):
    """{option: values}, from the command line: NAME, NAME=VALUE,VALUE..., or all weights."""
    asked = {}
    for text in options.option or weights:
        name, equals, values = text.partition("=")
        if name not in weights:
            sys.exit(f"scripts/bench tune: there is no option '{name}'; there are {', '.join(weights)}")
        try:
            own = [float(value) for value in (values if equals else options.values or "").split(",") if value]
        except ValueError:
            sys.exit(f"scripts/bench tune: '{values or options.values}' are not numbers, separated by commas")
        for why in filter(None, (refused(options.program, name, value) for value in own)):
            sys.exit(f"scripts/bench tune: {why}")
        others = [factor * weights[name] for factor in FACTORS]
        own = own or [value for value in others if not refused(options.program, name, value)]
        asked[name] = sorted({*own, weights[name]})
    return asked


def judged(program, name, option, value):
    """Smear, holes, zippers and seconds of one print; option None: with all weights as they are."""
    output = FOLDER / f"{name}.{option}={value:g}.gcode" if option else FOLDER / f"{name}.gcode"
    added = ["--set", f"{option}={value:g}"] if option else []
    slice_with_ours(program, name, output, added)
    judgement = audited(program, output)
    output.unlink()
    return [*(figure(judgement, key) for key in ("smear_volume", "hole_volume", "zippers_visible")), judgement["print"]["time_s"]]


def sums(results, names):
    """The four figures, summed over those models that were sliced; None where none was."""
    rows = [results[name] for name in names if name in results]
    return [sum(column) for column in zip(*rows)] if rows else None


def table(option, default, by_value):
    """Markdown of one option. by_value: {value: {name: four figures}}"""
    head = [f"{half}: smear, mm3 | holes, mm3 | both | zippers | minutes" for half in HALVES]
    lines = [f"| {option} | " + " | ".join(head) + " |", "|" + "---|" * (1 + 5 * len(HALVES))]
    for value, results in by_value.items():
        mark = "**" if value == default else ""
        cells = [f"{mark}{value:g}{mark}"]
        for names in HALVES.values():
            total = sums(results, names)
            if total is None:
                cells += ["-"] * 5
                continue
            smear, holes, zippers, seconds = total
            cells += [f"{smear:.2f}", f"{holes:.2f}", f"{smear + holes:.2f}", f"{zippers:.0f}", f"{seconds / 60:.0f}"]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def tables(program, names, asked, weights):
    """Each option's table, as soon as it is whole. What is printed with the defaults alone is printed once."""
    unchanged = dict(zip(names, two_at_a_time(judged, [(program, name, None, 0) for name in names])))
    for option, values in asked.items():
        runs = [(value, name) for value in values if value != weights[option] for name in names]
        by_value = {value: dict(unchanged) if value == weights[option] else {} for value in values}
        found = two_at_a_time(judged, [(program, name, option, value) for value, name in runs])
        for (value, name), figures in zip(runs, found):
            by_value[value][name] = figures
        yield table(option, weights[option], by_value)


def main():
    known = [name for names in HALVES.values() for name in names]
    parser = argparse.ArgumentParser(prog="scripts/bench tune", description=__doc__)
    parser.add_argument("--option", action="append", metavar="NAME[=VALUE,...]",
                        help="a weight of the planner, and its values; repeatable (default: all weights)")
    parser.add_argument("--values", help="of each option that names none, comma-separated (default: its default x "
                        + ", ".join(map(str, FACTORS)) + ")")
    parser.add_argument("--models", default=",".join(known), help="comma-separated, of: " + ", ".join(known))
    parser.add_argument("--program", type=Path, help="our program (default: the release build, made first)")
    parser.add_argument("--write", action="store_true", help="write the tables of docs/benchmarks.md, instead of those there")
    options = parser.parse_args()
    models.require(options.models, known, "scripts/bench tune")
    require_shared("scripts/bench tune")
    FOLDER.mkdir(parents=True, exist_ok=True)
    try:
        weights = defaults(options.program)
        made = []
        for text in tables(options.program, options.models.split(","), wanted(options, weights), weights):
            print(text, flush=True)
            made.append(text)
    except RuntimeError as trouble:
        sys.exit(f"scripts/bench tune: {trouble}")
    if options.write:
        replace_between_markers(models.ROOT / "docs" / "benchmarks.md", "scripts/bench tune --write", "\n".join(made))


if __name__ == "__main__":
    main()
