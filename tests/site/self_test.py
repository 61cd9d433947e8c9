#!/usr/bin/env python3
"""check_site.py on a made site: a whole one passes, each fault is found: self_test.py CHECK_SITE.py"""
import os
import subprocess
import sys
import tempfile

MENU = '<nav class="md-nav--primary">' + "".join(f'<a href="{n}.html">{n}</a>' for n in "abcdefghijk") + "</nav>"


def fails(change):
    with tempfile.TemporaryDirectory() as folder:
        for sub in ("site", "docs"):
            os.mkdir(os.path.join(folder, sub))
        pages = {n: MENU + f'<h1 id="top">{n}</h1>' for n in "abcdefghijk"}
        pages["index"] = MENU
        change(pages)
        for name, text in pages.items():
            with open(os.path.join(folder, "site", name + ".html"), "w", encoding="utf-8") as file:
                file.write(text)
            if name != "index":
                open(os.path.join(folder, "docs", name + ".md"), "w", encoding="utf-8").close()
        return subprocess.run([sys.executable, sys.argv[1], folder + "/site", folder + "/docs"], capture_output=True).returncode != 0


def add(text):
    return lambda pages: pages.update(a=pages["a"] + text)


cases = [(False, add("")), (False, add('<a href="b.html#top">b</a><a href="https://example.org">e</a>')), (True, add('<a href="z.html">z</a>')),
         (True, add('<a href="b.html#low">b</a>')), (True, add('<img src="no.png">')),
         (True, add('<script src="https://example.org/x.js"></script>')), (True, lambda pages: pages.update(alone="<p>text</p>"))]
for number, (expected, change) in enumerate(cases):
    if fails(change) != expected:
        sys.exit(f"site: case {number} is {'not found' if expected else 'refused'}")
