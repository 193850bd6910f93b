"""Writes G-code of PrusaSlicer in the words of OrcaSlicer, BambuStudio or SuperSlicer, for tests and benchmarks.

  orca_dialect.py in.gcode out.gcode [--bambu | --super] [--relative-e] [--klipper] [--lift MM]

Roads stay. Comments, header, configuration block, labels of objects, accelerations of travel, lifts on the way and in a spiral,
and tool changes are as OrcaSlicer 2.4 and BambuStudio 2 have them.
"""

import argparse
import math
import re
from pathlib import Path

TYPES = {"Perimeter": "Inner wall", "External perimeter": "Outer wall", "Overhang perimeter": "Overhang wall",
         "Internal infill": "Sparse infill", "Solid infill": "Internal solid infill", "Top solid infill": "Top surface",
         "Bridge infill": "Bridge", "Gap fill": "Gap infill", "Skirt/Brim": "Skirt", "Support material": "Support",
         "Support material interface": "Support interface", "Wipe tower": "Prime tower", "Ironing": "Ironing"}
SUPER_TYPES = {"Perimeter": "Internal perimeter", "Skirt/Brim": "Skirt"}
NAMES = {"nozzle_diameter": "nozzle_diameter", "extruder_offset": "extruder_offset", "bed_shape": "printable_area",
         "max_print_height": "printable_height", "retract_length": "retraction_length", "retract_speed": "retraction_speed",
         "deretract_speed": "deretraction_speed", "retract_before_travel": "retraction_minimum_travel",
         "retract_layer_change": "retract_when_changing_layer", "retract_length_toolchange": "retract_length_toolchange",
         "retract_restart_extra": "retract_restart_extra", "filament_diameter": "filament_diameter",
         "filament_density": "filament_density", "extrusion_multiplier": "filament_flow_ratio", "temperature": "nozzle_temperature",
         "first_layer_temperature": "nozzle_temperature_initial_layer", "filament_colour": "filament_colour",
         "filament_max_volumetric_speed": "filament_max_volumetric_speed", "layer_height": "layer_height",
         "first_layer_height": "initial_layer_print_height", "extrusion_width": "line_width",
         "external_perimeter_extrusion_width": "outer_wall_line_width", "perimeter_extrusion_width": "inner_wall_line_width",
         "infill_extrusion_width": "sparse_infill_line_width", "first_layer_extrusion_width": "initial_layer_line_width",
         "external_perimeter_speed": "outer_wall_speed", "perimeter_speed": "inner_wall_speed", "infill_speed": "sparse_infill_speed",
         "first_layer_speed": "initial_layer_speed", "travel_speed": "travel_speed", "travel_speed_z": "travel_speed_z",
         "wipe": "wipe", "skirt_height": "skirt_height"}
SLOPE = math.tan(math.radians(3))
DRIVING, PRINTING = 6000, 1000  # mm/s2
WORD = re.compile(r"([XYZEF])(-?[0-9.]+)")


def number(value, digits=3):
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return re.sub(r"^(-?)0\.", r"\1.", text) or "0"


