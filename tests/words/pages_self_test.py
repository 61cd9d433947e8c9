#!/usr/bin/env python3
"""`scripts/words --pages` on made pages: what counts as prose, and what is too long: pages_self_test.py scripts/words"""
import os
import subprocess
import sys
import tempfile

F = "```"


def words(number):
    """A text of so many words, in sentences of ten."""
    return "".join("word" + (".\n" if i % 10 == 9 else " ") for i in range(number))


def long_sentence(number, end="."):
    return " ".join(["word"] * number) + end + "\n"


# What the page has in it, and how many faults it must have.
cases = [
    ("1200 words", words(1200), 0),
    ("1201 words", words(1201), 1),
    ("a heading counts", "# One two\n\n" + words(1199), 1),
    ("code in a line counts as its words", words(1198) + "`one two three`.\n", 1),
    ("a block of code does not", words(1200) + f"\n{F}\n{words(50)}{F}\n", 0),
    ("an indented block does not", words(1200) + "\n    one two\n\n    three\n\nNo.\n", 1),
    ("a table does not", words(1200) + "\n| one two | three |\n|---|---|\n| four | five six |\n", 0),
    ("front matter and comments do not", "---\ntitle: one two\n---\n" + words(1200) + "<!-- one\ntwo -->\n", 0),
    ("the address of a link does not", words(1199) + "[one](a.md#two).\n", 0),
    ("marks of lists do not", "- " + words(1200), 0),
    ("an item's second paragraph counts", "- one\n\n    " + words(1200).replace("\n", " ") + "\n", 1),
    ("a sentence of 35 words", long_sentence(35), 0),
    ("a sentence of 36 words", long_sentence(36), 1),
    ("a colon ends a sentence", long_sentence(30, ":") + long_sentence(30), 0),
    ("so does a question", long_sentence(30, "?") + long_sentence(30), 0),
    ("so does an item", f"- {long_sentence(30, ';')}- {long_sentence(30, '')}", 0),
    ("a comma does not", long_sentence(30, ",") + long_sentence(30), 1),
    ("code in a sentence is one word", long_sentence(30, " `" + "a " * 20 + "b`."), 0),
    ("a table has no sentences", "| a |\n|---|\n| " + long_sentence(60).strip() + " |\n", 0),
]
failed = False
with tempfile.TemporaryDirectory() as folder:
    name = os.path.join(folder, "page.md")
    for what, text, expected in cases:
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)
        run = subprocess.run([sys.executable, sys.argv[1], "--pages", name], capture_output=True, text=True)
        faults = run.stdout.count("page.md:")
        if faults != expected or run.returncode != (1 if expected else 0):
            failed = True
            print(f"words: {what}: {faults} faults, not {expected}, code {run.returncode}\n{run.stdout}{run.stderr}", file=sys.stderr)
sys.exit(1 if failed else 0)
