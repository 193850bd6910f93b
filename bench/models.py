"""The eight two-colour pairs of the benchmark, as every slicer wants to be given them.

Ours takes two STL files. PrusaSlicer prints two files from its command line with one extruder, so it gets the same two
meshes as the two volumes of one AMF object, which name their extruders. What is made once is kept in build/bench/.
"""

import os
import re
import struct
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHARED = Path(os.environ.get("CLEANCOLOR_SHARED", ROOT.parent / "shared"))
CACHE = ROOT / "build" / "bench"
SETTINGS = SHARED / "peers" / "cfg" / "prusa-base.ini"

PAIRS = {
    "4-cones": ("black", "white"),
    "crystal": ("black", "white"),
    "dragon-heart": ("body", "accent"),
    "robot-ice": ("crust", "robot"),
    "rose": ("petals", "green"),
    "spot-cow": ("light", "dark"),
    "two-color-world-50mm": ("ocean", "land"),
}
BENCHY = "3dbenchy"
NAMES = [*PAIRS, BENCHY]


def require(names, known, script):
    """Ends the script where one of the comma-separated names is not known."""
    for name in names.split(","):
        if name not in known:
            sys.exit(f"{script}: there is no model '{name}'; there are {', '.join(known)}")


def stl_pair(name):
    """The two STL files of a model, in the order of their extruders."""
    if name == BENCHY:
        return benchy_stls()
    return [SHARED / "models" / "paper" / f"{name}_{part}.stl" for part in PAIRS[name]]


def benchy_stls():
    """3DBenchy comes as one 3MF with two objects; PrusaSlicer 2.5 refuses it, so both slicers get two STL files."""
    files = [CACHE / "3dbenchy_hull.stl", CACHE / "3dbenchy_accent.stl"]
    if all(file.exists() for file in files):
        return files
    archive = SHARED / "models" / "thirdparty" / "3dbenchy" / "3DBenchy-dualprint-rebuilt.3mf"
    model = zipfile.ZipFile(archive).read("3D/3dmodel.model").decode()
    objects = re.findall(r"<mesh>.*?</mesh>", model, re.S)
    assert len(objects) == 2, f"{archive}: two objects expected, {len(objects)} found"
    CACHE.mkdir(parents=True, exist_ok=True)
    for file, text in zip(files, objects):
        vertices = [tuple(map(float, v)) for v in re.findall(r'<vertex x="([^"]*)" y="([^"]*)" z="([^"]*)"', text)]
        triangles = [tuple(map(int, t)) for t in re.findall(r'<triangle v1="(\d+)" v2="(\d+)" v3="(\d+)"', text)]
        write_stl(file, vertices, triangles)
    return files


def write_stl(file, vertices, triangles):
    """A binary STL; normals zero, readers take the winding."""
    records = (struct.pack("<12fH", 0, 0, 0, *vertices[a], *vertices[b], *vertices[c], 0) for a, b, c in triangles)
    file.write_bytes(bytes(80) + struct.pack("<I", len(triangles)) + b"".join(records))


def read_binary_stl(file):
    """Vertices, equal ones merged, and triangles of a binary STL."""
    data = Path(file).read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    assert len(data) == 84 + 50 * count, f"{file}: not a binary STL"
    index, triangles = {}, []
    for record in struct.iter_unpack("<12x9f2x", data[84:]):
        corners = (record[0:3], record[3:6], record[6:9])
        triangles.append(tuple(index.setdefault(corner, len(index)) for corner in corners))
    return list(index), [t for t in triangles if len(set(t)) == 3]


def amf(name):
    """The pair as one AMF object of two volumes, the first for extruder 1, the second for extruder 2."""
    file = CACHE / f"{name}.amf"
    if file.exists():
        return file
    CACHE.mkdir(parents=True, exist_ok=True)
    vertices, volumes = [], []
    for extruder, stl in enumerate(stl_pair(name), start=1):
        corners, triangles = read_binary_stl(stl)
        first = len(vertices)
        vertices += corners
        lines = [f"<triangle><v1>{first + a}</v1><v2>{first + b}</v2><v3>{first + c}</v3></triangle>\n"
                 for a, b, c in triangles]
        volumes.append(f'<volume><metadata type="slic3r.extruder">{extruder}</metadata>\n{"".join(lines)}</volume>\n')
    points = "".join(f"<vertex><coordinates><x>{x:.6f}</x><y>{y:.6f}</y><z>{z:.6f}</z></coordinates></vertex>\n"
                     for x, y, z in vertices)
    file.write_text('<?xml version="1.0" encoding="UTF-8"?>\n<amf unit="millimeter" version="1.1">\n<object id="0"><mesh>\n'
                    f'<vertices>\n{points}</vertices>\n{"".join(volumes)}</mesh></object>\n</amf>\n')
    return file
