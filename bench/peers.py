"""The pairs of ../shared/models/paper sliced by others, by the command lines of ../shared/peers, and by us.

G-code is kept in build/bench/quality/. Needs what `scripts/setup peers` installs.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

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
# What they cannot make: plain files with more options. Kept and judged as if they could.
SUPPORTS = ["--support-material", "--support-material-auto"]
ADDED = {
    "prusa": {
        "support": SUPPORTS,
        "soluble": [*SUPPORTS, "--support-material-contact-distance=0", "--support-material-extruder=1",
                    "--support-material-interface-extruder=2", "--support-material-synchronize-layers"],
        "raft": [*SUPPORTS, "--raft-layers=3"],
        "ironing": ["--ironing"],
    },
    "cura": {"support": {"support_enable": True}, "raft": {"support_enable": True, "adhesion_type": "raft"},
             "ironing": {"ironing_enabled": True}},
}
PROGRAMS = {"prusa": "prusa-slicer", "slic3r": "slic3r", "cura": "CuraEngine"}


def require_shared(script):
    """Ends the script where the models and command lines are absent."""
    for place in (PEERS, models.SETTINGS, models.stl_pair("crystal")[0]):
        if not place.exists():
            sys.exit(f"{script}: {place} is absent; it is looked for there, or in the folder that CLEANCOLOR_SHARED names")


def kept(name, slicer, variant):
    return KEPT / f"{name}.{slicer}.{variant}.gcode"


def run_peer(command, what, output, **environment):
    """Runs what makes `output`, under another name until it is whole: an interrupted run leaves nothing that looks so."""
    unfinished = output.with_name("unfinished-" + output.name)
    log = subprocess.run([unfinished if word is output else word for word in command], stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, env={"OFFSET": "33,0", **os.environ, **environment})
    if log.returncode != 0 or not unfinished.exists():
        raise RuntimeError(f"{what}:\n{log.stdout[-1500:]}")
    unfinished.rename(output)


def prusa_with(added, name, output):
    """The command for the settings of the plain file, which is made where it is not there, and more."""
    return ["prusa-slicer", "--loglevel", "1", "--load", sliced(None, name, "prusa", "plain"), *added, "--center", "0,0", "-g",
            "-o", output, models.amf(name)]


def cura_with(added, name, output, folder):
    """Likewise, by the definitions that the plain file is made by."""
    kept = folder / "defs"
    slice_with_peer(name, "cura", "plain", folder / "plain.gcode", KEEP=str(kept))
    for file in kept.iterdir():
        definition = json.loads(file.read_text())
        for settings in definition["settings"].values():
            for setting, value in added.items():
                settings["children"][setting]["default_value"] = value
        file.write_text(json.dumps(definition))
    a, b = models.stl_pair(name)
    return ["CuraEngine", "slice", "-j", kept / "global.def.json", "-e0", "-j", kept / "ext0.def.json", "-e1", "-j",
            kept / "ext1.def.json", "-o", output, "-e0", "-l", a, "-s", "extruder_nr=0", "-e1", "-l", b, "-s", "extruder_nr=1"]


def slice_with_peer(name, slicer, variant, output, **environment):
    if not shutil.which(PROGRAMS[slicer]):
        raise RuntimeError(f"{PROGRAMS[slicer]} is not installed; run scripts/setup peers")
    with tempfile.TemporaryDirectory() as folder:
        added = ADDED.get(slicer, {}).get(variant)
        if added is None:
            command = ["bash", PEERS / f"slice-{slicer}.sh", *models.stl_pair(name), output, variant]
        else:
            command = prusa_with(added, name, output) if slicer == "prusa" else cura_with(added, name, output, Path(folder))
        run_peer(command, f"{slicer} {variant} does not slice {name}", output, **environment)


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
