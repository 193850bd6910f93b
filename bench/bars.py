"""What must hold of how clean our prints come out, against the best of the others, and of what that costs.

The best of the others is, for each figure by itself and under each variant of the audit, the least over all their variants in
peers.COMPARED; those that print another part count as well, the hardest reading.
"""

from dataclasses import dataclass

from judge import compares, figure, filament_mm3, sensitivity
from peers import COMPARED


@dataclass(frozen=True)
class Bar:
    smear: float = 0.5  # of the best of the others
    zippers: float = 1.0  # of PrusaSlicer's plain
    time: float | None = 1.25  # of our own --protect none; None: no bar
    filament: float | None = 1.20


BARS = {
    "4-cones": Bar(time=None, filament=None),
    "crystal": Bar(),
    "dragon-heart": Bar(smear=0.7, zippers=0.5, time=1.30, filament=1.25),
    "robot-ice": Bar(),
    "rose": Bar(zippers=0.5, time=None, filament=None),
    "spot-cow": Bar(zippers=0.5),
    "two-color-world-50mm": Bar(zippers=0.5),
}
HOLES = 1.0  # of the best of the others, at the same time
UNDER_VARIANTS = 1.0  # smear and holes, of the best of the others under the same variant of the audit
LITTLE_SMEAR_MM3 = 0.2  # less is never too much

VOLUMES = {"smear": "smear_volume", "holes": "hole_volume"}


@dataclass(frozen=True)
class Check:
    """One figure of ours beside another one; bar: the greatest share of it that is allowed."""
    what: str
    ours: float
    other: float
    whose: str
    bar: float | None
    little: float = 0  # ours may be anything below

    @property
    def ratio(self):
        return self.ours / self.other if self.other else float("inf") if self.ours else 0.0

    @property
    def holds(self):
        return self.bar is None or self.ours <= self.bar * self.other + 1e-9 or self.ours < self.little

    @property
    def sentence(self):
        return (f"{self.what} {self.ours:.2f}, {self.ratio:.2f} of {self.other:.2f} ({self.whose}); "
                f"allowed are {self.bar:.2f}" + (f", or less than {self.little}" if self.little else ""))


def best_peer(name, rows, key, scenario):
    """(figure, title) of the least of the others; of equals, one that prints the same part."""
    others = [(slicer, variant) for slicer, variant, _ in COMPARED if slicer != "ours"]
    row = min(others,
              key=lambda row: (figure(rows[row], key, scenario), not compares(name, rows, row)))
    title = next(title for *entry, title in COMPARED if tuple(entry) == row)
    return figure(rows[row], key, scenario), title if compares(name, rows, row) else f"{title}, another part"


def volume_check(name, rows, what, scenario, bar):
    other, whose = best_peer(name, rows, VOLUMES[what], scenario)
    ours = figure(rows["ours", "default"], VOLUMES[what], scenario)
    return Check(what if scenario == "worst" else f"{what} under {scenario}", ours, other, whose, bar,
                 LITTLE_SMEAR_MM3 if what == "smear" else 0)


def checks(name, rows):
    """{column: checks}: of smear, holes, zippers, time, filament one each; of "smear varied" and "holes varied" as many as
    the audit has variants. rows: {(slicer, variant): judgement}"""
    bar, ours, none = BARS[name], rows["ours", "default"], rows["ours", "none"]
    variants = sensitivity(ours)
    zippers = [figure(rows[row], "zippers_visible") for row in (("ours", "default"), ("prusa", "plain"))]
    minutes = [judged["print"]["time_s"] / 60 for judged in (ours, none)]
    cm3 = [filament_mm3(judged) / 1000 for judged in (ours, none)]
    return {
        "smear": [volume_check(name, rows, "smear", "worst", bar.smear)],
        "holes": [volume_check(name, rows, "holes", "worst", HOLES)],
        "smear varied": [volume_check(name, rows, "smear", variant, UNDER_VARIANTS) for variant in variants],
        "holes varied": [volume_check(name, rows, "holes", variant, UNDER_VARIANTS) for variant in variants],
        "zippers": [Check("zippers", *zippers, "PrusaSlicer", bar.zippers)],
        "time": [Check("minutes", *minutes, "--protect none", bar.time)],
        "filament": [Check("cm3 of filament", *cm3, "--protect none", bar.filament)],
    }


def hardest(several):
    """The check that fails, else comes nearest to it; shares of next to nothing count less."""
    return max(several, key=lambda c: (not c.holds, c.ours / max(c.other, c.little, 1e-3)))


def cells(column, check):
    """Table cells of one check; what fails is bold."""
    mark = "" if check.holds else "**"
    if column in ("time", "filament"):
        return [f"{mark}{100 * (check.ratio - 1):+.0f} %{mark}"]
    digits = 0 if column == "zippers" else 2
    pair = f"{mark}{check.ours:.{digits}f} / {check.other:.{digits}f}{mark}"
    if column.endswith("varied"):
        return [f"{check.what.rpartition(' ')[2]}: {pair}"]
    ratio = f"{check.ratio:.2f}" if check.other else "-"
    return [pair, ratio] if column == "zippers" else [f"{pair} ({check.whose})", ratio]


def table(results):
    """Markdown: a line for each model, ours / theirs. results: {name: rows}"""
    lines = ["| model | smear, mm3: ours / best of the others | ratio | holes, mm3 | ratio | "
             "hardest variant of the audit: smear | holes | zippers: ours / PrusaSlicer | ratio | time over --protect none | filament |", "|" + "---|" * 11]
    for name, rows in results.items():
        row = [cell for column, several in checks(name, rows).items() for cell in cells(column, hardest(several))]
        lines.append(" | ".join([f"| {name}", *row]) + " |")
    return "\n".join(lines) + "\n"


def cost_table(results):
    """Markdown: what each step of protection costs in time and filament."""
    steps = ("none", "rampart", "default")
    lines = ["| model | minutes: none / rampart / full | over none: rampart | full | filament, cm3: none / rampart / full | "
             "over none: rampart | full |", "|" + "---|" * 7]
    for name, rows in results.items():
        row = [f"| {name}"]
        for digits, values in ((0, [rows["ours", step]["print"]["time_s"] / 60 for step in steps]),
                               (2, [filament_mm3(rows["ours", step]) / 1000 for step in steps])):
            row.append(" / ".join(f"{value:.{digits}f}" for value in values))
            row += [f"{100 * (value / values[0] - 1):+.0f} %" for value in values[1:]]
        lines.append(" | ".join(row) + " |")
    return "\n".join(lines) + "\n"


def failures(results):
    """What does not hold, as sentences."""
    return [f"{name}: {check.sentence}" for name, rows in results.items()
            for several in checks(name, rows).values() for check in several if not check.holds]
