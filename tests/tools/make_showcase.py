#!/usr/bin/env python3
"""Writes the textures and meshes of scenes/library/showcase.

    python3 tests/tools/make_showcase.py [folder [names of functions]]

Textures are procedural: periodic lattice noise and plain shapes, as 8-bit PNG files. Meshes are
Wavefront OBJ files: metres, z up, parts by material, with texture coordinates. The same run writes
the same bytes.
"""

import math
import pathlib
import random
import struct
import sys
import zlib

# ---- pictures ----------------------------------------------------------------------------------


def write_png(path, width, height, pixel, channels):
    """pixel(x, y) gives values of 0 to 1, sRGB-encoded, as a tuple of `channels`."""
    rows = bytearray()
    for y in range(height):
        row = bytearray()
        for x in range(width):
            for value in pixel(x, y):
                row.append(max(0, min(255, round(255 * value))))
        # Filter 1 (Sub): neighbours are alike.
        rows.append(1)
        for i, byte in enumerate(row):
            rows.append((byte - (row[i - channels] if i >= channels else 0)) & 255)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    colour = {1: 0, 3: 2}[channels]
    path.write_bytes(b"\x89PNG\r\n\x1a\n"
                     + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


class Noise:
    """Smooth values of -1 to 1 on a torus of `nx` by `ny` lattice points."""

    def __init__(self, nx, ny, seed):
        draw = random.Random(seed)
        self.nx, self.ny = nx, ny
        self.values = [[draw.uniform(-1, 1) for _ in range(nx)] for _ in range(ny)]

    def at(self, u, v):
        """u and v: 0 to 1 around the torus."""
        x, y = u % 1 * self.nx, v % 1 * self.ny
        i, j = int(x) % self.nx, int(y) % self.ny
        a, b = x - int(x), y - int(y)
        a, b = a * a * (3 - 2 * a), b * b * (3 - 2 * b)
        k, m = (i + 1) % self.nx, (j + 1) % self.ny
        low = self.values[j][i] * (1 - a) + self.values[j][k] * a
        high = self.values[m][i] * (1 - a) + self.values[m][k] * a
        return low * (1 - b) + high * b


def mixed(dark, light, share):
    share = max(0.0, min(1.0, share))
    return tuple(d + (w - d) * share for d, w in zip(dark, light))


def wood(grain, fine, pores, u, v):
    """Share of light wood; the grain runs along v."""
    bend = grain.at(u, v)
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (6 * u + 1.1 * bend))
    return 0.52 + 0.16 * rings + 0.2 * bend + 0.16 * fine.at(u, v) + 0.12 * min(0, pores.at(u, v))


def parquet(folder):
    """Planks of 0.15 m by 1.2 m: 1.2 m by 1.2 m. Rows are shifted, ends are joints."""
    size, planks = 640, 8
    grain, fine = Noise(24, 3, 1), Noise(320, 10, 2)
    pores = Noise(480, 40, 3)
    draw = random.Random(4)
    shift = [draw.random() for _ in range(planks)]
    tone = [[draw.uniform(-0.16, 0.16) for _ in range(2)] for _ in range(planks)]
    dark, light = (0.43, 0.29, 0.18), (0.74, 0.57, 0.39)

    def pixel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        row = int(u * planks)
        across = u * planks - row
        along = (v + shift[row]) % 1
        end = min(along, 1 - along, abs(along - 0.5))
        half = int(along * 2)
        share = wood(grain, fine, pores, u + 0.37 * half, v + shift[row]) + tone[row][half]
        joint = min(across, 1 - across) * 0.15 < 0.0012 or end * 1.2 < 0.0012
        return mixed((0.16, 0.10, 0.06), mixed(dark, light, share), 0.25 if joint else 1)

    write_png(folder / "parquet.png", size, size, pixel, 3)


def veneer(folder):
    """A door's leaf of oak veneer: 0.9 m by 2.1 m, four sheets side by side."""
    width, height, sheets = 360, 840, 4
    grain, fine, pores = Noise(5, 4, 11), Noise(180, 12, 12), Noise(300, 60, 13)
    dark, light = (0.52, 0.38, 0.25), (0.80, 0.66, 0.48)

    def pixel(x, y):
        u, v = (x + 0.5) / width, (y + 0.5) / height
        sheet = int(u * sheets)
        within = u * sheets - sheet
        within = within if sheet % 2 == 0 else 1 - within  # book-matched
        arch = 5.5 * ((within - 0.5) ** 2 + 0.05) + 0.9 * v + 0.18 * grain.at(within, v)
        rings = 0.5 + 0.5 * math.sin(2 * math.pi * 4 * arch)
        share = 0.5 + 0.2 * rings + 0.14 * fine.at(u, v) + 0.14 * min(0, pores.at(u, v))
        return mixed(dark, light, share)

    write_png(folder / "veneer.png", width, height, pixel, 3)


