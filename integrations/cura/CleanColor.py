"""A post-processing script of Cura: cleancolor gives the G-code its order, travel and rampart.

Put this file into the folder "scripts" of Cura's configuration folder (Help, Show Configuration Folder), restart Cura, and
add "cleancolor: keep colours clean" in Extensions, Post Processing, Modify G-Code. See docs/replan.md of cleancolor.

Where the nozzles are, the bed and the filament come from the active printer. What cannot be re-planned stays as it is, with
a message that says why.
"""

import json
import math
import os
import re
import shutil
import subprocess
import tempfile

from ..Script import Script

USUAL_FILAMENT_MM = 1.75
LAYER = re.compile("^;LAYER:", re.MULTILINE)
EXTRUDER_KEYS = ("machine_nozzle_offset_x", "machine_nozzle_offset_y", "machine_nozzle_size", "material_diameter")
GLOBAL_KEYS = (
    "machine_width",
    "machine_depth",
    "machine_height",
    "machine_center_is_zero",
    "machine_shape",
    "machine_use_extruder_offset_to_offset_coords",
)
# A window of its own would open with the program on Windows.
WINDOWLESS = getattr(subprocess, "CREATE_NO_WINDOW", 0)


class CleanColorError(Exception):
    pass


class CleanColor(Script):
    def getSettingDataString(self):
        return json.dumps(
            {
                "name": "cleancolor: keep colours clean",
                "key": "CleanColor",
                "metadata": {},
                "version": 2,
                "settings": {
                    "program": {
                        "label": "Program",
                        "description": "Where the program cleancolor is: its full path, or its name where it is in the PATH.",
                        "type": "str",
                        "default_value": "cleancolor",
                    },
                    "nozzle_offset": {
                        "label": "Nozzle offset",
                        "description": "Where each nozzle is as seen from the first, mm: 0x0,33x0. Empty: as the settings of the "
                        "active printer say.",
                        "type": "str",
                        "default_value": "",
                    },
                    "protect": {
                        "label": "Protection",
                        "description": "Full: order, travel and rampart are planned. Rampart: it is added, order and travel are "
                        "plain.",
                        "type": "enum",
                        "options": {"full": "Full", "rampart": "Rampart"},
                        "default_value": "full",
                    },
                },
            }
        )

    def execute(self, data):
        try:
            printer = active_printer()
            text = re_planned(
                with_filament("".join(data), printer),
                self.getSettingValueByKey("program"),
                self.getSettingValueByKey("nozzle_offset"),
                self.getSettingValueByKey("protect"),
                printer,
            )
        except (CleanColorError, OSError, UnicodeError) as fault:
            tell("cleancolor left the G-code as it was sliced", str(fault))
            return data
        return split_as(text, data)


def active_printer():
    """Settings of the active machine, and under "extruders" those of each extruder; None outside Cura."""
    try:
        from UM.Application import Application

        stack = Application.getInstance().getGlobalContainerStack()
        extruders = [values(extruder, EXTRUDER_KEYS) for extruder in stack.extruderList]
        printer = values(stack, GLOBAL_KEYS)
    except (ImportError, AttributeError, TypeError):
        return None
    printer["extruders"] = extruders
    return printer


def values(stack, keys):
    return {key: stack.getProperty(key, "value") for key in keys}


def number(value, otherwise=0.0):
    try:
        return float(value)
    except (TypeError, ValueError):
        return otherwise


def offsets_mm(printer):
    """[(x, y)] as seen from the first nozzle; [] where the printer has them all at one place, that is, does not say."""
    places = [(number(e["machine_nozzle_offset_x"]), number(e["machine_nozzle_offset_y"])) for e in printer["extruders"]]
    if not places or all(place == places[0] for place in places):
        return []
    return [(x - places[0][0], y - places[0][1]) for x, y in places]


def bed_mm(printer):
    """The corners of a rectangle, or a polygon in a round bed; [] where the size is not known."""
    width, depth = number(printer["machine_width"]), number(printer["machine_depth"])
    if width <= 0 or depth <= 0:
        return []
    left, front = (-width / 2, -depth / 2) if printer["machine_center_is_zero"] else (0.0, 0.0)
    if printer["machine_shape"] == "elliptic":
        turns = [2 * math.pi * i / 16 for i in range(16)]
        return [(left + width * (1 + math.cos(a)) / 2, front + depth * (1 + math.sin(a)) / 2) for a in turns]
    return [(left, front), (left + width, front), (left + width, front + depth), (left, front + depth)]


def points(places):
    return "[" + ", ".join(f"[{x:.3f}, {y:.3f}]" for x, y in places) + "]"


def offsets_in(printer):
    return "slicer" if printer["machine_use_extruder_offset_to_offset_coords"] else "firmware"


