"""The meshes of scenes/library/showcase/auditorium.toml: 16 x 14 x 6.2 m.

x runs from the wall behind the stage to the back, y across the hall. Nine rows of seats stand on a
rake; two aisles of steps divide them into three blocks.
"""

import math

from showcase.fittings import detector, extinguisher
from showcase.mesh import Mesh
from showcase.seats import end_panel

LENGTH, WIDTH, HEIGHT = 16.0, 14.0, 6.2
RAKE, ROWS, RISE = 5.0, 9, 0.22
LANDING = RAKE + ROWS
BLOCKS = ((0.0, 3.4), (4.6, 9.4), (10.6, 14.0))
AISLES = ((3.4, 4.6), (9.4, 10.6))
PANELLED = 4.2  # height of the panels of wood
STAGE_X, STAGE_Y, STAGE_Z = 3.4, (3.0, 11.0), 0.45
DOORS = ((0.7, 2.3), (11.7, 13.3))
DOOR_H = 2.1
SCREEN = ((4.466, 9.534), (1.2, 4.05))
CARPET, PLASTER, VENEER = (1.0, 1.0), (1.2, 1.2), (0.9, 2.1)
RAFTS = [0.15 + 2.6 * k for k in range(6)]
RAFT_X, RAFT_Y, RAFT_Z, SAG = 1.8, (1.3, 12.7), 5.1, 0.13


def floor(mesh, part, x0, x1, y0, y1, z, metres=CARPET):
    mesh.panel(part, (x0, y0, z), (x1 - x0, 0, 0), (0, y1 - y0, 0), metres, (0, 0, z))


def riser(mesh, part, x, y0, y1, z0, z1, metres=CARPET):
    """A vertical face towards -x."""
    mesh.panel(part, (x, y1, z0), (0, y0 - y1, 0), (0, 0, z1 - z0), metres)


def nosing(mesh, x, y0, y1, z):
    """A strip of metal on the edge of a step, for contrast."""
    mesh.box("nosing", (x - 0.004, y0 + 0.02, z - 0.03), (x + 0.035, y1 - 0.02, z + 0.003))


def rake(mesh):
    floor(mesh, "carpet", 0, RAKE + 0.5, 0, WIDTH, 0)
    for y0, y1 in BLOCKS:
        floor(mesh, "carpet", RAKE + 0.5, RAKE + 1, y0, y1, 0)
        for k in range(1, ROWS):
            floor(mesh, "carpet", RAKE + k, RAKE + k + 1, y0, y1, RISE * k)
        for k in range(1, ROWS + 1):
            riser(mesh, "carpet", RAKE + k, y0, y1, RISE * (k - 1), RISE * k)
            # Cheeks of the half steps of the aisles beside this block.
            x, z = RAKE + k - 0.5, RISE * (k - 1)
            if y0 > 0:
                mesh.panel("carpet", (x + 0.5, y0, z), (-0.5, 0, 0), (0, 0, RISE / 2), CARPET)
            if y1 < WIDTH:
                mesh.panel("carpet", (x, y1, z), (0.5, 0, 0), (0, 0, RISE / 2), CARPET)
    for y0, y1 in AISLES:
        for step in range(1, 2 * ROWS + 1):
            x, z = RAKE + step / 2, RISE / 2 * step
            riser(mesh, "carpet", x, y0, y1, z - RISE / 2, z)
            if step < 2 * ROWS:
                floor(mesh, "carpet", x, x + 0.5, y0, y1, z)
            nosing(mesh, x, y0, y1, z)
    floor(mesh, "carpet", LANDING, LENGTH, 0, WIDTH, RISE * ROWS)


def end_panels(mesh):
    """The ends of the rows, with the housings of the lights that look into the aisles."""
    for k in range(ROWS):
        x, z = RAKE + k, RISE * k
        for y in (0.38, 3.25, 4.70, 9.25, 10.70, 13.57):
            end_panel(mesh, x, y, z)
        for y in (3.30, 4.70, 9.30, 10.70):
            mesh.box("black", (x + 0.33, y - 0.003, z + 0.24), (x + 0.47, y + 0.003, z + 0.30))