def ceiling_tile(folder):
    """A mineral tile of 0.6 m in half of its grid's bars."""
    size, bar = 384, 0.012
    draw = random.Random(21)
    holes = [[1.0] * size for _ in range(size)]
    for _ in range(2600):
        x, y, dark = draw.randrange(size), draw.randrange(size), draw.uniform(0.55, 0.9)
        for _ in range(draw.choice((1, 1, 2, 4, 7))):
            holes[y % size][x % size] = dark
            x, y = x + draw.choice((0, 1, 1)), y + draw.choice((-1, 0, 1))
    rough = Noise(96, 96, 22)

    def pixel(x, y):
        u, v = (x + 0.5) / size * 0.6, (y + 0.5) / size * 0.6
        edge = min(u, v, 0.6 - u, 0.6 - v)
        if edge < bar:
            return (0.97,)
        if edge < bar + 0.0035:
            return (0.62 + 0.3 * (edge - bar) / 0.0035,)
        return ((0.945 + 0.012 * rough.at(u / 0.6, v / 0.6)) * holes[y][x],)

    write_png(folder / "ceiling_tile.png", size, size, pixel, 1)


def plaster(folder):
    """Painted plaster: 1.2 m by 1.2 m."""
    size = 448
    octaves = [(Noise(7, 7, 31), 0.012), (Noise(40, 40, 32), 0.012), (Noise(150, 150, 33), 0.022)]

    def pixel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        return (round(64 * (0.955 + sum(a * n.at(u, v) for n, a in octaves))) / 64 * 1.0,)

    write_png(folder / "plaster.png", size, size, pixel, 1)


def carpet(folder):
    """Four carpet tiles of 0.5 m, laid a quarter turn from each other."""
    size = 448
    pile, streaks, flecks = Noise(224, 224, 41), Noise(16, 224, 42), Noise(112, 112, 43)
    dark, light = (0.20, 0.23, 0.28), (0.43, 0.47, 0.53)

    def pixel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        turned = (u < 0.5) != (v < 0.5)
        a, b = (v, u) if turned else (u, v)
        share = 0.5 + 0.28 * pile.at(a, b) + 0.26 * streaks.at(a, b) + 0.12 * flecks.at(a, b)
        joint = min(u % 0.5, 0.5 - u % 0.5, v % 0.5, 0.5 - v % 0.5) < 0.003
        return mixed(dark, light, share - (0.18 if joint else 0))

    write_png(folder / "carpet.png", size, size, pixel, 3)


def terrazzo(folder):
    """Stone chips in grey cement: 0.6 m by 0.6 m."""
    size = 384
    draw = random.Random(71)
    ground = [[0.0] * size for _ in range(size)]
    for _ in range(3400):
        x, y, r = draw.uniform(0, size), draw.uniform(0, size), draw.uniform(1.2, 5.2)
        tone = draw.choice((-0.3, -0.16, 0.1, 0.16, 0.22))
        angle, flat = draw.uniform(0, math.pi), draw.uniform(0.5, 1)
        for j in range(int(y - r), int(y + r) + 1):
            for i in range(int(x - r), int(x + r) + 1):
                dx, dy = i - x, j - y
                along = dx * math.cos(angle) + dy * math.sin(angle)
                across = (-dx * math.sin(angle) + dy * math.cos(angle)) / flat
                if along * along + across * across <= r * r:
                    ground[j % size][i % size] = tone
    fine = Noise(190, 190, 72)

    def pixel(x, y):
        value = 0.66 + 0.5 * ground[y][x] + 0.02 * fine.at((x + 0.5) / size, (y + 0.5) / size)
        return value, value * 0.985, value * 0.95

    write_png(folder / "terrazzo.png", size, size, pixel, 3)


# ---- meshes ------------------------------------------------------------------------------------


