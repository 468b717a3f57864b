#!/usr/bin/env python3
"""Writes the textures and meshes of scenes/library/showcase.

    python3 tests/tools/make_showcase.py [folder [names of functions]]

Textures are procedural: periodic lattice noise and plain shapes, as 8-bit PNG files. Meshes are
Wavefront OBJ files: metres, z up, parts by material, with texture coordinates. The same run writes
the same bytes. The functions are those of the package `showcase` beside this file.
"""

import pathlib
import sys

from showcase.auditorium import auditorium, slats
from showcase.corridor import corridor
from showcase.people import person, seated_person
from showcase.seats import seat
from showcase.slide import slide
from showcase.stairwell import stairwell
from showcase.textures import (carpet, ceiling_tile, parquet, plaster, prints, terrazzo, upholstery,
                               veneer)


def main():
    only = sys.argv[2:]
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else (
        pathlib.Path(__file__).resolve().parents[2] / "scenes/library/showcase")
    folder.mkdir(parents=True, exist_ok=True)
    for make in (parquet, veneer, ceiling_tile, plaster, carpet, terrazzo, prints, upholstery,
                 slide, corridor, stairwell, auditorium, slats, seat, person, seated_person):
        if not only or make.__name__ in only:
            make(folder)


if __name__ == "__main__":
    main()
