"""The mesh of scenes/library/showcase/stairwell.toml."""

from showcase.fittings import DOOR_H, DOOR_W, door, extinguisher
from showcase.mesh import Mesh

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
        mesh.add(one, lambda at, z=z: (at[0], at[1], at[2] + z))
    extinguisher(mesh, 1.75, 0.0, +1)
    for z in (STOREY - 0.2, 2 * STOREY - 0.2):
        mesh.lathe("white plastic", (1.3, 0.7, z - 0.055), [(0, 0), (0.15, 0), (0.165, 0.02),
                                                            (0.165, 0.055)], 36)
    mesh.write(folder / "stairwell.obj", "A stairwell of two storeys.")