class Mesh:
    """Parts by material. A polygon's corners are anticlockwise seen from its front."""

    def __init__(self):
        self.parts = {}

    def face(self, part, corners, uv=None):
        self.parts.setdefault(part, []).append((corners, uv))

    def panel(self, part, corner, u, v, metres, origin=None):
        """A rectangle with one picture for each `metres` (along u, along v); (0, 0) at `origin`."""
        def add(*ways):
            return tuple(sum(c) for c in zip(*ways))
        corners = [corner, add(corner, u), add(corner, u, v), add(corner, v)]
        start = origin or corner
        lu, lv = math.dist(u, (0, 0, 0)), math.dist(v, (0, 0, 0))

        def uv_of(p):
            way = [a - b for a, b in zip(p, start)]
            along = [sum(w * c for w, c in zip(way, axis)) / length
                     for axis, length in ((u, lu), (v, lv))]
            return along[0] / metres[0], along[1] / metres[1]
        self.face(part, corners, [uv_of(p) for p in corners])

    def box(self, part, low, high, omit=()):
        (x, y, z), (a, b, c) = low, high
        faces = {
            "x0": [(x, b, z), (x, y, z), (x, y, c), (x, b, c)],
            "x1": [(a, y, z), (a, b, z), (a, b, c), (a, y, c)],
            "y0": [(x, y, z), (a, y, z), (a, y, c), (x, y, c)],
            "y1": [(a, b, z), (x, b, z), (x, b, c), (a, b, c)],
            "z0": [(x, b, z), (a, b, z), (a, y, z), (x, y, z)],
            "z1": [(x, y, c), (a, y, c), (a, b, c), (x, b, c)]}
        for name, corners in faces.items():
            if name not in omit:
                self.face(part, corners, [(0, 0), (1, 0), (1, 1), (0, 1)])

    def lathe(self, part, centre, profile, sides=24, axis="z", squash=(1, 1)):
        """A body of revolution: `profile` lists (radius, height) upwards along the axis."""
        def place(radius, height, k):
            angle = 2 * math.pi * k / sides
            x, y = radius * math.cos(angle) * squash[0], radius * math.sin(angle) * squash[1]
            way = {"z": (x, y, height), "x": (height, x, y), "y": (y, height, x)}[axis]
            return tuple(a + b for a, b in zip(centre, way))
        for (r0, h0), (r1, h1) in zip(profile, profile[1:]):
            for k in range(sides):
                corners = [place(r0, h0, k), place(r0, h0, k + 1), place(r1, h1, k + 1),
                           place(r1, h1, k)]
                kept = [c for i, c in enumerate(corners) if math.dist(c, corners[i - 1]) > 1e-9]
                if len(kept) >= 3:
                    self.face(part, kept)

    def limb(self, part, start, end, r0, r1, sides=16):
        """A capsule that tapers from one place to another."""
        way = [b - a for a, b in zip(start, end)]
        length = math.dist(start, end)
        w = [c / length for c in way]
        other = (1, 0, 0) if abs(w[0]) < 0.8 else (0, 1, 0)
        u = [w[1] * other[2] - w[2] * other[1], w[2] * other[0] - w[0] * other[2],
             w[0] * other[1] - w[1] * other[0]]
        norm = math.dist(u, (0, 0, 0))
        u = [c / norm for c in u]
        v = [w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0]]
        rings = []
        for i in range(7):
            a = math.pi / 2 * i / 6
            rings.append((-r0 * math.cos(a), r0 * math.sin(a)))
        for i in range(7):
            a = math.pi / 2 * i / 6
            rings.append((length + r1 * math.sin(a), r1 * math.cos(a)))

        def place(ring, k):
            h, r = ring
            a = 2 * math.pi * k / sides
            return tuple(s + w[i] * h + r * (u[i] * math.cos(a) + v[i] * math.sin(a))
                         for i, s in enumerate(start))
        for one, two in zip(rings, rings[1:]):
            for k in range(sides):
                corners = [place(one, k), place(one, k + 1), place(two, k + 1), place(two, k)]
                kept = [c for i, c in enumerate(corners) if math.dist(c, corners[i - 1]) > 1e-9]
                if len(kept) >= 3:
                    self.face(part, kept)

    def write(self, path, title):
        lines = [f"# {title} Written by tests/tools/make_showcase.py."]
        known = {"v": {}, "vt": {}}

        def number(kind, values):
            text = f"{kind} " + " ".join(f"{v:.5g}" for v in values)
            if text not in known[kind]:
                known[kind][text] = len(known[kind]) + 1
                lines.append(text)
            return known[kind][text]
        for part, faces in self.parts.items():
            lines += [f"o {part}", f"usemtl {part}"]
            for corners, uv in faces:
                names = [str(number("v", place)) for place in corners]
                if uv:
                    names = [f"{n}/{number('vt', at)}" for n, at in zip(names, uv)]
                lines.append("f " + " ".join(names))
        path.write_text("\n".join(lines) + "\n")


