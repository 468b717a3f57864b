"""The mesh of scenes/library/showcase/office_corridor.toml."""

from showcase.fittings import (DOOR_H, DOOR_W, detector, door, extinguisher, panel_frame,
                               plant)
from showcase.mesh import Mesh

LENGTH, WIDTH, HEIGHT = 24.0, 2.4, 2.7


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
        panel_frame(mesh, x, 1.2, HEIGHT)
    for x in (3.0, 9.0, 15.0, 21.0):
        detector(mesh, x, 1.2, HEIGHT)
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
