#!/usr/bin/env python3
"""Checks that no object with lower optimisation holds a function of the tracing loops.

  check_levels.py [--nm NM] --loops OBJECT ... --others OBJECT ...

The linker keeps one copy of an inline function or template that several objects hold. If an object
of a room with lower optimisation comes first, the tracing loops run its slow copy. Of --loops, only
kernel_*.cpp and trace.cpp count.
"""
import argparse
import os
import re
import subprocess
import sys


def weak_functions(nm, objects):
    """Our functions in these objects, by name, of which the linker keeps one copy."""
    text = subprocess.run([nm, "--demangle"] + objects, check=True, capture_output=True,
                          text=True).stdout
    names = re.findall(r"^[0-9a-f]+ W (.*)$", text, re.MULTILINE)
    return {name for name in names if "luxodus::" in name and not re.match(r"(\w+ )?std::", name)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--nm", default="nm")
    parser.add_argument("--loops", nargs="+", required=True)
    parser.add_argument("--others", nargs="+", required=True)
    options = parser.parse_args()
    loops = [o for o in options.loops if re.match(r"(kernel_\w+|trace)\.cpp", os.path.basename(o))]
    if not loops:
        sys.exit("check_levels.py: --loops names neither kernel_*.cpp nor trace.cpp")
    ours = weak_functions(options.nm, loops)
    failed = False
    for other in options.others:
        if os.path.exists(other):
            for name in sorted(ours & weak_functions(options.nm, [other])):
                print(f"{other}: {name}")
                failed = True
    if failed:
        sys.exit("These functions belong to the tracing loops: let a source of scenes/light/transport call"
                 " them, or name the room in LUX_HOT_ROOMS (CMakeLists.txt).")


if __name__ == "__main__":
    main()