LENGTH, WIDTH, HEIGHT = 24.0, 2.4, 2.7
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


def wall(mesh, y, side, openings, doors):
    """A wall along x. `openings`: (x0, x1, low, high), sorted; doors are openings, too."""
    holes = sorted(list(openings)
                   + [(x - 0.0, x + DOOR_W, 0.0, DOOR_H) for x in doors])
    origin = (0, y, 0)

    def rectangle(x0, x1, z0, z1):
        if x1 - x0 < 1e-6 or z1 - z0 < 1e-6:
            return
        if side > 0:
            mesh.panel("plaster", (x1, y, z0), (x0 - x1, 0, 0), (0, 0, z1 - z0), (1.2, 1.2), origin)
        else:
            mesh.panel("plaster", (x0, y, z0), (x1 - x0, 0, 0), (0, 0, z1 - z0), (1.2, 1.2), origin)
    at = 0.0
    for x0, x1, low, high in holes + [(LENGTH, LENGTH, 0, 0)]:
        rectangle(at, x0, 0, HEIGHT)
        if x1 > x0:
            rectangle(x0, x1, high, HEIGHT)
            rectangle(x0, x1, 0, low)
        # Skirting up to the next door's frame.
        begin, end = at + (0.06 if at > 0 else 0), x0 - (0.06 if x0 < LENGTH else 0)
        if end > begin:
            a, b = min(y, y + side * 0.015), max(y, y + side * 0.015)
            mesh.box("skirting", (begin, a, 0), (end, b, 0.08), ("z0",))
        at = x1
    for x in doors:
        door(mesh, y, side, x)


def glazing(mesh, x0, x1):
    """A partition of glass at y = 0, in a frame of steel, with a transom."""
    posts = [x0 + (x1 - x0) * k / 4 for k in range(5)]
    for x in posts:
        mesh.box("black", (x - 0.02, -0.05, 0.08), (x + 0.02, 0.0, 2.5))
    for z0, z1 in ((0.08, 0.14), (2.44, 2.5)):
        mesh.box("black", (x0, -0.05, z0), (x1, 0.0, z1))
    for a, b in zip(posts, posts[1:]):
        mesh.face("pane", [(a + 0.02, -0.025, 0.14), (b - 0.02, -0.025, 0.14),
                           (b - 0.02, -0.025, 2.44), (a + 0.02, -0.025, 2.44)][::-1])
        # A band of marks at the height of eyes, so that nobody walks into the glass.
        mesh.box("frosted", (a + 0.02, -0.0235, 1.44), (b - 0.02, -0.0225, 1.50))


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


def detector(mesh, x, y):
    mesh.lathe("white plastic", (x, y, HEIGHT - 0.055),
               [(0, 0), (0.022, 0), (0.03, 0.012), (0.034, 0.016), (0.048, 0.034), (0.05, 0.045),
                (0.052, 0.055)])


def panel_frame(mesh, x, y):
    """The frame of a panel of 0.6 m in the ceiling's grid."""
    z0, z1, o, i = HEIGHT - 0.012, HEIGHT - 0.001, 0.3, 0.285
    mesh.box("white metal", (x - o, y - o, z0), (x + o, y - i, z1))
    mesh.box("white metal", (x - o, y + i, z0), (x + o, y + o, z1))
    mesh.box("white metal", (x - o, y - i, z0), (x - i, y + i, z1))
    mesh.box("white metal", (x + i, y - i, z0), (x + o, y + i, z1))


def picture(mesh, x, y, side, number):
    w, h, z = 0.7, 0.5, 1.35
    a, b = min(y, y + side * 0.022), max(y, y + side * 0.022)
    mesh.box("black", (x, a, z), (x + w, b, z + h))
    front = y + side * 0.0225
    corner, along = ((x + w - 0.02, front, z + 0.02), (-(w - 0.04), 0, 0)) if side > 0 else \
        ((x + 0.02, front, z + 0.02), (w - 0.04, 0, 0))
    mesh.panel(f"print{number}", corner, along, (0, 0, h - 0.04), (w - 0.04, h - 0.04))