def told_offsets_mm(text):
    """[(x, y)] of "0x0,33x0"."""
    try:
        return [(float(x), float(y)) for x, y in (place.split("x") for place in text.split(","))]
    except ValueError:
        raise CleanColorError(f"Nozzle offset: '{text}' is not like 0x0,33x0.") from None


def profile(printer, where):
    """The printer in cleancolor's own words, as TOML; empty where too little is known.  where: offsets of its nozzles."""
    bed, extruders = bed_mm(printer), printer["extruders"]
    if not bed or not extruders or len(where) != len(extruders):
        return ""
    sizes = ", ".join(f"{number(e['machine_nozzle_size'], 0.4):.3f}" for e in extruders)
    lines = [
        'description = "the active printer of Cura"',
        'printer_model = "active printer of Cura"',
        f"bed_shape = {points(bed)}",
        f"nozzle_diameter = [{sizes}]",
        f"nozzle_offset = {points(where)}",
        f'offsets_in = "{offsets_in(printer)}"',
    ]
    height = number(printer["machine_height"])
    if height > 0:
        lines.append(f"max_print_height = {height:.3f}")
    return "\n".join(lines) + "\n"


def with_filament(text, printer):
    """With a comment that says how thick the filament is where that is not the usual: E alone does not tell."""
    extruders = printer["extruders"] if printer else []
    diameters = [number(e["material_diameter"], USUAL_FILAMENT_MM) for e in extruders]
    if all(abs(d - USUAL_FILAMENT_MM) < 0.01 for d in diameters):
        return text
    head, end, rest = text.partition("\n")
    told = ",".join(f"{d:g}" for d in diameters)
    return f"{head}{end}; filament_diameter = {told}\n{rest}"


def command(program, offset, protect, printer, folder):
    words = [program, "replan", "--post-process", "--keep-going", "--quiet"]
    if protect and protect != "full":
        words += ["--protect", protect]
    if offset:
        words += ["--nozzle-offset", offset]
    if not printer:
        return words
    several = len(printer["extruders"]) > 1
    where = told_offsets_mm(offset) if offset else offsets_mm(printer) if several else [(0.0, 0.0)]
    if not where:
        raise CleanColorError(
            "The settings of the printer do not say where its nozzles are (Nozzle offset X and Y of the extruders). Say it in "
            "the settings of this script, as 0x0,33x0."
        )
    toml = profile(printer, where)
    if toml:
        path = os.path.join(folder, "printer.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(toml)
        words += ["--printer", path]
    return words + ["--offsets-in", offsets_in(printer)]


def re_planned(text, program, offset, protect, printer):
    """Throws CleanColorError where the program cannot be run, or left the file as it was."""
    found = shutil.which(os.path.expanduser(program or "cleancolor"))
    if not found:
        raise CleanColorError(f"The program '{program}' is not there; say where it is in the settings of this script.")
    with tempfile.TemporaryDirectory(prefix="cleancolor-") as folder:
        path = os.path.join(folder, "cura.gcode")
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        words = command(found, (offset or "").replace(" ", ""), protect, printer, folder) + [path]
        done = subprocess.run(
            words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, creationflags=WINDOWLESS
        )
        with open(path, encoding="utf-8", newline="") as file:
            result = file.read()
    said = [line.replace(path, "the print") for line in done.stderr.splitlines() if line.strip()]
    if done.returncode != 0 or result == text:
        raise CleanColorError(said[-1] if said else f"It ended with code {done.returncode}.")
    for line in said:
        log(line)
    return result


def split_as(text, data):
    """The text in as many pieces as Cura's: its head, one for each layer, its end; other scripts and the preview count them."""
    layers = [i for i, piece in enumerate(data) if LAYER.search(piece)]
    starts = [found.start() for found in LAYER.finditer(text)]
    if not layers or not starts:
        return [text]
    first, last = layers[0], layers[-1]
    head = text[: starts[0]]
    pieces = [text[a:b] for a, b in zip(starts, starts[1:] + [len(text)])]
    # Head and end are as they were, but for the line of ours, and the time, in the first piece.
    before_layer = data[first][: LAYER.search(data[first]).start()]
    kept = "".join(data[1:first]) + before_layer
    if first > 0 and head.endswith(kept):
        pieces[0] = before_layer + pieces[0]
        heads = [head[: len(head) - len(kept)], *data[1:first]]
    else:
        heads = [head]
    ends = data[last + 1 :]
    end = "".join(ends)
    if ends and pieces[-1].endswith(end):
        pieces[-1] = pieces[-1][: len(pieces[-1]) - len(end)]
        pieces += ends
    return heads + pieces


def log(text):
    try:
        from UM.Logger import Logger

        Logger.log("i", "cleancolor: %s", text)
    except ImportError:
        pass


def tell(title, text):
    log(f"{title}: {text}")
    try:
        from UM.Message import Message

        Message(text, title=title).show()
    except ImportError:
        print(f"{title}: {text}")
