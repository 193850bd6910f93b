"""The benchmark's reader of G-code, bench/plastic.py, on small files made here."""

import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
from plastic import plastic, plastic_per_tool  # noqa: E402

FILAMENT_MM2 = math.pi / 4 * 1.75**2


def lengths(gcode):
    """{(tool, type): mm of filament}"""
    with tempfile.NamedTemporaryFile("w", suffix=".gcode") as file:
        file.write(gcode)
        file.flush()
        return {key: round(volume / FILAMENT_MM2, 6) for key, volume in plastic(file.name).items()}


class Plastic(unittest.TestCase):
    def test_absolute_and_relative_extrusion_give_the_same(self):
        self.assertEqual(lengths(";TYPE:Perimeter\nG92 E0\nG1 X1 E2\nG1 X2 E5\n"), {(0, "Perimeter"): 5})
        self.assertEqual(lengths("M83\n;TYPE:Perimeter\nG1 X1 E2\nG1 X2 E3\n"), {(0, "Perimeter"): 5})

    def test_retraction_and_priming_cancel_out(self):
        self.assertEqual(lengths(";TYPE:Perimeter\nG1 X1 E2\nG1 E1\nG1 X9 F100\nG1 E2\nG1 X10 E3\n"), {(0, "Perimeter"): 3})

    def test_every_word_for_a_tool_change_is_known(self):
        for word in ("T1", "M108 T1", "M135 T1"):
            self.assertEqual(lengths(f";TYPE:Perimeter\n{word}\nG92 E0\nG1 X1 E2 ; E9\n"), {(1, "Perimeter"): 2})

    def test_the_skirt_is_no_part_of_the_object(self):
        self.assertEqual(plastic_per_tool({(0, "Skirt/Brim"): 7.0, (0, "Perimeter"): 1.0, (1, "Solid infill"): 2.0}),
                         {0: 1.0, 1: 2.0})


if __name__ == "__main__":
    unittest.main()
