#!/usr/bin/python3
"""large_fire.py FOLDER [FRAMES]: writes results like those of FDS for a building of 5 million cells
in 16 meshes, with Smoke3D of soot and HRRPUV in 1000 frames by default (1.2 GB), and a scene of
them.
To measure the cost of opening it:

    tests/tools/large_fire.py /tmp/large
    /usr/bin/time -v luxodus check /tmp/large/scene.toml --at 700s
"""
import os
import struct
import sys

import numpy as np

MESHES, CELLS, EDGE_M = (4, 4), (80, 80, 49), 0.1  # 313 600 cells each


def record(payload):
    mark = struct.pack("<i", len(payload))
    return mark + payload + mark


def run_lengths(values):
    """Packs bytes like FDS: four or more equal ones become 255, value, count."""
    edges = np.flatnonzero(np.diff(values)) + 1
    out = bytearray()
    for start, end in zip(np.concatenate(([0], edges)), np.concatenate((edges, [len(values)]))):
        value, count = int(values[start]), int(end - start)
        while count >= 4:
            part = min(count, 254)
            out += bytes((255, value, part))
            count -= part
        out += bytes([value]) * count
    return bytes(out)


def layer(rng, depth):
    """Soot that hangs under the ceiling, with eddies: bytes by node, x fastest."""
    nx, ny, nz = (n + 1 for n in CELLS)
    z = np.arange(nz)[:, None, None]
    eddies = np.repeat(np.repeat(rng.integers(-4, 5, (ny // 3 + 1, nx // 3 + 1)), 3, 0), 3, 1)
    thick = np.clip((z - (nz - depth) + eddies[:ny, :nx]) * 6, 0, 200)
    return thick.astype(np.uint8).ravel()


def smoke_file(path, packed, frames):
    nodes = int(np.prod([n + 1 for n in CELLS]))
    with open(path, "wb") as out:
        out.write(record(struct.pack("<8i", 1, 0, 0, CELLS[0], 0, CELLS[1], 0, CELLS[2])))
        for frame in range(frames):
            payload = packed[min(frame * len(packed) // frames, len(packed) - 1)]
            out.write(record(struct.pack("<f", float(frame))))
            out.write(record(struct.pack("<2i", nodes, len(payload))))
            out.write(record(payload))


def main():
    folder = sys.argv[1]
    frames = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    os.makedirs(folder, exist_ok=True)
    rng = np.random.default_rng(1)
    nothing = run_lengths(np.zeros(int(np.prod([n + 1 for n in CELLS])), np.uint8))
    index = ["TITLE\n large\n\nFDSVERSION\nFDS-6.9.1-0-g0-made\n\nSURFACE\n INERT\n 5000.00 1.00\n"
             " 0 1 1 1 0.8 0.4 1\n null\n"]
    entries = []
    size = [n * EDGE_M for n in CELLS]
    for number in range(1, MESHES[0] * MESHES[1] + 1):
        i, j = (number - 1) % MESHES[0], (number - 1) // MESHES[0]
        low = (i * size[0], j * size[1], 0.0)
        index.append("\nOFFSET\n 0 0 0\n\nGRID mesh %d\n %d %d %d 0\n\nPDIM\n %s\n" % (
            number, *CELLS,
            " ".join("%.5f %.5f" % (low[a], low[a] + size[a]) for a in range(3))))
        for axis in range(3):
            index.append("\nTRN%s\n 1\n -1 0.0 0.0\n" % "XYZ"[axis])
            index += [" %d %.5f\n" % (n, low[axis] + n * EDGE_M) for n in range(CELLS[axis] + 1)]
        index.append("\nOBST\n 0\n\nVENT\n 0 0\n")
        depths = [run_lengths(layer(rng, depth)) for depth in (4, 8, 12, 16, 20, 24)]
        smoke_file(f"{folder}/large_{number}_1.s3d", [nothing] + depths, frames)
        smoke_file(f"{folder}/large_{number}_2.s3d", [nothing], frames)
        entries.append("SMOKF3D %d 8700.000\n large_%d_1.s3d\n SOOT DENSITY\n rho_C\n kg/m3\n"
                       % (number, number))
        entries.append("SMOKF3D %d 0.000\n large_%d_2.s3d\n HRRPUV\n hrrpuv\n kW/m3\n"
                       % (number, number))
    with open(f"{folder}/large.smv", "w", encoding="ascii") as out:
        out.write("".join(index) + "\n" + "\n".join(entries))
    with open(f"{folder}/scene.toml", "w", encoding="ascii") as out:
        out.write('title = "large"\n[[object]]\nname = "hall"\nshape = "room"\nlow = [0, 0, 0]\n'
                  "high = [%.5f, %.5f, %.5f]\n" % (MESHES[0] * size[0], MESHES[1] * size[1], size[2]) +
                  'material = "grey50"\n[[emitter]]\nname = "lamp"\nshape = "rectangle"\n'
                  "position = [16, 16, 4.5]\nsize = [1, 1]\nflux_lm = 5000\n"
                  f"[time]\nfrom = 0\nto = {frames - 1}\nstep = {max(1, frames // 10)}\n"
                  '[[medium]]\nname = "fire"\nkind = "fds"\nfile = "large.smv"\nalbedo = 0.2\n'
                  "g = 0.6\nangstrom = 1\n")


main()
