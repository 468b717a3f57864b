#!/usr/bin/env python3
"""Checks the documents of this repository: check_documents.py [--program LUXODUS] [--site FOLDER]

In all Markdown files, relative links lead to files, and their anchors to headings.
Files and folders of the repository that README.md and docs/ name exist.
Each test that docs/security.md names exists.
With --program: every `luxodus COMMAND --option` in README.md and docs/ is one that --help knows.
With --site: builds the site there by `mkdocs build --strict`; every link and anchor of its pages
leads somewhere, nothing is loaded from elsewhere, and the page of the command line holds what each
--help prints. Ends with 77 where mkdocs is absent, which CTest counts as skipped.
"""
import argparse
import glob
import html
import html.parser
import os
import re
import shutil
import subprocess
import sys
import urllib.parse

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "docs", "tools"))
sys.dont_write_bytecode = True
import site_hooks  # noqa: E402

SKIPPED = 77
NOT_OURS = {"build", "out", "node_modules", "dist", ".git"}
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def files_ending(suffix, top=""):
    found = []
    for folder, folders, files in os.walk(os.path.join(ROOT, top)):
        folders[:] = [f for f in folders if f not in NOT_OURS]
        found += [os.path.join(folder, f) for f in files if f.endswith(suffix)]
    return sorted(os.path.relpath(f, ROOT) for f in found)


def outside_fences(text):
    """The lines of a Markdown text, numbered from 1, without those of code blocks."""
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield number, line


def slugs(text):
    """Anchors of a text's headings, as MkDocs and as web hosts of repositories make them."""
    found = set()
    for _, line in outside_fences(text):
        heading = re.match(r"^#+ (.*)$", line)
        if heading:
            words = re.sub(r"[`*]", "", heading.group(1)).strip().lower()
            words = re.sub(r"[^\w\s-]", "", words)
            found |= {re.sub(r"[\s-]+", "-", words), words.replace(" ", "-")}
    return found


def check_links():
    problems = []
    for path in files_ending(".md"):
        for number, line in outside_fences(read(path)):
            for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
                if re.match(r"^[a-z]+:", target):
                    continue
                file, _, anchor = target.partition("#")
                beside = os.path.join(os.path.dirname(path), file)
                there = os.path.normpath(beside) if file else path
                if not os.path.exists(os.path.join(ROOT, there)):
                    problems.append(f"{path}:{number}: {target} leads nowhere")
                elif anchor and there.endswith(".md") and anchor not in slugs(read(there)):
                    problems.append(f"{path}:{number}: {there} has no heading #{anchor}")
    return problems


def check_named_files():
    tops = ("runtime/", "proto/", "topology/", "scenes/", "actors/", "tests/", "docs/")
    problems = []
    for path in ["README.md", "ARCHITECTURE.md"] + files_ending(".md", "docs"):
        for number, line in outside_fences(read(path)):
            for named in re.findall(r"`([^`\s]+)`", line):
                if not named.startswith(tops) or re.search(r"[*<>]", named):
                    continue
                there = os.path.join(ROOT, named.rstrip("/"))
                if not os.path.exists(there) and not glob.glob(there + ".*"):
                    problems.append(f"{path}:{number}: there is no {named}")
    return problems


def check_named_tests():
    names = []
    for path in files_ending(".cpp", "tests"):
        names += re.findall(r'TEST_CASE\(\s*"([^"]*)"', read(path))
    problems = []
    for number, line in outside_fences(read("docs/security.md")):
        if line.startswith("|"):
            for quoted in re.findall(r'"([^"]+)"', line):
                if not any(name.startswith(quoted.removesuffix("...")) for name in names):
                    problems.append(f'docs/security.md:{number}: there is no test "{quoted}"')
    return problems


def commands_in(text):
    """(line number, words) for each call of luxodus in the text's code."""
    fenced, joined = False, ""
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("```"):
            fenced = not fenced
            continue
        pieces = [joined + line] if fenced else re.findall(r"`([^`]*)`", line)
        joined = ""
        for piece in pieces:
            piece = piece.split(" #")[0]
            if fenced and piece.endswith("\\"):
                joined = piece[:-1]
                continue
            called = re.match(r"^\s*(?:\S*/)?luxodus ((?:[a-z]|--).*)$", piece)
            if called:
                yield number, called.group(1).split()