def bench(mesh, x, y):
    """A seat of three boards on two frames of steel, 1.6 m long, its back to the wall at y."""
    for k in range(3):
        a = y + 0.06 + 0.13 * k
        mesh.box("board", (x, a, 0.42), (x + 1.6, a + 0.12, 0.45))
    for at in (x + 0.2, x + 1.36):
        mesh.box("black", (at, y + 0.08, 0.39), (at + 0.04, y + 0.42, 0.42))
        for b in (y + 0.08, y + 0.38):
            mesh.box("black", (at, b, 0.0), (at + 0.04, b + 0.04, 0.39))


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


def corridor(folder):
    mesh = Mesh()
    # Floor along x: planks run along the corridor, so v of the picture is x.
    mesh.panel("parquet", (0, WIDTH, 0), (0, -WIDTH, 0), (LENGTH, 0, 0), (1.2, 1.2))
    # Ceiling: whole tiles in the middle, halves at the walls.
    mesh.panel("ceiling", (0, 0, HEIGHT), (0, WIDTH, 0), (LENGTH, 0, 0), (0.6, 0.6),
               (0, -0.3, HEIGHT))
    wall(mesh, 0.0, +1, [(8.0, 13.0, 0.08, 2.5)], [4.7, 15.2, 17.4, 20.4])
    wall(mesh, WIDTH, -1, [], [3.3, 6.6, 10.8, 14.4, 18.6, 21.6])
    glazing(mesh, 8.0, 13.0)
    # Ends: behind the eye plaster, ahead a double door of steel and glass.
    mesh.panel("plaster", (0, 0, 0), (0, WIDTH, 0), (0, 0, HEIGHT), (1.2, 1.2))
    for y0, y1 in ((0.0, 0.36), (2.04, WIDTH)):
        mesh.panel("plaster", (LENGTH, y1, 0), (0, y0 - y1, 0), (0, 0, HEIGHT), (1.2, 1.2))
    mesh.panel("plaster", (LENGTH, 2.04, 2.16), (0, -1.68, 0), (0, 0, HEIGHT - 2.16), (1.2, 1.2))
    for y in (0.36, 1.98):
        mesh.box("frame", (LENGTH - 0.02, y, 0), (LENGTH + 0.1, y + 0.06, 2.16))
    mesh.box("frame", (LENGTH - 0.02, 0.42, 2.1), (LENGTH + 0.1, 1.98, 2.16))
    for y0, y1 in ((0.42, 1.198), (1.202, 1.98)):
        x0, x1 = LENGTH + 0.03, LENGTH + 0.07
        mesh.box("door grey", (x0, y0, 0.006), (x1, y1, 0.5))
        mesh.box("door grey", (x0, y0, 1.9), (x1, y1, 2.1))
        mesh.box("door grey", (x0, y0, 0.5), (x1, y0 + 0.16, 1.9))
        mesh.box("door grey", (x0, y1 - 0.16, 0.5), (x1, y1, 1.9))
        mesh.box("night", (x0 + 0.018, y0 + 0.16, 0.5), (x0 + 0.022, y1 - 0.16, 1.9))
        for z in (0.98, 1.08):  # a bar to push
            mesh.limb("steel", (x0 - 0.05, y0 + 0.06, z), (x0 - 0.05, y1 - 0.06, z), 0.012, 0.012,
                      12)
        for y in (y0 + 0.06, y1 - 0.06):
            mesh.box("steel", (x0 - 0.06, y - 0.02, 0.95), (x0, y + 0.02, 1.11))
    mesh.box("dark", (LENGTH, 0.42, 0), (LENGTH + 0.1, 1.98, 0.006))
    # The room behind the glass.
    mesh.panel("carpet", (6.0, 0, 0), (0, -5, 0), (9, 0, 0), (1.0, 1.0))
    mesh.panel("ceiling", (6.0, -5, HEIGHT), (0, 5, 0), (9, 0, 0), (0.6, 0.6))
    mesh.panel("plaster", (15, -5, 0), (-9, 0, 0), (0, 0, HEIGHT), (1.2, 1.2))
    mesh.panel("plaster", (6, -5, 0), (0, 5, 0), (0, 0, HEIGHT), (1.2, 1.2))
    mesh.panel("plaster", (15, 0, 0), (0, -5, 0), (0, 0, HEIGHT), (1.2, 1.2))
    mesh.panel("plaster", (6, -0.06, 0), (2, 0, 0), (0, 0, HEIGHT), (1.2, 1.2))
    mesh.panel("plaster", (13, -0.06, 0), (2, 0, 0), (0, 0, HEIGHT), (1.2, 1.2))
    mesh.panel("plaster", (8, -0.06, 2.5), (5, 0, 0), (0, 0, HEIGHT - 2.5), (1.2, 1.2))
    mesh.box("frame", (8, -0.06, 2.5), (13, 0.0, 2.502))
    mesh.box("frame", (8, -0.06, 0.0), (13, 0.0, 0.08))
    for x in (1.5, 4.5, 7.5, 10.5, 13.5, 16.5, 19.5, 22.5):
        panel_frame(mesh, x, 1.2)
    for x in (3.0, 9.0, 15.0, 21.0):
        detector(mesh, x, 1.2)
    extinguisher(mesh, 6.55, 0.0, +1)
    picture(mesh, 4.75, WIDTH, -1, 1)
    picture(mesh, 8.6, WIDTH, -1, 2)
    picture(mesh, 12.4, WIDTH, -1, 1)
    picture(mesh, 2.35, 0.0, +1, 2)
    bench(mesh, 1.9, 0.0)
    plant(mesh, 7.45, 0.24)
    # Switches.
    for x, y, side in ((4.45, 0.0, 1), (4.4, WIDTH, -1), (16.3, 0.0, 1)):
        a, b = min(y, y + side * 0.01), max(y, y + side * 0.01)
        mesh.box("white plastic", (x, a, 1.05), (x + 0.08, b, 1.13))
    mesh.box("sign body", (11.992, 1.0, HEIGHT - 0.32), (12.008, 1.4, HEIGHT - 0.08))
    for y in (1.05, 1.35):
        mesh.limb("steel", (12.0, y, HEIGHT - 0.08), (12.0, y, HEIGHT), 0.004, 0.004, 8)
    mesh.write(folder / "corridor.obj", "An office corridor of 24 m, and a room behind glass.")


