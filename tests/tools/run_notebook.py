#!/usr/bin/env python3
"""run_notebook.py [--write] [NOTEBOOK]: runs the code cells of a notebook one after another, as
Jupyter would, with plain python3 and the module of build/release (or of PYTHONPATH). Without a name
it is the notebook of the guide. Cells that import a missing package are skipped with a message.

It checks that the notebook holds its outputs, that what cells print is what they hold, figures of
time apart, and that the page of the guide has the same code. Exit code 1 if a cell fails or they
differ; 77 if the module was not built, or Python has no NumPy.

--write runs the notebook in Jupyter and keeps its outputs; it needs Debian's python3-nbclient,
python3-ipykernel and python3-matplotlib."""
import contextlib
import io
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
    """Runs a cell; returns what it prints, or None if it is left out."""
    printed = io.StringIO()
    try:
        with contextlib.redirect_stdout(printed):
            exec(compile(code, f"cell {number}", "exec"), names)
        return printed.getvalue()
    except ModuleNotFoundError as error:
        if error.name.split(".")[0] not in OPTIONAL:
            raise
        print(f"run_notebook.py: cell {number} is left out: {error.name} is not installed")
        return None


def printed_in(cell):
    """What a cell has printed when it was run in Jupyter."""
    return "".join("".join(output["text"]) for output in cell["outputs"]
                   if output["output_type"] == "stream" and output["name"] == "stdout")


def without_progress(code, text):
    """A cell that shows its progress prints as often as time allows."""
    return "" if "progress=" in code else text


def write(notebook):
    import nbclient
    import nbformat
    os.environ["PYTHONPATH"] = os.pathsep.join(sys.path[:2])
    content = nbformat.read(notebook, as_version=4)
    nbclient.NotebookClient(content, timeout=600,
                            resources={"metadata": {"path": str(ROOT)}}).execute()
    for cell in content.cells:
        cell.metadata.pop("execution", None)  # the time of day
    content.metadata.language_info = {"name": "python"}
    nbformat.write(content, notebook)


def code_of_page(page):
    return [block.strip() for block in re.findall(r"```python\n(.*?)```", page.read_text(), re.S)]


def main():
    named = [word for word in sys.argv[1:] if word != "--write"]
    notebook = pathlib.Path(named[0]) if named else ROOT / "docs/guide/python.ipynb"
    sys.path.insert(0, str(ROOT / "build/release"))
    sys.path[:0] = [p for p in os.environ.get("PYTHONPATH", "").split(":") if p]
    try:
        import luxodus
        import numpy  # noqa: F401  results are its arrays
    except ModuleNotFoundError as error:
        print(f"run_notebook.py: {error.name} is not there: build it, or ./setup.sh",
              file=sys.stderr)
        return 77
    if "--write" in sys.argv:
        write(notebook)
    codes, cells = cells_of(notebook)
    cells = [c for c in cells if c["cell_type"] == "code"]
    if [c.get("execution_count") for c in cells] != list(range(1, len(cells) + 1)):
        print(f"{notebook}: it does not hold its outputs: run_notebook.py --write",
              file=sys.stderr)
        return 1
    page = notebook.with_suffix(".md")
    if page.exists() and [c.strip() for c in codes] != code_of_page(page):
        print(f"{notebook}: its code is not that of {page}", file=sys.stderr)
        return 1
    os.chdir(ROOT)
    names = {"__name__": "__main__"}
    for number, code in enumerate(codes, 1):
        print(f"run_notebook.py: cell {number} of {len(codes)}, luxodus {luxodus.__version__}")
        printed = run(code, number, names)
        kept = printed_in(cells[number - 1])
        if printed is not None and without_progress(code, printed) != without_progress(code, kept):
            print(f"{notebook}: cell {number} prints\n{printed}and holds\n{kept}"
                  "If it is right now: run_notebook.py --write", file=sys.stderr)
            return 1
    print(f"passed: {len(codes)} cells of {notebook.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
