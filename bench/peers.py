"""The pairs of ../shared/models/paper sliced by others, by the command lines of ../shared/peers, and by us.

G-code is kept in build/bench/quality/. Needs what `scripts/setup peers` installs.
"""

import os
import shutil
import subprocess
import sys

import models

KEPT = models.CACHE / "quality"
PEERS = models.SHARED / "peers"
OFFSETS = "0x0,33x0"  # of the nozzles; the scripts of PEERS want them as in OFFSET

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
PROGRAMS = {"prusa": "prusa-slicer", "slic3r": "slic3r", "cura": "CuraEngine"}


def require_shared(script):
    """Ends the script where the models and command lines are absent."""
    for place in (PEERS, models.SETTINGS, models.stl_pair("crystal")[0]):
        if not place.exists():
            sys.exit(f"{script}: {place} is absent; it is looked for there, or in the folder that CLEANCOLOR_SHARED names")


def kept(name, slicer, variant):
    return KEPT / f"{name}.{slicer}.{variant}.gcode"


def slice_with_peer(name, slicer, variant, output, **settings):
    """settings: what the scripts of PEERS take from their environment."""
    if not shutil.which(PROGRAMS[slicer]):
        raise RuntimeError(f"{PROGRAMS[slicer]} is not installed; run scripts/setup peers")
    unfinished = output.with_name("unfinished-" + output.name)  # an interrupted run leaves nothing that looks whole
    log = subprocess.run(["bash", PEERS / f"slice-{slicer}.sh", *models.stl_pair(name), unfinished, variant],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env={"OFFSET": "33,0", **os.environ, **settings})
    if log.returncode != 0 or not unfinished.exists():
        raise RuntimeError(f"{slicer} {variant} does not slice {name}:\n{log.stdout[-1500:]}")
    unfinished.rename(output)


def slice_with_ours(program, name, output, added, threads=1):
    """Our G-code of one model with the settings of all others and `added` on the command line."""
    done = subprocess.run([program, "slice", *models.stl_pair(name), "--load", models.SETTINGS, "-o", output, "--quiet",
                           "--threads", str(threads), *added], stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"cleancolor {' '.join(added)} does not slice {name}:\n{done.stderr[-1500:]}")


def sliced(program, name, slicer, variant):
    """The G-code file; other slicers' from before where it is there."""
    output = kept(name, slicer, variant)
    KEPT.mkdir(parents=True, exist_ok=True)
    if slicer == "ours":
        slice_with_ours(program, name, output, OURS[variant])
    elif not output.exists():
        slice_with_peer(name, slicer, variant, output)
    return output
