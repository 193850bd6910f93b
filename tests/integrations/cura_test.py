"""Cura's post-processing script, integrations/cura/CleanColor.py, with Cura's own classes stubbed.

    cura_test.py PROGRAM    PROGRAM: cleancolor, as it was built
"""

import importlib.util
import re
import sys
import types
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else "cleancolor"
MACHINE = {
    "machine_width": 225,
    "machine_depth": 145,
    "machine_height": 150,
    "machine_center_is_zero": True,
    "machine_shape": "rectangular",
    "machine_use_extruder_offset_to_offset_coords": True,
}
EXTRUDER = {"machine_nozzle_offset_y": 0, "machine_nozzle_size": 0.4, "material_diameter": 1.75}


class Script:
    """What Cura's base class does for a script: it knows the values of its settings."""

    def __init__(self):
        import json

        described = json.loads(self.getSettingDataString())
        self.values = {key: setting["default_value"] for key, setting in described["settings"].items()}

    def getSettingValueByKey(self, key):
        return self.values[key]


class Stack:
    def __init__(self, settings, extruders=()):
        self.settings, self.extruderList = settings, list(extruders)

    def getProperty(self, key, name):
        return self.settings[key] if name == "value" else None


class Message:
    shown = []

    def __init__(self, text, title=""):
        self.text = text

    def show(self):
        Message.shown.append(self.text)


def module(name, **names):
    made = types.ModuleType(name)
    made.__dict__.update(names)
    made.__path__ = []
    sys.modules[name] = made
    return made


def loaded():
    module("plugin")
    module("plugin.Script", Script=Script)
    module("plugin.scripts")
    path = ROOT / "integrations" / "cura" / "CleanColor.py"
    spec = importlib.util.spec_from_file_location("plugin.scripts.CleanColor", path)
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def use_machine(machine=None, offsets=(0, 33), extruder=None):
    extruders = [Stack({**EXTRUDER, **(extruder or {}), "machine_nozzle_offset_x": x}) for x in offsets]
    stack = Stack({**MACHINE, **(machine or {})}, extruders)
    application = types.SimpleNamespace(getGlobalContainerStack=lambda: stack)
    module("UM")
    module("UM.Application", Application=types.SimpleNamespace(getInstance=lambda: application))
    module("UM.Message", Message=Message)
    module("UM.Logger", Logger=types.SimpleNamespace(log=lambda *words: None))


def sliced():
    """As Cura hands it to its scripts: the head, the start code, each layer, the end code."""
    text = (ROOT / "tests" / "replan" / "files" / "cura.gcode").read_text()
    begin, end = text.index("\n\n") + 1, text.index("M140 S0\nM104 S0 T0")
    layers = re.split("(?m)^(?=;LAYER:)", text[begin:end])
    return [text[:begin], *layers, text[end:]]


def script(**settings):
    made = loaded().CleanColor()
    made.values.update({"program": PROGRAM, **settings})
    return made


class CuraScript(unittest.TestCase):
    def setUp(self):
        Message.shown = []
        use_machine()

    def test_re_plans_for_the_active_machine(self):
        data = sliced()
        result = "".join(script().execute(list(data)))
        self.assertEqual(Message.shown, [])
        self.assertTrue("; replanned by cleancolor" in result)
        self.assertTrue(";RAMPART_WALL" in result)

    def test_hands_back_head_start_layers_and_end_as_cura_counts_them(self):
        data = sliced()
        result = script().execute(list(data))
        self.assertEqual(len(result), len(data))
        for k in range(len(data) - 3):
            self.assertTrue(result[k + 2].startswith(f";LAYER:{k}\n"), k)
        self.assertEqual(result[1], data[1])
        self.assertEqual(result[-1], data[-1])

    def test_finds_no_end_where_cura_has_none(self):
        data = sliced()
        joined = [data[0] + data[1], *data[2:-2], data[-2] + data[-1]]
        self.assertEqual(len(script().execute(list(joined))), len(joined))

    def test_leaves_what_is_refused_as_it_is_and_says_why(self):
        data = sliced()
        data[3] = data[3].replace(";TYPE:", "M600\n;TYPE:", 1)
        self.assertTrue(script().execute(list(data)) == data)
        self.assertEqual(len(Message.shown), 1)
        self.assertIn("M600", Message.shown[0])

    def test_says_where_the_program_is_not(self):
        data = sliced()
        self.assertTrue(script(program="/nowhere/cleancolor").execute(list(data)) == data)
        self.assertIn("/nowhere/cleancolor", Message.shown[0])

    def test_asks_for_offsets_that_the_machine_does_not_say(self):
        data = sliced()
        use_machine(offsets=(0, 0))
        self.assertTrue(script().execute(list(data)) == data)
        self.assertIn("0x0,33x0", Message.shown[0])
        self.assertTrue(script(nozzle_offset="0x0, 33x0").execute(list(data)) != data)

    def test_puts_no_rampart_where_the_bed_ends(self):
        use_machine(machine={"machine_width": 41, "machine_depth": 17})
        result = "".join(script().execute(sliced()))
        self.assertTrue("; replanned by cleancolor" in result)
        self.assertFalse(";RAMPART_WALL" in result)

    def test_tells_how_thick_the_filament_is_where_it_is_not_usual(self):
        code = loaded()
        use_machine(extruder={"material_diameter": 2.85})
        self.assertIn("; filament_diameter = 2.85,2.85\n", code.with_filament(sliced()[0], code.active_printer()))
        use_machine()
        self.assertEqual(code.with_filament("a\nb", code.active_printer()), "a\nb")

    def test_knows_round_beds(self):
        code = loaded()
        use_machine(machine={"machine_shape": "elliptic", "machine_center_is_zero": False, "machine_width": 200, "machine_depth": 200})
        for x, y in code.bed_mm(code.active_printer()):
            self.assertAlmostEqual((x - 100) ** 2 + (y - 100) ** 2, 100**2)


if __name__ == "__main__":
    unittest.main()
