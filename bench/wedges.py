"""Models of any size: a wavy, twisted column cut into wedges, one for each nozzle. Kept in build/bench/scaling/.

Shapes depend on the share of the height alone, so that a taller column has the same layers, only more of them.
"""

import math

import models

FOLDER = models.CACHE / "scaling"
RADIUS_MM, WAVE_MM, LOBES, TWIST = 16.0, 2.0, 7, 0.75  # TWIST: turns from bottom to top


def rim(angle, share_of_height):
    """Point of the column's surface: waves run around it and up it."""
    turned = angle + 2 * math.pi * TWIST * share_of_height
    radius = RADIUS_MM + WAVE_MM * math.sin(LOBES * angle + 20 * share_of_height)
    return radius * math.cos(turned), radius * math.sin(turned)


def wedge(k, wedges, rim_steps, levels, height_mm):
    """Vertices and triangles of wedge k: its axis, then its rim, level by level. Sides of neighbours fit exactly."""
    ring = rim_steps // wedges + 2  # the axis and both ends of the rim
    steps = (ring - 2) * wedges
    angles = [2 * math.pi * ((k * (ring - 2) + i) % steps) / steps for i in range(ring - 1)]
    vertices, triangles = [], []
    for level in range(levels + 1):
        share = level / levels
        z = height_mm * share
        vertices.append((0.0, 0.0, z))
        vertices += [(*rim(angle, share), z) for angle in angles]
    for below in range(0, levels * ring, ring):
        for i in range(ring):
            a, b = below + i, below + (i + 1) % ring
            # Both sides of a wedge split their squares along the same diagonal: from the axis upwards to the rim.
            if i == ring - 1:
                triangles += [(a, b, a + ring), (b, b + ring, a + ring)]
            else:
                triangles += [(a, b, b + ring), (a, b + ring, a + ring)]
    top = levels * ring
    for i in range(1, ring - 1):
        triangles += [(0, i + 1, i), (top, top + i, top + i + 1)]
    return vertices, triangles


def column(wedges, rim_steps, levels, height_mm):
    """The STL files of the column, one for each wedge; about 4 x wedges + 2 x rim_steps triangles for each level."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    files = []
    for k in range(wedges):
        file = FOLDER / f"column-{rim_steps}x{levels}-{height_mm:g}mm-{k + 1}of{wedges}.stl"
        if not file.exists():
            unfinished = file.with_suffix(".unfinished")
            models.write_stl(unfinished, *wedge(k, wedges, rim_steps, levels, height_mm))
            unfinished.rename(file)
        files.append(file)
    return files
