#!/usr/bin/env python3
"""walkers.py FILE [--people N] [--way X,Y:X,Y...] [--lane M] [--until S] [--fps N] [--seed N]

Writes trajectories as JuPedSim does (SQLite, version 2): people who walk along a way one after
another, each in a lane beside it and at a speed of his own, from 0.8 to 1.2 m/s. They avoid nobody:
this is a file for trying `luxodus walk`, no simulation of an evacuation.
"""
import argparse
import math
import random
import sqlite3


def points_of(text):
    return [tuple(float(x) for x in point.split(",")) for point in text.split(":")]


def place_along(way, metres, aside):
    """Place and direction after so many metres of the way, `aside` to its left."""
    for (x0, y0), (x1, y1) in zip(way, way[1:]):
        leg = math.hypot(x1 - x0, y1 - y0)
        dx, dy = (x1 - x0) / leg, (y1 - y0) / leg
        if metres <= leg or (x1, y1) == way[-1]:
            metres = min(metres, leg)
            return x0 + dx * metres - dy * aside, y0 + dy * metres + dx * aside, dx, dy
        metres -= leg


def walkers(options):
    """Rows (frame, id, x, y, direction x, direction y)."""
    numbers = random.Random(options.seed)
    way = points_of(options.way)
    length = sum(math.dist(a, b) for a, b in zip(way, way[1:]))
    slowest = 0.8
    for person in range(1, options.people + 1):
        speed = numbers.uniform(slowest, 1.2)
        start = numbers.uniform(0, options.until - length / slowest)
        aside = numbers.uniform(-options.lane, options.lane)
        first = math.ceil(start * options.fps)
        for frame in range(first, math.floor((start + length / speed) * options.fps) + 1):
            walked = speed * (frame / options.fps - start)
            yield (frame, person, *place_along(way, walked, aside))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--people", type=int, default=200)
    parser.add_argument("--way", default="11.2,1.2:0.6,1.2", help="points of the way [m]")
    parser.add_argument("--lane", type=float, default=0.5, help="farthest beside the way [m]")
    parser.add_argument("--until", type=float, default=90, help="when the last has arrived [s]")
    parser.add_argument("--fps", type=float, default=10)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    wkt = "POLYGON ((0 0, 12 0, 12 2.4, 0 2.4, 0 0))"
    with sqlite3.connect(options.file) as db:
        for table in ("trajectory_data", "metadata", "geometry", "frame_data"):
            db.execute(f"DROP TABLE IF EXISTS {table}")
        db.execute("CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, "
                   "pos_x REAL NOT NULL, pos_y REAL NOT NULL, "
                   "ori_x REAL NOT NULL, ori_y REAL NOT NULL)")
        db.execute("CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, "
                   "value TEXT NOT NULL)")
        db.execute("CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL)")
        db.execute("CREATE TABLE frame_data(frame INTEGER NOT NULL, "
                   "geometry_hash INTEGER NOT NULL)")
        db.executemany("INSERT INTO metadata VALUES(?, ?)",
                       [("version", "2"), ("fps", str(options.fps))])
        db.execute("INSERT INTO geometry VALUES(1, ?)", (wkt,))
        db.executemany("INSERT INTO trajectory_data VALUES(?, ?, ?, ?, ?, ?)", walkers(options))
    db.close()


if __name__ == "__main__":
    main()
