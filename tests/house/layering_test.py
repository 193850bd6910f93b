"""scripts/layering on small trees made here."""

import subprocess
import tempfile
import unittest
from pathlib import Path

LAYERING = Path(__file__).resolve().parents[2] / "scripts" / "layering"
TABLE = """
| folder | may include | what |
|---|---|---|
| `base` | nothing | |
| `path` | `base` | |
| `plan` | `base`, `path/path.hpp` | |
| `pipeline` | `plan`, `path` | |
| `cli` | `plan`, `pipeline` | |
"""


def breaches(**files):
    """Lines that scripts/layering prints for a tree of headers; __ in a name stands for /."""
    with tempfile.TemporaryDirectory() as root:
        Path(root, "ARCHITECTURE.md").write_text(TABLE)
        for name, text in files.items():
            file = Path(root, name.replace("__", "/") + ".hpp")
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        done = subprocess.run([LAYERING, root], capture_output=True, text=True)
        lines = done.stdout.splitlines()
        assert done.returncode == (1 if lines else 0), done
        return lines


class Layering(unittest.TestCase):
    def test_what_the_table_allows_passes(self):
        self.assertEqual(breaches(src__base__vec="", src__path__path='#include "base/vec.hpp"\n',
                                  src__plan__order='#include "path/path.hpp"\n'), [])

    def test_an_include_against_the_flow_is_named_with_its_line(self):
        self.assertEqual(breaches(src__base__vec='\n#include "path/path.hpp"\n', src__path__path=""),
                         ["src/base/vec.hpp:2: base may not include path/path.hpp: ARCHITECTURE.md"])

    def test_one_allowed_header_does_not_open_its_folder(self):
        self.assertEqual(len(breaches(src__path__fill="", src__plan__order='#include "path/fill.hpp"\n')), 1)

    def test_a_folder_that_the_table_does_not_know_is_a_breach(self):
        self.assertIn("utils is not in the table", breaches(src__utils__misc="")[0])

    def test_a_header_that_does_not_exist_is_a_breach(self):
        self.assertIn("does not exist", breaches(src__base__vec='#include "base/none.hpp"\n')[0])

    def test_headers_in_a_ring_are_found_within_one_folder(self):
        ring = breaches(src__base__a='#include "base/b.hpp"\n', src__base__b='#include "base/a.hpp"\n')
        self.assertEqual(ring, ["headers include each other: base/a.hpp -> base/b.hpp -> base/a.hpp"])

    def test_the_command_line_is_checked_too(self):
        self.assertEqual(len(breaches(cli__main='#include "base/vec.hpp"\n', src__base__vec="")), 1)

    def test_files_directly_in_src_are_the_pipeline(self):
        self.assertEqual(breaches(cli__main='#include "pipeline.hpp"\n', src__pipeline='#include "picture.hpp"\n',
                                  src__picture='#include "path/path.hpp"\n', src__path__path=""), [])


if __name__ == "__main__":
    unittest.main()