class Rewriter:
    def __init__(self, lines, options):
        self.lines, self.options, self.out = lines, options, []
        self.at, self.z, self.told_z, self.count, self.back = (0.0, 0.0), 0.0, 0.0, 0.0, False
        self.lifted = self.waits = self.in_object = self.in_layers = self.in_tower = self.in_wipe = False
        self.last_road, self.acceleration, self.since_progress, self.layer, self.told_layer = 0, None, 0, 0, 0
        self.config = dict(re.findall(r"^; (\w+) = (.*)$", "\n".join(lines), re.M))

    def comment(self, plain, bambu):
        self.out.append(bambu if self.options.bambu else plain)

    def accelerate(self, to):
        if self.acceleration == to or self.in_tower:
            return
        self.acceleration = to
        self.out.append(f"SET_VELOCITY_LIMIT ACCEL={to}" if self.options.klipper else f"M204 S{to}")

    def label(self, begins):
        if begins == self.in_object:
            return
        self.in_object = begins
        if begins:
            if self.options.bambu:
                lines = ["; OBJECT_ID: 15", "; start printing object, unique label id: 15", "M624 AQAAAAAAAAA="]
            else:
                lines = ["; printing object bars.stl id:0 copy 0"]
                if self.options.klipper:
                    lines.append("EXCLUDE_OBJECT_START NAME=bars.stl_id_0_copy_0")
            self.out += lines
            return
        lines = ["; stop printing object bars.stl id:0 copy 0"]
        if self.options.bambu:
            lines = ["; stop printing object, unique label id: 15", "M625"]
        elif self.options.klipper:
            lines = ["EXCLUDE_OBJECT_END NAME=bars.stl_id_0_copy_0"] + lines
        self.out[self.last_road:self.last_road] = lines

    def spiral(self):
        """Seven steps round a circle, as OrcaSlicer lifts before tools and layers change."""
        if not self.options.lift or self.lifted:
            return
        x, y = self.at
        radius = self.options.lift / (2 * math.pi * SLOPE)
        self.out.append("G1 F7200")
        for step in range(1, 8):
            turn = 2 * math.pi * step / 7
            place = (x + radius * math.sin(turn), y + radius * (1 - math.cos(turn))) if step < 7 else (x, y)
            height = self.z + self.options.lift * step / 7
            self.out.append(f"G1 X{number(place[0])} Y{number(place[1])} Z{number(height, 6)}")
        self.told_z, self.lifted = self.z + self.options.lift, True

    def travel(self, x, y, rest):
        if self.options.super:
            self.out.append("; acceleration to travel")
        self.accelerate(DRIVING)
        height = ""
        if self.options.lift and self.back and not self.in_tower and self.told_z > 0:
            top = self.z + self.options.lift
            length = math.dist(self.at, (x, y))
            if not self.lifted and length * SLOPE > self.options.lift:
                share = self.options.lift / SLOPE / length
                middle = [a + (b - a) * share for a, b in zip(self.at, (x, y))]
                self.out.append(f"G1 X{number(middle[0])} Y{number(middle[1])} Z{number(top)} F7200")
            height, self.told_z, self.lifted = f" Z{number(top)}", top, True
        if self.options.super:  # brakes for the road on the way
            middle = [(a + b) / 2 for a, b in zip(self.at, (x, y))]
            self.out.append(f"G1 X{number(middle[0])} Y{number(middle[1])}{height}{rest}")
            self.out.append("; decel to extrusion")
            self.accelerate(PRINTING)
        self.out.append(f"G1 X{number(x)} Y{number(y)}{height}{rest}")
        if self.options.super:
            self.out.append("; end travel")
        self.at = (x, y)

    def feed(self, line):
        """E as it is to be told."""
        words = dict(WORD.findall(line))
        if "E" not in words:
            return line, 0.0
        told = float(words["E"])
        if self.relative_in:
            return line, told
        fed, self.count = told - self.count, told
        return (re.sub(r"E-?[0-9.]+", f"E{number(fed, 5)}", line) if self.options.relative_e else line), fed

    def move(self, line):
        words = {axis: float(value) for axis, value in WORD.findall(line.split(";", 1)[0])}
        line, fed = self.feed(line)
        to = (words.get("X", self.at[0]), words.get("Y", self.at[1]))
        across = to != self.at
        if not self.in_layers or self.in_tower:
            self.out.append(line)
            self.at = to
            self.z = words.get("Z", self.z)
            self.told_z = self.z
            self.back = (self.back or fed < 0) and fed <= 0
            self.last_road = len(self.out)
        elif "Z" in words and not across:
            self.z = words["Z"]
            if self.options.lift and self.back and self.layer > 1:
                self.lifted = False
                self.spiral()
            else:
                self.out.append(line)
        elif fed < 0:
            self.back = True
            self.out.append(line)
            self.at = to
            if self.options.bambu and self.layer != self.told_layer:
                self.told_layer = self.layer
                self.out += [f"; layer num/total_layer_count: {self.layer}/{self.lines.count(';LAYER_CHANGE')}",
                             "; update layer progress", f"M73 L{self.layer}", f"M991 S0 P{self.layer - 1} ;notify layer change"]
        elif fed > 0 and not across:
            if self.lifted:
                self.out.append(f"G1 Z{number(self.z)}")
                self.lifted = False
            self.back = False
            self.out.append(line)
        elif fed > 0:
            self.accelerate(PRINTING)
            self.out.append(line)
            self.at = to
            self.last_road = len(self.out)
        elif across:
            self.travel(*to, "" if "F" not in words else f" F{number(words['F'])}")
        else:
            self.out.append(line)

    def progress(self):
        self.since_progress += 1
        if self.options.klipper and self.in_layers and self.since_progress % 60 == 0:
            share = min(99, self.since_progress * 100 // len(self.lines))
            self.out.append(f"M73 P{share} R{(100 - share) // 10}")

    def begin_layer(self):
        self.label(False)
        self.in_layers = True
        self.layer += 1
        self.comment(";LAYER_CHANGE", "; CHANGE_LAYER")

    def body(self):
        self.relative_in = any(line.startswith("M83") for line in self.lines)
        for line in self.lines:
            if line.startswith("; prusaslicer_config = begin") or line.startswith("; objects_info"):
                break
            if line == ";LAYER_CHANGE":
                self.begin_layer()
            elif line.startswith(";Z:"):
                self.comment(line, "; Z_HEIGHT: " + line[3:])
            elif line.startswith(";HEIGHT:"):
                self.comment(line, "; LAYER_HEIGHT: " + line[8:])
            elif line.startswith(";WIDTH:"):
                self.comment(line, "; LINE_WIDTH: " + line[7:])
            elif line.startswith(";TYPE:"):
                kind = (SUPER_TYPES if self.options.super else TYPES).get(line[6:], line[6:])
                if self.layer == 1 and kind == "Internal solid infill":
                    kind = "Bottom surface"
                self.in_tower = kind in ("Prime tower", "Wipe tower")
                if self.in_tower:
                    self.label(False)
                self.comment(";TYPE:" + kind, "; FEATURE: " + kind)
            elif line in (";WIPE_START", ";WIPE_END"):
                self.comment(line, "; " + line[1:])
            elif re.match(r"T\d", line) and self.in_layers and not self.in_tower:
                self.label(False)
                end = len(self.out)  # behind what ends the filament's use
                while self.out[end - 1].startswith((";END", "; Filament-specific")):
                    end -= 1
                tail, self.out[end:] = self.out[end:], []
                self.spiral()
                self.out += ["; filament end gcode"] if tail else []
                self.out.append(line)
                self.waits = True
            elif line.startswith("M82") and self.options.relative_e:
                self.out.append("M83 ; use relative distances for extrusion")
            elif line.startswith("G92 E0"):
                self.count = 0.0
                if not self.options.relative_e or not self.in_layers:
                    self.out.append(line)
                if self.waits:
                    self.out.append("M109 S230")
                    self.waits = False
            elif line.startswith(("G1 ", "G0 ")):
                if self.in_layers and not self.in_tower and not self.in_object and re.match(r"G1 X\S+ Y\S+( F\S+)?$", line):
                    self.label(True)
                self.move(line)
                self.progress()
            elif line.startswith("; filament used [mm]"):
                self.label(False)
                self.out += [line] if self.options.super else ["; EXECUTABLE_BLOCK_END", "", line]
            elif line.startswith("; Filament gcode"):
                self.out.append("; filament start gcode")
            elif line.startswith("; generated by"):
                continue
            else:
                self.out.append(line)
        return self.out

    def config_block(self):
        names = {orca: self.config[ours] for ours, orca in NAMES.items() if ours in self.config}
        extruders = self.config["nozzle_diameter"].count(",") + 1
        lift = number(self.options.lift) if self.options.lift else "0"
        names |= {"z_hop": ",".join([lift] * extruders), "z_hop_types": ",".join(["Auto Lift"] * extruders),
                  "travel_slope": ",".join(["3"] * extruders), "retract_lift_above": ",".join(["0"] * extruders),
                  "retract_lift_below": ",".join(["249"] * extruders), "single_extruder_multi_material": "0",
                  "gcode_flavor": "klipper" if self.options.klipper else "marlin", "spiral_mode": "0",
                  "use_relative_e_distances": str(int(self.options.relative_e or self.relative_in)),
                  "print_sequence": "by layer", "wall_sequence": "inner wall/outer wall", "is_infill_first": "0",
                  "ironing_type": "no ironing", "enable_prime_tower": self.config.get("wipe_tower", "0"),
                  "filament_retraction_length": ",".join(["nil"] * extruders), "seam_gap": "15%",
                  "machine_max_speed_x": "500,200", "machine_max_acceleration_x": "9000,9000",
                  "machine_max_acceleration_y": "9000,9000", "sparse_infill_pattern": "crosshatch",
                  "brim_type": "auto_brim", "seam_position": "aligned", "wall_generator": "arachne", "use_firmware_retraction": "0",
                  "ooze_prevention": "0", "printer_model": "two nozzles"}
        return ["; CONFIG_BLOCK_START", *(f"; {key} = {value}" for key, value in sorted(names.items())), "; CONFIG_BLOCK_END", ""]

    def super_text(self, body):
        config = self.config | {"extrusion_width": "100%", "first_layer_height": "75%", "retract_lift_top": '"All surfaces"',
                                "retract_lift_below": "9999", "infill_speed": "80%", "seam_position": "cost",
                                "print_retract_length": "-1", "print_retract_lift": "-1"}
        config.pop("prusaslicer_config", None)
        block = ["; SuperSlicer_config = begin", *(f"; {key} = {value}" for key, value in sorted(config.items())),
                 "; SuperSlicer_config = end", ""]
        return "\n".join(["; generated by SuperSlicer 2.5.59 on 2026-09-07 at 20:41:08 UTC", "", *body, *block])

    def text(self):
        body = self.body()
        if self.options.super:
            return self.super_text(body)
        body = [line for line in body if not line.startswith("; prusaslicer")]
        first = next(i for i, line in enumerate(body) if line.startswith(("M", "G")))
        producer = "; BambuStudio 02.03.01.51" if self.options.bambu else "; generated by OrcaSlicer 2.4.2 on 2026-09-07 at 20:41:08"
        estimate = next((line for line in body if line.startswith("; estimated printing time (normal")), "")
        seconds = estimate.partition("= ")[2]
        header = ["; HEADER_BLOCK_START", producer]
        if self.options.bambu and seconds:
            header.append(f"; model printing time: {seconds}; total estimated time: {seconds}")
            body.remove(estimate)
            used = next((line for line in body if line.startswith("; filament used [mm] = ")), "")
            header.append("; total filament length [mm] : " + used.partition("= ")[2].replace(", ", ","))
        header += [f"; total layer number: {self.layer}", f"; filament_diameter: {self.config['filament_diameter']}",
                   f"; max_z_height: {self.z:.2f}", "; filament: 1,2", "; HEADER_BLOCK_END", ""]
        begin = ["; EXECUTABLE_BLOCK_START"]
        config = self.config_block()
        parts = header + config + begin + body[first:] if self.options.bambu else header + body[:first] + begin + body[first:] + config
        return "\n".join(parts) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--bambu", action="store_true", help="in the words for Bambu's printers")
    parser.add_argument("--super", action="store_true", help="in the words of SuperSlicer")
    parser.add_argument("--relative-e", action="store_true")
    parser.add_argument("--klipper", action="store_true")
    parser.add_argument("--lift", type=float, default=0.0)
    options = parser.parse_args()
    options.output.write_text(Rewriter(options.input.read_text().splitlines(), options).text())


if __name__ == "__main__":
    main()
