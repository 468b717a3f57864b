"""Meshes as Wavefront OBJ files: metres, z up, parts by material, texture coordinates."""

import math


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

    def extrude(self, part, profile, low, high, bevel=0.0, metres=0.5):
        """A convex profile of (x, z), anticlockwise seen along +y, from y = low to high.

        Its ends are bevelled by so much; a picture measures `metres`.
        """
        xs, zs = [x for x, _ in profile], [z for _, z in profile]
        middle = [(min(v) + max(v)) / 2 for v in (xs, zs)]
        shrink = [1 - 2 * bevel / max(1e-9, max(v) - min(v)) for v in (xs, zs)]
        small = [tuple(m + (c - m) * s for c, m, s in zip(at, middle, shrink)) for at in profile]
        whole = ([(low, small), (low + bevel, profile), (high - bevel, profile), (high, small)]
                 if bevel else [(low, profile), (high, profile)])
        around = [0.0]
        for a, b in zip(profile, profile[1:] + profile[:1]):
            around.append(around[-1] + math.dist(a, b))
        for (y0, one), (y1, two) in zip(whole, whole[1:]):
            for i in range(len(profile)):
                j = (i + 1) % len(profile)
                corners = [(two[i][0], y1, two[i][1]), (two[j][0], y1, two[j][1]),
                           (one[j][0], y0, one[j][1]), (one[i][0], y0, one[i][1])]
                self.face(part, corners, [(y1 / metres, around[i] / metres),
                                          (y1 / metres, around[i + 1] / metres),
                                          (y0 / metres, around[i + 1] / metres),
                                          (y0 / metres, around[i] / metres)])
        for y, end in ((whole[0][0], whole[0][1]), (whole[-1][0], whole[-1][1][::-1])):
            self.face(part, [(x, y, z) for x, z in end],
                      [(x / metres, z / metres) for x, z in end])

    def add(self, other, place):
        """All of another mesh; `place` turns a place of it into one of this mesh."""
        for part, faces in other.parts.items():
            for corners, uv in faces:
                self.face(part, [place(corner) for corner in corners], uv)

    def write(self, path, title, digits=5):
        lines = [f"# {title} Written by tests/tools/make_showcase.py."]
        known = {"v": {}, "vt": {}}

        def number(kind, values):
            text = f"{kind} " + " ".join(f"{v:.{digits}g}" for v in values)
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