def prints(folder):
    """Two prints on the walls: fields of colour."""
    for number, (seed, colours) in enumerate(
            ((51, ((0.10, 0.20, 0.32), (0.85, 0.80, 0.70), (0.75, 0.38, 0.22))),
             (52, ((0.80, 0.74, 0.62), (0.20, 0.36, 0.34), (0.88, 0.66, 0.30)))), 1):
        bend, rough = Noise(4, 3, seed), Noise(48, 48, seed + 10)

        def pixel(x, y, bend=bend, rough=rough, colours=colours):
            u, v = (x + 0.5) / 330, (y + 0.5) / 230
            if min(u * 33, v * 23, (1 - u) * 33, (1 - v) * 23) < 3:
                return (0.93, 0.92, 0.89)
            field = v + 0.22 * bend.at(u, v)
            base = colours[0] if field < 0.42 else colours[1] if field < 0.62 else colours[2]
            return tuple(c + 0.02 * rough.at(u, v) for c in base)
        write_png(folder / f"print{number}.png", 330, 230, pixel, 3)


def person(folder):
    """A standing person, 1.75 m, who looks along +x; one foot before the other."""
    mesh = Mesh()
    mesh.lathe("skin", (0.0, 0, 1.62), [(0, -0.11), (0.05, -0.10), (0.072, -0.05), (0.082, 0.0),
                                        (0.076, 0.05), (0.05, 0.1), (0, 0.118)], 24, "z",
               (1.12, 0.92))
    mesh.lathe("hair", (-0.012, 0, 1.635), [(0.088, -0.03), (0.09, 0.02), (0.082, 0.06),
                                            (0.055, 0.1), (0, 0.122)], 24, "z", (1.1, 0.95))
    mesh.limb("skin", (-0.005, 0, 1.44), (0, 0, 1.54), 0.052, 0.05)
    mesh.lathe("jacket", (0, 0, 0.92),
               [(0, -0.02), (0.155, -0.01), (0.165, 0.05), (0.15, 0.2), (0.155, 0.3), (0.185, 0.42),
                (0.19, 0.47), (0.15, 0.525), (0.07, 0.56), (0, 0.57)], 28, "z", (0.66, 1.12))
    for side, step, swing in ((1, 0.16, -0.10), (-1, -0.20, 0.12)):
        hip, knee = (0, side * 0.09, 0.92), (0.5 * step + 0.03, side * 0.095, 0.50)
        ankle = (step, side * 0.1, 0.09)
        mesh.limb("trousers", hip, knee, 0.088, 0.062)
        mesh.limb("trousers", knee, ankle, 0.062, 0.046)
        mesh.limb("shoe", (step - 0.04, side * 0.1, 0.045), (step + 0.15, side * 0.11, 0.035),
                  0.045, 0.035)
        shoulder, elbow = (0, side * 0.2, 1.38), (swing * 0.5 - 0.03, side * 0.245, 1.12)
        wrist = (swing + 0.02, side * 0.24, 0.89)
        mesh.limb("jacket", shoulder, elbow, 0.062, 0.048)
        mesh.limb("jacket", elbow, wrist, 0.046, 0.036)
        mesh.limb("skin", wrist, (swing + 0.045, side * 0.235, 0.80), 0.03, 0.028)
    mesh.write(folder / "person.obj", "A person of 1.75 m.")


