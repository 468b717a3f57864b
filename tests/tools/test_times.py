#!/usr/bin/env python3
"""Measures the processor time of each test that ./test.sh runs, one after another, with that of the
processes that it starts and awaits; asserts nothing. It hardly depends on the machine's load,
unless a test waits for a point in time.

    tests/tools/test_times.py build/release            all, the 40 longest, and folders
    tests/tools/test_times.py build/release examples   those whose names match
"""
import collections
import json
import os
import re
import subprocess
import sys
import tempfile
import time


def tests_of(folder, pattern):
    listed = subprocess.run(
        ["ctest", "--test-dir", folder, "-LE", "^long$", "--show-only=json-v1"],
        capture_output=True, text=True, check=True)
    for test in json.loads(listed.stdout)["tests"]:
        if "command" in test and re.search(pattern, test["name"]):
            yield test


def run(test, folder):
    """Processor and elapsed seconds, and whether the test passed or was skipped."""
    properties = {p["name"]: p["value"] for p in test.get("properties", [])}
    began = time.monotonic()
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            test["command"], cwd=properties.get("WORKING_DIRECTORY", folder),
            stdin=subprocess.DEVNULL, stdout=said, stderr=said)
        _, status, used = os.wait4(process.pid, 0)
    code = process.returncode = os.waitstatus_to_exitcode(status)
    well = code in (0, properties.get("SKIP_RETURN_CODE", 0))
    return used.ru_utime + used.ru_stime, time.monotonic() - began, well


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder, pattern = sys.argv[1], sys.argv[2] if len(sys.argv) == 3 else ""
    taken = []
    for test in tests_of(folder, pattern):
        taken.append((*run(test, folder), test["name"]))
    by_folder = collections.Counter()
    for seconds, _, _, name in taken:
        by_folder[name.split(":")[0]] += seconds
    for seconds, passed, well, name in sorted(taken, reverse=True)[:40]:
        print(f"{seconds:8.1f} s of processor time, {passed:7.1f} s passed  {name}")
    for name, seconds in by_folder.most_common(20):
        print(f"{seconds:8.1f} s of processor time  {name}")
    for _, _, well, name in taken:
        if not well:
            print(f"failed: {name}")
    print(f"{len(taken)} tests: {sum(t[0] for t in taken):.1f} s of processor time, "
          f"{sum(t[1] for t in taken):.1f} s passed")


if __name__ == "__main__":
    main()