def check_commands(program):
    texts = {tuple(words): text for words, text in site_hooks.all_commands(program)}
    problems = [] if len(texts) > 15 else [f"{program} --help lists {len(texts)} commands only"]
    calls = 0
    for path in ["README.md"] + files_ending(".md", "docs"):
        for number, words in commands_in(read(path)):
            calls += 1
            command = ()
            while len(command) < len(words) and (*command, words[len(command)]) in texts:
                command = (*command, words[len(command)])
            if not command and not words[0].startswith("-"):
                problems.append(f"{path}:{number}: there is no command '{words[0]}'")
                continue
            for word in words[len(command) :]:
                option = re.match(r"^--[a-z][a-z-]*", word)
                told = option and re.escape(option.group(0)) + r"(?![a-z-])"
                if option and not re.search(told, texts[command]):
                    where = " ".join(["luxodus", *command])
                    problems.append(f"{path}:{number}: '{where}' has no {option.group(0)}")
    if calls < 20:
        problems.append(f"the documents seem to hold {calls} calls of luxodus only")
    return problems


class Page(html.parser.HTMLParser):
    """Names and links of a page, and the files that a browser loads for it."""

    LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "object": "data"}

    def __init__(self, text):
        super().__init__()
        self.names, self.links, self.loaded = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        for key in ("id", "name"):
            if values.get(key):
                self.names.add(values[key])
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag == "link" and values.get("rel") not in ("canonical", "next", "prev"):
            self.loaded.append(values.get("href", ""))
        if values.get(self.LOADED.get(tag)):
            self.loaded.append(values[self.LOADED[tag]])


def check_site(folder, program):
    environment = dict(os.environ, PYTHONDONTWRITEBYTECODE="1")
    if program:
        environment["LUXODUS"] = program
    done = subprocess.run(
        ["mkdocs", "build", "--strict", "--site-dir", folder],
        cwd=ROOT, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        return ["mkdocs build --strict fails:\n" + done.stdout + done.stderr]
    pages = {}
    for top, _, files in os.walk(folder):
        for name in files:
            if name.endswith(".html") and name != "404.html":
                path = os.path.join(top, name)
                with open(path, encoding="utf-8") as file:
                    pages[path] = Page(file.read())
    problems = [] if len(pages) > 50 else [f"the site has {len(pages)} pages only"]
    for path, page in pages.items():
        where = os.path.relpath(path, folder)
        for link in page.loaded + page.links:
            if re.match(r"^([a-z]+:|//)", link):
                if link in page.loaded and not link.startswith("data:"):
                    problems.append(f"{where} loads {link}, which is not of this site")
                continue
            file, _, anchor = urllib.parse.unquote(link.split("?")[0]).partition("#")
            there = os.path.normpath(os.path.join(os.path.dirname(path), file)) if file else path
            there = os.path.join(there, "index.html") if os.path.isdir(there) else there
            if not os.path.exists(there):
                problems.append(f"{where}: {link} leads nowhere")
            elif anchor and there in pages and anchor not in pages[there].names:
                problems.append(f"{where}: {link} names no heading")
    styles = os.path.join(folder, "assets", "stylesheets")
    for name in os.listdir(styles):
        if name.endswith(".css"):
            with open(os.path.join(styles, name), encoding="utf-8") as file:
                if re.search(r"(url\(|@import )[\"']?(https?:)?//", file.read()):
                    problems.append(f"assets/stylesheets/{name} loads from elsewhere")
    if program:
        with open(os.path.join(folder, "reference/command-line.html"), encoding="utf-8") as file:
            shown = html.unescape(re.sub(r"<[^>]*>", "", file.read()))
        for words, text in site_hooks.all_commands(program):
            if text.rstrip() not in shown:
                missing = " ".join(["luxodus", *words])
                problems.append(f"reference/command-line.html lacks what '{missing} --help' prints")
    return problems


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program")
    parser.add_argument("--site")
    options = parser.parse_args()
    if options.program and not os.access(options.program, os.X_OK):
        print(f"{options.program} is not built")
        return 1
    if options.site:
        if not shutil.which("mkdocs"):
            print("skipped: mkdocs is not installed (Debian: mkdocs mkdocs-material)")
            return SKIPPED
        problems = check_site(os.path.abspath(options.site), options.program)
    else:
        problems = check_links() + check_named_files() + check_named_tests()
        if options.program:
            problems += check_commands(options.program)
    for problem in problems:
        print(problem)
    print(f"{len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