STAIR_W, STAIR_L, STOREY, RISERS, TREAD, FLIGHT_W = 2.6, 5.0, 3.0, 9, 0.28, 1.2
RUN_FROM = 1.35


def flight(mesh, x, z, up):
    """Nine steps from z, towards +y (`up` 1) or -y (-1), over x to x + 1.2 m."""
    rise = STOREY / 2 / RISERS
    run = TREAD * (RISERS - 1)
    first = RUN_FROM if up > 0 else RUN_FROM + run

    def soffit(k):
        return z + rise * k - 0.17

    def at(k):
        return first + up * TREAD * k
    for k in range(RISERS):
        top, y0, y1 = z + rise * (k + 1), at(k), at(k + 1)
        a, b = (x, x + FLIGHT_W) if up > 0 else (x + FLIGHT_W, x)
        w = b - a
        mesh.panel("terrazzo", (a, y0, z + rise * k), (w, 0, 0), (0, 0, rise), (0.6, 0.6))
        if k == RISERS - 1:
            continue  # the landing
        mesh.panel("terrazzo", (a, y0, top), (w, 0, 0), (0, y1 - y0, 0), (0.6, 0.6))
        # A strip that does not slip, 3 cm behind the edge.
        n0, n1 = sorted((y0 + up * 0.03, y0 + up * 0.07))
        mesh.box("black", (x + 0.03, n0, top - 0.001), (x + FLIGHT_W - 0.03, n1, top + 0.002),
                 ("z0",))
        for side in (x, x + FLIGHT_W):
            corners = [(side, y0, soffit(k)), (side, y1, soffit(k + 1)), (side, y1, top),
                       (side, y0, top)]
            mesh.face("concrete", corners if (side > x) == (up > 0) else corners[::-1])
    y0, y1 = at(0), at(RISERS - 1)
    corners = [(x, y0, soffit(0)), (x, y1, soffit(RISERS - 1)),
               (x + FLIGHT_W, y1, soffit(RISERS - 1)), (x + FLIGHT_W, y0, soffit(0))]
    mesh.face("concrete", corners if up > 0 else corners[::-1])
    # Balustrade towards the well.
    well = x + FLIGHT_W - 0.05 if up > 0 else x + 0.05
    low = (well, at(0), z + rise)
    high = (well, at(RISERS - 2), z + rise * (RISERS - 1))
    for k in range(RISERS - 1):
        y = at(k) + up * TREAD / 2
        base = z + rise * (k + 1)
        for part in (-0.07, 0.07):
            mesh.limb("black", (well, y + part, base), (well, y + part, base + 0.86 + part * up
                                                        * rise / TREAD), 0.006, 0.006, 8)
    for height, radius, part in ((0.92, 0.021, "handrail"), (0.06, 0.008, "black")):
        mesh.limb(part, (low[0], low[1], low[2] + height), (high[0], high[1], high[2] + height),
                  radius, radius, 14)
    for foot in (low, high):
        mesh.limb("black", foot, (foot[0], foot[1], foot[2] + 0.93), 0.016, 0.016, 12)
    # A rail on the wall, on three brackets.
    wall_x = x + 0.06 if up > 0 else x + FLIGHT_W - 0.06
    mesh.limb("handrail", (wall_x, low[1], low[2] + 0.9), (wall_x, high[1], high[2] + 0.9), 0.02,
              0.02, 14)
    for share in (0.08, 0.5, 0.92):
        y = low[1] + (high[1] - low[1]) * share
        h = low[2] + (high[2] - low[2]) * share + 0.9
        mesh.limb("steel", (wall_x, y, h - 0.015), (wall_x, y, h - 0.06), 0.006, 0.006, 10)
        mesh.limb("steel", (wall_x, y, h - 0.06), (x if up > 0 else x + FLIGHT_W, y, h - 0.06),
                  0.006, 0.006, 10)


