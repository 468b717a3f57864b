"""What several buildings have: doors, extinguishers, detectors, frames of panels, plants."""

import math
import random

DOOR_W, DOOR_H, RECESS = 0.9, 2.1, 0.09


def door(mesh, y, side, x):
    """A closed door at x to x + 0.9 m; `side` +1: the wall's front looks along +y."""
    back = y - side * RECESS
    low, high = min(back, back + side * 0.04), max(back, back + side * 0.04)

    def span(a, b):
        return min(a, b), max(a, b)
    # Leaf, with its picture once.
    front = back + side * 0.04
    corner, along = ((x + DOOR_W, front, 0.006), (-DOOR_W, 0, 0)) if side > 0 else \
        ((x, front, 0.006), (DOOR_W, 0, 0))
    mesh.panel("leaf", corner, along, (0, 0, DOOR_H - 0.006), (DOOR_W, DOOR_H))
    # Reveals and frame: 60 mm wide, 12 mm before the wall.
    y0, y1 = span(back, y + side * 0.012)
    mesh.box("frame", (x - 0.06, y0, 0), (x, y1, DOOR_H + 0.06))
    mesh.box("frame", (x + DOOR_W, y0, 0), (x + DOOR_W + 0.06, y1, DOOR_H + 0.06))
    mesh.box("frame", (x, y0, DOOR_H), (x + DOOR_W, y1, DOOR_H + 0.06))
    mesh.box("dark", (x, low, 0), (x + DOOR_W, high, 0.006))
    # A threshold: the floor ends at the wall.
    y0, y1 = span(back, y + side * 0.001)
    mesh.box("frame", (x, y0, -0.01), (x + DOOR_W, y1, 0.003), ("z0",))
    # Handle: a rose, a neck and a lever; a key plate below.
    hx = x + 0.08
    a, b = span(front, front + side * 0.008)
    mesh.box("steel", (hx - 0.026, a, 1.024), (hx + 0.026, b, 1.076))
    mesh.box("steel", (hx - 0.020, a, 0.95), (hx + 0.020, b, 0.99))
    base = front + side * 0.008
    mesh.limb("steel", (hx, base, 1.05), (hx, base + side * 0.045, 1.05), 0.009, 0.009, 12)
    mesh.limb("steel", (hx, base + side * 0.045, 1.05), (hx + 0.115, base + side * 0.045, 1.05),
              0.009, 0.008, 12)
    # A room's plate beside it.
    a, b = span(y, y + side * 0.006)
    px = x - 0.24
    mesh.box("plate", (px, a, 1.5), (px + 0.14, b, 1.6))


def extinguisher(mesh, x, y, side):
    """A bottle of 6 kg on its bracket, with valve, lever and hose."""
    cy = y + side * 0.1
    mesh.lathe("red", (x, cy, 0.62), [(0, 0), (0.07, 0), (0.078, 0.012), (0.078, 0.40),
                                      (0.072, 0.44), (0.05, 0.475), (0.025, 0.49), (0.025, 0.51)])
    mesh.lathe("black", (x, cy, 1.13), [(0.02, 0), (0.02, 0.05), (0, 0.05)], 16)
    mesh.limb("black", (x - 0.01, cy, 1.18), (x + 0.13, cy, 1.20), 0.009, 0.009, 10)
    mesh.limb("black", (x - 0.01, cy, 1.15), (x + 0.11, cy, 1.13), 0.009, 0.009, 10)
    places = [(x - 0.02, cy, 1.15), (x - 0.10, cy, 1.12), (x - 0.115, cy, 0.95),
              (x - 0.10, cy, 0.76), (x - 0.088, cy, 0.72)]
    for a, b in zip(places, places[1:]):
        mesh.limb("black", a, b, 0.011, 0.011, 10)
    mesh.lathe("plate", (x, cy, 0.80), [(0.0785, 0), (0.0785, 0.16)], 24)
    a, b = min(y, y + side * 0.02), max(y, y + side * 0.02)
    mesh.box("dark", (x - 0.03, a, 0.7), (x + 0.03, b, 1.1))
    # Its sign: a red plate with a white bottle.
    a, b = min(y, y + side * 0.003), max(y, y + side * 0.003)
    mesh.box("red", (x - 0.1, a, 1.62), (x + 0.1, b, 1.82))
    a, b = min(y, y + side * 0.0045), max(y, y + side * 0.0045)
    for low, high in (((-0.035, 1.65), (0.025, 1.755)), ((-0.02, 1.755), (0.01, 1.775)),
                      ((-0.05, 1.775), (0.02, 1.787))):
        mesh.box("plate", (x + low[0], a, low[1]), (x + high[0], b, high[1]))


def detector(mesh, x, y, height):
    """A smoke detector below a ceiling of this height."""
    mesh.lathe("white plastic", (x, y, height - 0.055),
               [(0, 0), (0.022, 0), (0.03, 0.012), (0.034, 0.016), (0.048, 0.034), (0.05, 0.045),
                (0.052, 0.055)])


def panel_frame(mesh, x, y, height):
    """The frame of a panel of 0.6 m in the ceiling's grid."""
    z0, z1, o, i = height - 0.012, height - 0.001, 0.3, 0.285
    mesh.box("white metal", (x - o, y - o, z0), (x + o, y - i, z1))
    mesh.box("white metal", (x - o, y + i, z0), (x + o, y + o, z1))
    mesh.box("white metal", (x - o, y - i, z0), (x - i, y + i, z1))
    mesh.box("white metal", (x + i, y - i, z0), (x + o, y + i, z1))


def plant(mesh, x, y):
    """A pot with blades of a snake plant."""
    mesh.lathe("pot", (x, y, 0), [(0, 0), (0.11, 0), (0.15, 0.32), (0.14, 0.32), (0.135, 0.29)])
    mesh.lathe("earth", (x, y, 0.285), [(0.14, 0), (0, 0.006)])
    draw = random.Random(61)
    for _ in range(22):
        turn, lean = draw.uniform(0, 2 * math.pi), draw.uniform(0.02, 0.3)
        tall, wide = draw.uniform(0.45, 0.95), draw.uniform(0.022, 0.034)
        foot = (x + 0.08 * math.cos(turn) * draw.random(),
                y + 0.08 * math.sin(turn) * draw.random())
        out, side = (math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn))
        rows = []
        for i in range(7):
            t = i / 6
            w = wide * (1 - t ** 3) * (0.7 + 0.6 * t * (1 - t))
            bend = lean * t * t
            middle = (foot[0] + out[0] * bend, foot[1] + out[1] * bend, 0.29 + tall * t)
            fold = 0.35 * w
            rows.append([(middle[0] + side[0] * w * s - out[0] * fold * (1 - abs(s)),
                          middle[1] + side[1] * w * s - out[1] * fold * (1 - abs(s)), middle[2])
                         for s in (-1, 0, 1)])
        for low, high in zip(rows, rows[1:]):
            for k in (0, 1):
                corners = [low[k], low[k + 1], high[k + 1], high[k]]
                kept = [c for i, c in enumerate(corners) if math.dist(c, corners[i - 1]) > 1e-6]
                if len(kept) >= 3:
                    mesh.face("leaf of plant", kept)