def stage(mesh):
    (y0, y1), z = STAGE_Y, STAGE_Z
    mesh.panel("parquet", (STAGE_X, y0, z), (0, y1 - y0, 0), (-STAGE_X, 0, 0), (1.2, 1.2))
    mesh.panel("panel", (STAGE_X, y0, 0), (0, y1 - y0, 0), (0, 0, z), VENEER)
    mesh.panel("panel", (0, y0, 0), (STAGE_X, 0, 0), (0, 0, z), VENEER)
    mesh.panel("panel", (STAGE_X, y1, 0), (-STAGE_X, 0, 0), (0, 0, z), VENEER)
    mesh.box("nosing", (STAGE_X - 0.04, y0, z - 0.02), (STAGE_X + 0.004, y1, z + 0.003))
    for a, b in AISLES:  # steps to the stage
        for k in (1, 2):
            x = STAGE_X + 0.3 * (2 - k)
            mesh.box("board", (STAGE_X, a, 0), (x + 0.3, b, 0.15 * k), ("z0", "x0"))
            mesh.box("nosing", (x + 0.26, a + 0.02, 0.15 * k - 0.02),
                     (x + 0.304, b - 0.02, 0.15 * k + 0.003))
    lectern(mesh, 2.25, 10.15, z)
    for y in (3.72, 10.28):  # loudspeakers beside the screen
        mesh.box("black", (0.03, y - 0.11, 1.75), (0.26, y + 0.11, 3.55))
        mesh.box("grille", (0.26, y - 0.10, 1.77), (0.266, y + 0.10, 3.53))


def lectern(mesh, x, y, z):
    mesh.box("panel", (x - 0.05, y - 0.30, z + 0.02), (x + 0.05, y + 0.30, z + 1.0), ("z0", "z1"))
    mesh.box("black", (x - 0.26, y - 0.26, z), (x + 0.12, y + 0.26, z + 0.02))
    top = [(x - 0.30, z + 0.98), (x + 0.17, z + 1.08), (x + 0.17, z + 1.12), (x - 0.30, z + 1.02)]
    mesh.extrude("board", top, y - 0.34, y + 0.34)
    mesh.limb("black", (x + 0.1, y - 0.2, z + 1.1), (x + 0.02, y - 0.16, z + 1.36), 0.006, 0.005, 8)
    mesh.limb("black", (x + 0.02, y - 0.16, z + 1.36), (x - 0.02, y - 0.14, z + 1.40), 0.012,
              0.012, 10)
    # A notebook: its lid, seen from behind.
    lid = [(x + 0.03, z + 1.09), (x + 0.045, z + 1.09), (x + 0.125, z + 1.31),
           (x + 0.115, z + 1.31)]
    mesh.extrude("grey plastic", lid, y - 0.06, y + 0.26)


def stage_wall(mesh):
    """The wall at x = 0: panels of wood with joints, two double doors, the screen, plaster."""
    at = 0.0
    for y0, y1 in DOORS + ((WIDTH, WIDTH),):
        mesh.panel("panel", (0, at, 0), (0, y0 - at, 0), (0, 0, PANELLED), VENEER, (0, 7, 0))
        begin, end = at + (0.06 if at else 0), y0 - (0.06 if y0 < WIDTH else 0)
        mesh.box("skirting", (0, begin, 0), (0.015, end, 0.08), ("z0",))
        if y1 > y0:
            mesh.panel("panel", (0, y0, DOOR_H), (0, y1 - y0, 0), (0, 0, PANELLED - DOOR_H),
                       VENEER, (0, 7, 0))
            double_door(mesh, y0, y1)
        at = y1
    mesh.panel("plaster", (0, 0, PANELLED), (0, WIDTH, 0), (0, 0, HEIGHT - PANELLED), PLASTER)
    mesh.box("dark", (0, 0, PANELLED - 0.012), (0.006, WIDTH, PANELLED + 0.012))
    mesh.box("dark", (0, 0, DOOR_H + 0.06), (0.002, WIDTH, DOOR_H + 0.07))
    for k in range(-3, 4):
        mesh.box("dark", (0, 7 + 1.8 * k - 0.005, 0.08), (0.002, 7 + 1.8 * k + 0.005, PANELLED))
    (y0, y1), (z0, z1) = SCREEN
    edge = 0.05
    mesh.box("black", (0.01, y0 - edge, z0 - edge), (0.055, y1 + edge, z1 + edge))
    mesh.panel("slide", (0.0562, y0, z0), (0, y1 - y0, 0), (0, 0, z1 - z0), (y1 - y0, z1 - z0))


