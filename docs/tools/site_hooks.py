"""What MkDocs does besides turning Markdown into pages. Two lines in a page are replaced:

    <!-- include PATH "HEADING" -->   the section of a README of this repository, whole
    <!-- help -->                     what `luxodus --help` and each `luxodus COMMAND --help` print

So tables of keys and options exist once, in the README that a test holds against the program's
schema, and in the program. Links to a file that is a page of this site lead to that page; links to
other files of the repository become their path.

The program is that of the variable LUXODUS, or build/release/luxodus. Where there is none, the page
says which command prints the text.
"""
import os
import re
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
INCLUDE = re.compile(r'^<!-- include (\S+) "([^"]+)" -->$', re.M)
HELP = re.compile(r"^<!-- help -->$", re.M)
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")
OUTSIDE = re.compile(r"^[a-z]+:")

pages_of_sources = {}  # PATH of a README -> page that includes it


def program():
    path = os.environ.get("LUXODUS", os.path.join(ROOT, "build/release/luxodus"))
    return path if os.access(path, os.X_OK) else None


def help_of(path, command):
    """The help text of a command, `command` being a list of words; None where it is none."""
    done = subprocess.run([path, *command, "--help"], capture_output=True, text=True, timeout=60)
    return done.stdout.replace(path, "luxodus") if done.returncode == 0 else None


def subcommands(text):
    """Names under the headings of a help text that are neither options nor positionals."""
    names, listed = [], False
    for line in text.splitlines():
        if re.match(r"^\S.*:$", line):
            listed = line not in ("Options:", "Positionals:")
        entry = re.match(r"^  ([a-z][a-z-]*)(?:  +\S.*)?$", line)
        if listed and entry:
            names.append(entry.group(1))
    return names


def all_commands(path, command=()):
    """(words, help text) of the program, its commands and theirs, in the order of the help."""
    text = help_of(path, list(command))
    if text is None:
        return []
    found = [(list(command), text)]
    for name in subcommands(text):
        found += all_commands(path, [*command, name])
    return found


def section(path, heading):
    """A section of a Markdown file from its heading to the next one of its level or above. That of
    the file's title is without it: the page has a title of its own."""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        lines = file.read().split("\n")
    level, start, fenced = 0, None, False
    for number, line in enumerate(lines):
        fenced ^= line.startswith("```")
        found = None if fenced else re.match(r"^(#+) (.*)$", line)
        if not found:
            continue
        if start is None and found.group(2) == heading:
            level, start = len(found.group(1)), number
        elif start is not None and len(found.group(1)) <= level:
            return "\n".join(lines[start:number])
    if start is None:
        raise ValueError(f"{path} has no heading '{heading}'")
    return "\n".join(lines[start + 1 if level == 1 else start :])


def moved_links(text, source, page):
    """Links of a text of `source` as they must be written in `page`, a path below docs/."""

    def moved(link):
        picture, words, target = link.groups()
        if OUTSIDE.match(target) or target.startswith("#"):
            return link.group(0)
        path, _, anchor = target.partition("#")
        path = os.path.normpath(os.path.join(os.path.dirname(source), path))
        if path.startswith("docs" + os.sep):
            there = path[len("docs") + 1 :]
        else:
            there = pages_of_sources.get(path)
        if there:
            target = os.path.relpath(there, os.path.dirname(page) or ".")
            return f"{picture}[{words}]({target}{'#' + anchor if anchor else ''})"
        return f"`{path}`" if words in (path, os.path.basename(path)) else f"{words} (`{path}`)"

    return LINK.sub(moved, text)


def on_config(config):
    """Fills the list of decisions into the navigation: their files are numbered."""
    folder = os.path.join(config["docs_dir"], "decisions")
    numbered = sorted(name for name in os.listdir(folder) if re.match(r"\d{4}-", name))
    pages = ["decisions/index.md"] + ["decisions/" + name for name in numbered]
    for entry in config["nav"]:
        if isinstance(entry, dict) and entry.get("Decisions") == "DECISIONS":
            entry["Decisions"] = pages
    return config


def on_files(files, config):
    for file in [f for f in files if f.src_path.startswith("tools/")]:
        files.remove(file)
    for file in files.documentation_pages():
        with open(file.abs_src_path, encoding="utf-8") as page:
            for path, _ in INCLUDE.findall(page.read()):
                pages_of_sources.setdefault(path, file.src_path)
    return files


def on_page_markdown(markdown, page, config, files):
    def included(found):
        path, heading = found.groups()
        text = moved_links(section(path, heading), path, page.file.src_path)
        return text + f"\n\n*This section is `{path}`, included when the site is built.*\n"

    def helped(_):
        path = program()
        if path is None:
            return "`luxodus --help` and `luxodus COMMAND --help` print it."
        parts = []
        for words, text in all_commands(path):
            parts.append(f"## {' '.join(['luxodus', *words])}\n\n```text\n{text.rstrip()}\n```\n")
        return "\n".join(parts)

    own = moved_links(markdown, "docs/" + page.file.src_path, page.file.src_path)
    return HELP.sub(helped, INCLUDE.sub(included, own))
