#!/usr/bin/env python3
"""Reads visibility.npz back by the rules of pyFDS-Evac, without any code of either program.

    read_visibility_map.py FILE [--config CONFIG --fds-dir DIR --interval S --slice-height M]
                                [--ask T,X,Y,SIGN ...]

With a configuration it says first "taken" or "not taken": pyFDS-Evac compares the description of
the file with its own and computes anew where they differ. Then a line "true" or "false" for each
question. Nearest time and place count, a tie goes to the lower one, and outside the map its border.
Uses numpy where it is installed, else the standard library alone.
"""
import argparse
import ast
import json
import os
import struct
import sys
import zipfile


def load_by_numpy(file):
    import numpy

    with numpy.load(file, allow_pickle=False) as data:
        arrays = {name: data[name] for name in ("time_points", "x_coords", "y_coords", "vis")}
        meta = str(data["meta"])
    if arrays["vis"].dtype != numpy.bool_ or arrays["vis"].ndim != 4:
        raise ValueError("vis is no boolean array of four dimensions")
    shape = arrays["vis"].shape
    flat = arrays["vis"].reshape(-1).tolist()
    axes = [arrays[name].tolist() for name in ("time_points", "x_coords", "y_coords")]
    return axes, shape, flat, meta


def npy(data):
    """Shape and values of one array of format version 1.0."""
    if data[:8] != b"\x93NUMPY\x01\x00":
        raise ValueError("no .npy of version 1.0")
    (length,) = struct.unpack_from("<H", data, 8)
    if (10 + length) % 64:
        raise ValueError("the header does not end at a multiple of 64")
    header = ast.literal_eval(data[10 : 10 + length].decode("latin1"))
    if header["fortran_order"]:
        raise ValueError("not in C order")
    shape, kind, body = header["shape"], header["descr"], data[10 + length :]
    count = 1
    for size in shape:
        count *= size
    if kind == "<f8":
        return shape, list(struct.unpack(f"<{count}d", body))
    if kind == "|b1":
        if len(body) != count or set(body) - {0, 1}:
            raise ValueError("not as many truth values as the shape says")
        return shape, [value == 1 for value in body]
    if kind.startswith("<U"):
        return shape, [body.decode("utf-32-le").rstrip("\0")]
    raise ValueError(f"unexpected type {kind}")


def load_by_hand(file):
    with zipfile.ZipFile(file) as archive:
        if archive.testzip() is not None:
            raise ValueError("a checksum is wrong")
        arrays = {
            name: npy(archive.read(name + ".npy"))
            for name in ("time_points", "x_coords", "y_coords", "vis", "meta")
        }
    axes = [arrays[name][1] for name in ("time_points", "x_coords", "y_coords")]
    return axes, arrays["vis"][0], arrays["vis"][1], arrays["meta"][1][0]


def nearest(axis, value):
    """The index of the nearest coordinate, at least that of an end."""
    above = next((i for i, at in enumerate(axis) if at >= value), len(axis))
    if above == 0:
        return 0
    if above == len(axis):
        return len(axis) - 1
    return above if axis[above] - value < value - axis[above - 1] else above - 1


def expected_description(config, fds_dir, interval, slice_height):
    signs = {}
    for section in ("exits", "checkpoints", "waypoints"):
        for node, data in config.get(section, {}).items():
            if data.get("sign"):
                signs[node] = data["sign"]
    return {
        "fds_dir": os.path.realpath(fds_dir),
        "waypoints": [
            [node, sign.get("x"), sign.get("y"), sign.get("alpha"), sign.get("c", 3)]
            for node, sign in signs.items()
        ],
        "time_step_s": interval,
        "slice_height_m": slice_height,
    }


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("--config")
    parser.add_argument("--fds-dir", default=".")
    parser.add_argument("--interval", type=float, default=10.0)
    parser.add_argument("--slice-height", type=float, default=2.0)
    parser.add_argument("--ask", action="append", default=[])
    parser.add_argument("--by-hand", action="store_true", help="without numpy")
    given = parser.parse_args()
    try:
        load = load_by_hand if given.by_hand else load_by_numpy
        axes, shape, vis, meta = load(given.file)
    except ImportError:
        axes, shape, vis, meta = load_by_hand(given.file)
    times, xs, ys = axes
    description = json.loads(meta)
    signs = description["waypoints"]
    if tuple(shape) != (len(times), len(signs), len(ys), len(xs)):
        sys.exit(f"the shape {shape} is not that of times, signs, rows and columns")
    for axis in axes:
        if any(b <= a for a, b in zip(axis, axis[1:])):
            sys.exit("coordinates do not ascend")
    if given.config:
        with open(given.config, encoding="utf-8") as file:
            wanted = expected_description(
                json.load(file), given.fds_dir, given.interval, given.slice_height
            )
        print("taken" if description == wanted else "not taken")
    nodes = [sign[0] for sign in signs]
    for question in given.ask:
        t, x, y, node = question.split(",", 3)
        if node not in nodes:
            sys.exit(f"there is no sign {node!r}; signs: {nodes}")
        at = (nearest(times, float(t)) * len(signs) + nodes.index(node)) * len(ys)
        at = (at + nearest(ys, float(y))) * len(xs) + nearest(xs, float(x))
        print("true" if vis[at] else "false")


if __name__ == "__main__":
    main()
