#!/usr/bin/env python3
"""run_notebook.py [NOTEBOOK]: runs the code cells of a notebook one after another, as Jupyter would,
with plain python3 and the module of build/release (or of PYTHONPATH). Without a name it is the
notebook of the guide. Cells that import a missing package are skipped with a message.

It then checks that the page of the guide and the notebook have the same code. Exit code 1 if a cell
fails or they differ; 77 if the module was not built, or Python has no NumPy."""
import json
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPTIONAL = {"matplotlib"}  # for plots: nothing else needs it


def cells_of(notebook):
    cells = json.loads(notebook.read_text())["cells"]
    return ["".join(c["source"]) for c in cells if c["cell_type"] == "code"], cells


def run(code, number, names):
    try:
        exec(compile(code, f"cell {number}", "exec"), names)
    except ModuleNotFoundError as error:
        if error.name.split(".")[0] not in OPTIONAL:
            raise
        print(f"run_notebook.py: cell {number} is left out: {error.name} is not installed")


def code_of_page(page):
    return [block.strip() for block in re.findall(r"```python\n(.*?)```", page.read_text(), re.S)]


def main():
    notebook = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/guide/python.ipynb"
    sys.path.insert(0, str(ROOT / "build/release"))
    sys.path[:0] = [p for p in os.environ.get("PYTHONPATH", "").split(":") if p]
    try:
        import luxodus
        import numpy  # noqa: F401  results are its arrays
    except ModuleNotFoundError as error:
        print(f"run_notebook.py: {error.name} is not there: build it, or ./setup.sh",
              file=sys.stderr)
        return 77
    codes, cells = cells_of(notebook)
    if any(c.get("outputs") or c.get("execution_count") for c in cells):
        print(f"{notebook}: it is kept without outputs: clear them", file=sys.stderr)
        return 1
    page = notebook.with_suffix(".md")
    if page.exists() and [c.strip() for c in codes] != code_of_page(page):
        print(f"{notebook}: its code is not that of {page}", file=sys.stderr)
        return 1
    os.chdir(ROOT)
    names = {"__name__": "__main__"}
    for number, code in enumerate(codes, 1):
        print(f"run_notebook.py: cell {number} of {len(codes)}, luxodus {luxodus.__version__}")
        run(code, number, names)
    print(f"passed: {len(codes)} cells of {notebook.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
