#!/usr/bin/env bash
# real_files.sh FOLDER [LUXODUS]: opens every file of a folder that an import reads or a scene may
# name (FDS, IFC, DXF, meshes, photometry, by extension), each by the program, and prints for each
# kind how many were opened, refused and warned of, time and memory, then each refused file with its
# reason. A file that ends the program by a signal, or takes longer than SECONDS_EACH (default
# 300), is counted apart, and makes this fail. JOBS files are opened at once (default 1). Outside of
# CI: folders of real files are not in the repository.
set -euo pipefail

folder=${1:?usage: real_files.sh FOLDER [LUXODUS]}
luxodus=${2:-$(cd "$(dirname "$0")/../.." && pwd)/build/release/luxodus}
exec python3 - "$folder" "$luxodus" "${SECONDS_EACH:-300}" "${JOBS:-1}" <<'PYTHON'
import collections, concurrent.futures, os, pathlib, re, signal, sys, tempfile, time

folder, luxodus = pathlib.Path(sys.argv[1]), sys.argv[2]
limit_s, jobs = float(sys.argv[3]), int(sys.argv[4])
KINDS = {".fds": "FDS input", ".smv": "FDS results", ".ifc": "IFC", ".dxf": "DXF", ".obj": "OBJ",
         ".gltf": "glTF", ".glb": "glTF", ".ldt": "EULUMDAT", ".ies": "IES", ".gldf": "GLDF"}
MESHES, LIGHTS = {".obj", ".gltf", ".glb"}, {".ldt", ".ies"}
# A closed room, so that warnings are those of the file.
ROOM = """[[object]]
name = "room"
shape = "room"
low = [-%(half)g, -%(half)g, -%(half)g]
high = [%(half)g, %(half)g, %(half)g]
material = "grey50"
one_patch = true
"""
Outcome = collections.namedtuple("Outcome", "file kind state reason warnings seconds mebibytes")


def quoted(path):
    return '"' + str(path).replace("\\", "\\\\").replace('"', '\\"') + '"'


def command(file, scratch):
    """What opens this file, as the words of a command."""
    ending = file.suffix.lower()
    out = str(scratch / "out")
    if ending in (".fds", ".smv"):
        return ["import", "fds", str(file), "--out", out]
    if ending in (".ifc", ".dxf"):
        return ["import", ending[1:], str(file), "--out", out]
    if ending == ".gldf":
        return ["import", "gldf", str(file)]
    scene = scratch / "scene.toml"
    if ending in MESHES:
        scene.write_text(ROOM % {"half": 1e4} +
                         '[[import]]\nname = "file"\nfile = %s\nunits = "m"\nup = "y"\n'
                         'material = "grey50"\n[[emitter]]\nname = "lamp"\nshape = "point"\n'
                         'flux_lm = 1\nposition = [9999, 9999, 9999]\n' % quoted(file))
    else:
        scene.write_text(ROOM % {"half": 5} +
                         '[[luminaire]]\nname = "file"\nfile = %s\nposition = [0, 0, 3]\n'
                         'maintenance_factor = 1\n' % quoted(file))
    return ["check", str(scene)]


def run(words, scratch):
    """Exit code (negative: a signal; None: too late), what it said, seconds, largest memory."""
    said = scratch / "said"
    begun = time.monotonic()
    child = os.fork()
    if child == 0:
        os.setsid()
        os.chdir(scratch)
        with open(said, "wb") as to:
            os.dup2(to.fileno(), 1)
            os.dup2(to.fileno(), 2)
        os.dup2(os.open("/dev/null", os.O_RDONLY), 0)
        os.execv(luxodus, [luxodus, *words])
    late = False
    while True:
        done, status, used = os.wait4(child, os.WNOHANG)
        if done:
            break
        if not late and time.monotonic() - begun > limit_s:
            late = True
            os.killpg(child, signal.SIGKILL)
        time.sleep(0.005)
    code = None if late else os.waitstatus_to_exitcode(status)
    return code, said.read_text(errors="replace"), time.monotonic() - begun, used.ru_maxrss / 1024


def opened(file):
    kind = KINDS[file.suffix.lower()]
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        words = command(file, scratch)
        code, said, seconds, mebibytes = run(words, scratch)
        unit = kind == "DXF" and code == 2 and "say it by --units" in said
        if unit:  # a plan without a unit is asked for one, which is no refusal
            code, said, seconds, mebibytes = run(words + ["--units", "mm"], scratch)
    # Findings of the scene about the file, not about the room around it.
    warnings = [line for line in said.splitlines()
                if re.search(r"(?:^|\s)(?:warning|note): ", line)
                and (words[0] == "import" or file.name in line)]
    if unit:
        warnings.append("the drawing states no unit")
    reason = ""
    if code != 0:
        lines = [line for line in said.splitlines() if line.strip()]
        reason = lines[0] if lines else "nothing was said"
        for part in (str(file.parent) + "/", name + "/"):
            reason = reason.replace(part, "")
    state = ("opened" if code == 0 else "too late" if code is None else
             "ended by signal %d" % -code if code < 0 else
             "not tried" if "./setup.sh" in said else "refused")
    return Outcome(file, kind, state, reason, warnings, seconds, mebibytes)


files = sorted(f for f in folder.rglob("*") if f.is_file() and f.suffix.lower() in KINDS)
with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
    outcomes = list(pool.map(opened, (f.resolve() for f in files)))

print("%-12s %6s %7s %8s %7s %6s %9s %9s %11s" % ("kind", "files", "opened", "refused", "warned",
                                                 "wrong", "time [s]", "most [s]", "most [MiB]"))
wrong = []
for kind in dict.fromkeys(KINDS.values()):
    those = [o for o in outcomes if o.kind == kind]
    if not those:
        continue
    bad = [o for o in those if o.state not in ("opened", "refused", "not tried")]
    wrong += bad
    print("%-12s %6d %7d %8d %7d %6d %9.1f %9.1f %11.0f" % (
        kind, len(those), sum(o.state == "opened" for o in those),
        sum(o.state == "refused" for o in those),
        sum(o.state == "opened" and bool(o.warnings) for o in those), len(bad),
        sum(o.seconds for o in those), max(o.seconds for o in those),
        max(o.mebibytes for o in those)))
missing = [o for o in outcomes if o.state == "not tried"]
if missing:  # a package of the program, which is no fault of the files
    print("\nnot tried: %d files, because %s" % (len(missing), missing[0].reason))
for state in ("refused", "wrong"):
    those = [o for o in outcomes if (o in wrong if state == "wrong" else o.state == state)]
    if those:
        print("\n" + state)
    for o in those:
        told = o.reason if state == "refused" else o.state + ": " + o.reason
        print("  %s: %s" % (o.file.relative_to(folder.resolve()), told))
sys.exit(1 if wrong else 0)
PYTHON