def double_door(mesh, y0, y1):
    """Two leaves of veneer in a frame, 0.09 m behind the wall, with bars to push."""
    mesh.box("frame", (-0.09, y0 - 0.06, 0), (0.012, y0, DOOR_H + 0.06))
    mesh.box("frame", (-0.09, y1, 0), (0.012, y1 + 0.06, DOOR_H + 0.06))
    mesh.box("frame", (-0.09, y0, DOOR_H), (0.012, y1, DOOR_H + 0.06))
    mesh.box("dark", (-0.09, y0, 0), (-0.05, y1, DOOR_H))
    mesh.box("frame", (-0.09, y0, -0.01), (0.001, y1, 0.003), ("z0",))
    middle = (y0 + y1) / 2
    for a, b in ((y0, middle - 0.002), (middle + 0.002, y1)):
        mesh.panel("leaf", (-0.048, a, 0.006), (0, b - a, 0), (0, 0, DOOR_H - 0.008), (0.8, DOOR_H))
        mesh.box("steel", (-0.048, a + 0.02, 0.02), (-0.0465, b - 0.02, 0.25))
        mesh.limb("steel", (0.012, a + 0.08, 1.0), (0.012, b - 0.08, 1.0), 0.014, 0.014, 12)
        for y in (a + 0.10, b - 0.10):
            mesh.box("steel", (-0.048, y - 0.02, 0.96), (0.012, y + 0.02, 1.04))
        mesh.box("night", (-0.048, (a + b) / 2 - 0.09, 1.3), (-0.0465, (a + b) / 2 + 0.09, 1.8))


def side_walls(mesh):
    """Behind the slats black felt, flat panels beside the stage, plaster above and at the back."""
    for y, side in ((0.0, 1), (WIDTH, -1)):
        def piece(part, x0, x1, z0, z1, metres, y=y, side=side):
            start, way = (x1, x0 - x1) if side > 0 else (x0, x1 - x0)
            mesh.panel(part, (start, y, z0), (way, 0, 0), (0, 0, z1 - z0), metres)

        def strip(part, x0, x1, z0, z1, depth, y=y, side=side):
            a, b = sorted((y, y + side * depth))
            mesh.box(part, (x0, a, z0), (x1, b, z1))
        piece("panel", 0, 3.6, 0, PANELLED, VENEER)
        for x in (1.8, 3.595):
            strip("dark", x - 0.005, x + 0.005, 0.08, PANELLED, 0.002)
        strip("dark", 0, 3.6, DOOR_H + 0.06, DOOR_H + 0.07, 0.002)
        piece("felt", 3.6, 15.6, 0, PANELLED, (1, 1))
        piece("panel", 15.6, LENGTH, 0, PANELLED, VENEER)
        piece("plaster", 0, LENGTH, PANELLED, HEIGHT, PLASTER)
        strip("board", 0, LENGTH, PANELLED, PANELLED + 0.03, 0.20)
        a, b = sorted((y + side * 0.18, y + side * 0.20))
        mesh.box("board", (0, a, PANELLED + 0.03), (LENGTH, b, PANELLED + 0.06))
        strip("skirting", 0, 3.6, 0, 0.08, 0.015)
        strip("skirting", 3.6, RAKE + 1, 0, 0.10, 0.06)
        for k in range(1, ROWS + 1):
            end = LENGTH if k == ROWS else RAKE + k + 1
            strip("skirting", RAKE + k, end, RISE * k, RISE * k + 0.10, 0.06)


def back_wall(mesh):
    """Panels of fabric on plaster, and the window of the projection room."""
    x, z = LENGTH, RISE * ROWS
    mesh.panel("plaster", (x, WIDTH, z), (0, -WIDTH, 0), (0, 0, HEIGHT - z), PLASTER)
    mesh.box("skirting", (x - 0.015, 0, z), (x, WIDTH, z + 0.10))
    for k in range(8):
        y = 0.35 + 1.7 * k
        if 5.2 < y + 0.7 < 8.8:
            continue
        low, high = z + 0.35, PANELLED + 0.3
        mesh.box("fabric", (x - 0.05, y, low), (x, y + 1.4, high), ("x0", "x1"))
        mesh.panel("fabric", (x - 0.05, y + 1.4, low), (0, -1.4, 0), (0, 0, high - low), (0.5, 0.5))
    mesh.box("black", (x - 0.04, 5.6, 3.45), (x, 8.4, 4.45))
    mesh.box("night", (x - 0.045, 5.66, 3.51), (x - 0.04, 8.34, 4.39))


def raft(mesh, x):
    """A convex raft, lowest in its middle, 0.04 m thick."""
    (low, high), pieces = RAFT_Y, 4
    for k in range(12):
        (a, za), (b, zb) = ((x + RAFT_X * t / 12, RAFT_Z + SAG * (t / 6 - 1) ** 2)
                            for t in (k, k + 1))
        # Pieces, because patches of long thin triangles are many and small.
        for y0, y1 in ((low + (high - low) * i / pieces, low + (high - low) * (i + 1) / pieces)
                       for i in range(pieces)):
            mesh.face("raft", [(a, y1, za), (b, y1, zb), (b, y0, zb), (a, y0, za)])
            mesh.face("raft", [(a, y0, za + 0.04), (b, y0, zb + 0.04), (b, y1, zb + 0.04),
                               (a, y1, za + 0.04)])
        for y, turn in ((low, 1), (high, -1)):
            mesh.face("raft", [(a, y, za), (b, y, zb), (b, y, zb + 0.04),
                               (a, y, za + 0.04)][::turn])
        if k in (0, 11):
            e, z, turn = (a, za, 1) if k == 0 else (b, zb, -1)
            mesh.face("raft", [(e, high, z), (e, low, z), (e, low, z + 0.04),
                               (e, high, z + 0.04)][::turn])