def stairwell(folder):
    mesh = Mesh()
    half = RUN_FROM + TREAD * (RISERS - 1)
    for storey in (0, 1):
        z = STOREY * storey
        flight(mesh, 0.0, z, +1)
        flight(mesh, STAIR_W - FLIGHT_W, z + STOREY / 2, -1)
        mesh.panel("terrazzo", (0, half, z + STOREY / 2), (STAIR_W, 0, 0),
                   (0, STAIR_L - half, 0), (0.6, 0.6))
        mesh.box("concrete", (0, half, z + STOREY / 2 - 0.2),
                 (STAIR_W, STAIR_L, z + STOREY / 2 - 0.001), ("z1",))
        mesh.panel("terrazzo", (0, 0, z), (STAIR_W, 0, 0), (0, RUN_FROM, 0), (0.6, 0.6))
        if storey > 0:
            mesh.box("concrete", (0, 0, z - 0.2), (STAIR_W, RUN_FROM, z - 0.001), ("z1",))
    mesh.panel("terrazzo", (0, RUN_FROM, 0), (STAIR_W, 0, 0), (0, STAIR_L - RUN_FROM, 0),
               (0.6, 0.6))
    top = 2 * STOREY + 2.6
    mesh.panel("plaster", (0, STAIR_L, 0), (0, -STAIR_L, 0), (0, 0, top), (1.2, 1.2))
    mesh.panel("plaster", (STAIR_W, 0, 0), (0, STAIR_L, 0), (0, 0, top), (1.2, 1.2))
    mesh.panel("plaster", (STAIR_W, STAIR_L, 0), (-STAIR_W, 0, 0), (0, 0, top), (1.2, 1.2))
    mesh.face("plaster", [(0, 0, top), (0, STAIR_L, top), (STAIR_W, STAIR_L, top),
                          (STAIR_W, 0, top)], [(0, 0), (0, 4), (2, 4), (2, 0)])
    # The wall of the doors: y = 0, its front along +y.
    x = 0.3
    mesh.panel("plaster", (x, 0, 0), (-x, 0, 0), (0, 0, top), (1.2, 1.2))
    mesh.panel("plaster", (STAIR_W, 0, 0), (x + DOOR_W - STAIR_W, 0, 0), (0, 0, top), (1.2, 1.2))
    for z in (0.0, STOREY, 2 * STOREY):
        above = STOREY if z < 2 * STOREY else top - z
        mesh.panel("plaster", (x + DOOR_W, 0, z + DOOR_H), (-DOOR_W, 0, 0), (0, 0, above - DOOR_H),
                   (1.2, 1.2))
        one = Mesh()
        door(one, 0.0, +1, x)
        for part, faces in one.parts.items():
            for corners, uv in faces:
                mesh.face(part, [(a, b, c + z) for a, b, c in corners], uv)
    extinguisher(mesh, 1.75, 0.0, +1)
    for z in (STOREY - 0.2, 2 * STOREY - 0.2):
        mesh.lathe("white plastic", (1.3, 0.7, z - 0.055), [(0, 0), (0.15, 0), (0.165, 0.02),
                                                            (0.165, 0.055)], 36)
    mesh.write(folder / "stairwell.obj", "A stairwell of two storeys.")


def main():
    only = sys.argv[2:]
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else (
        pathlib.Path(__file__).resolve().parents[2] / "scenes/library/showcase")
    folder.mkdir(parents=True, exist_ok=True)
    for make in (parquet, veneer, ceiling_tile, plaster, carpet, terrazzo, prints, corridor,
                 stairwell, person):
        if not only or make.__name__ in only:
            make(folder)


if __name__ == "__main__":
    main()
