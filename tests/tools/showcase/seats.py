"""Upholstered seats of an auditorium, and the panels at the ends of their rows."""

import math

from showcase.mesh import Mesh

PITCH = 0.56


def rounded(width, height, radius, steps=4):
    """A rectangle about the origin with round corners, anticlockwise."""
    places = []
    for k, (x, z) in enumerate(((1, -1), (1, 1), (-1, 1), (-1, -1))):
        for i in range(steps + 1):
            angle = math.pi / 2 * (k - 1 + i / steps)
            places.append((x * (width / 2 - radius) + radius * math.cos(angle),
                           z * (height / 2 - radius) + radius * math.sin(angle)))
    return places


def turned(profile, degrees, x, z):
    """The profile turned clockwise in (x, z), so that its top leans along +x; moved to (x, z)."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [(x + a * c + b * s, z - a * s + b * c) for a, b in profile]


def seat(folder):
    """A seat whose sitter looks along -x; its row begins at x = 0. One armrest, at y = 0.28 m."""
    mesh = Mesh()
    half = PITCH / 2 - 0.035
    mesh.extrude("fabric", turned(rounded(0.46, 0.11, 0.045), 4, 0.51, 0.405), -half, half, 0.03)
    mesh.extrude("fabric", turned(rounded(0.10, 0.56, 0.045), 14, 0.775, 0.66), -half, half, 0.03)
    # A shell of plywood behind the back and below the cushion.
    shell = half + 0.012
    mesh.extrude("shell", turned(rounded(0.016, 0.70, 0.007, 2), 14, 0.825, 0.615), -shell, shell,
                 0.004, 0.9)
    mesh.extrude("shell", turned(rounded(0.42, 0.014, 0.006, 2), 4, 0.53, 0.343), -shell, shell,
                 0.004, 0.9)
    # The armrest on its standard, which stands on a foot.
    y = PITCH / 2
    mesh.extrude("arm", turned(rounded(0.36, 0.028, 0.013, 3), 0, 0.55, 0.625), y - 0.03, y + 0.03,
                 0.01)
    mesh.extrude("metal", [(0.50, 0.015), (0.66, 0.015), (0.70, 0.61), (0.46, 0.60)], y - 0.012,
                 y + 0.012)
    mesh.extrude("metal", rounded_foot(), y - 0.035, y + 0.035)
    mesh.write(folder / "seat.obj", "A seat of an auditorium.", 4)


def rounded_foot():
    return [(0.44, 0.0), (0.72, 0.0), (0.72, 0.008), (0.66, 0.016), (0.50, 0.016), (0.44, 0.008)]


def end_panel(mesh, x, y, z):
    """A panel of 0.05 m at the end of a row, from y on, with a top of oak."""
    low = [(x + 0.30, z), (x + 0.84, z), (x + 0.92, z + 0.63), (x + 0.28, z + 0.63)]
    mesh.extrude("panel", low, y, y + 0.05, 0, 0.9)
    top = turned(rounded(0.66, 0.03, 0.013, 3), 0, x + 0.60, z + 0.645)
    mesh.extrude("board", top, y - 0.008, y + 0.058, 0.008)