def ceiling(mesh):
    """The soffit, and below it six convex rafts on wires."""
    mesh.panel("plaster", (0, 0, HEIGHT), (0, WIDTH, 0), (LENGTH, 0, 0), PLASTER)
    for x in RAFTS:
        raft(mesh, x)
        for y in (2.5, 5.5, 8.5, 11.5):
            for a in (x + 0.3, x + RAFT_X - 0.3):
                mesh.lathe("steel", (a, y, RAFT_Z + 0.05), [(0.003, 0), (0.003, 1.05)], 6)
        for way in (-0.35, 0.35):
            for k in range(6):
                mesh.lathe("white metal", (x + RAFT_X / 2 + way, 2.0 + 2.0 * k, RAFT_Z + 0.008),
                           [(0.084, 0.003), (0.104, 0), (0.107, 0.009)], 20)
    for x in (2.35, 7.65, 12.75):
        for y in (3.5, 10.5):
            detector(mesh, x, y, HEIGHT)


def projector(mesh):
    x, y, z = 9.9, 7.0, 4.72
    mesh.box("white plastic", (x - 0.28, y - 0.25, z), (x + 0.28, y + 0.25, z + 0.2))
    mesh.lathe("black", (x - 0.34, y - 0.08, z + 0.1), [(0, 0), (0.05, 0), (0.065, 0.06)], 24, "x")
    mesh.limb("white metal", (x, y, z + 0.2), (x, y, HEIGHT), 0.02, 0.02, 12)


def spots(mesh):
    """A rail below the first gap of the rafts, with three spots that look at the stage."""
    x, z = 7.55, 4.95
    mesh.box("black", (x - 0.02, 2.5, z + 0.13), (x + 0.02, 11.5, z + 0.17))
    for y in (3.0, 7.0, 11.0):
        mesh.limb("black", (x, y, z + 0.17), (x, y, HEIGHT), 0.006, 0.006, 8)
    for y in (4.2, 9.3, 10.4):
        mesh.limb("black", (x + 0.02, y, z + 0.02), (x + 0.22, y, z + 0.12), 0.06, 0.05, 16)


def auditorium(folder):
    mesh = Mesh()
    for part in (rake, end_panels, stage, stage_wall, side_walls, back_wall, ceiling, projector,
                 spots):
        part(mesh)
    bottle = Mesh()
    extinguisher(bottle, 0.0, 0.0, 1)
    # It is drawn on a wall that looks along +y, and turned to the stage wall, which looks along +x.
    mesh.add(bottle, lambda at: (at[1], 2.68 - at[0], at[2]))
    mesh.write(folder / "auditorium.obj", "An auditorium of nine raked rows.")


def slats(folder):
    """A bay of 2.4 m of a wall whose front looks along +y: fifteen slats and a flat panel."""
    mesh = Mesh()
    for k in range(15):
        x, u = 0.64 + 0.12 * k, (0.37 * k) % 1
        faces = (((x + 0.07, 0.05), (x, 0.05)), ((x, 0.05), (x, 0.0)),
                 ((x + 0.07, 0.0), (x + 0.07, 0.05)))
        for (x0, y0), (x1, y1) in faces:
            wide = math.dist((x0, y0), (x1, y1)) / 0.9
            mesh.face("slat", [(x0, y0, 0), (x1, y1, 0), (x1, y1, PANELLED), (x0, y0, PANELLED)],
                      [(u, 0), (u + wide, 0), (u + wide, 2), (u, 2)])
    mesh.panel("panel", (0.59, 0.07, 0), (-0.59, 0, 0), (0, 0, PANELLED), (0.59, 2.1))
    mesh.panel("panel", (0, 0.07, 0), (0, -0.07, 0), (0, 0, PANELLED), (0.9, 2.1))
    mesh.panel("panel", (0.59, 0, 0), (0, 0.07, 0), (0, 0, PANELLED), (0.9, 2.1))
    # A wall light that shines up and down, in the middle of the flat panel.
    mesh.box("lamp", (0.235, 0.07, 3.20), (0.355, 0.17, 3.42))
    mesh.write(folder / "slats.obj", "A bay of slats.")
