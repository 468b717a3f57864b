#!/usr/bin/env python3
"""Measures when first pictures come: first_pictures.py PROGRAM [SCENE [OPTIONS of luxodus run ...]]

Traces a scene (the office floor in smoke, 1 million particles) into a folder of its own and prints,
for flux.lux, which ends the tracing, and the first picture of each view: seconds of the clock since
the flux, and processor seconds of the program since then, which hardly depend on the machine's
load. Ends the program when all exist. Linux.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

OFFICE = ["scenes/library/office_floor.toml", "--scenario", "smoke_emergency"]
LOOK_AGAIN_S = 0.01
LONGEST_S = 600


def processor_seconds(pid):
    """Processor seconds of a process and its threads so far."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def views_of(folder):
    """Number of views of the run, which its result states from the beginning."""
    return len(json.loads((folder / "result.json").read_text())["cameras"])


def is_first_picture(file):
    return not file.stem.endswith(("_human", "_luminance"))


def watch(run, folder):
    """Prints files as they appear, until every view has a picture or the program ends."""
    began = time.monotonic()
    flux = None
    seen = set()
    while run.poll() is None and time.monotonic() - began < LONGEST_S:
        now = (time.monotonic(), processor_seconds(run.pid))
        if flux is None and (folder / "flux.lux").exists():
            flux = now
            print("flux.lux", flush=True)
        for file in sorted((folder / "views").glob("*.png")) if flux else []:
            if file in seen or not is_first_picture(file):
                continue
            seen.add(file)
            print(f"{file.stem}: {now[0] - flux[0]:.2f} s, processors {now[1] - flux[1]:.2f} s",
                  flush=True)
        if seen and len(seen) == views_of(folder):
            break
        time.sleep(LOOK_AGAIN_S)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program, scene = sys.argv[1], sys.argv[2:] or OFFICE
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.Popen(
            [program, "run", *scene, "--particles", "1e6", "--out", folder],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            watch(run, pathlib.Path(folder))
        finally:
            run.kill()
            run.wait()


if __name__ == "__main__":
    main()
