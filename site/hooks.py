"""What the site needs beyond mkdocs (mkdocs.yml, `hooks`): Markdown as GitHub reads it, links to the source, an offline search."""
import json
import os
import posixpath
import re

LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)")
LIST_OR_TABLE = re.compile(r"(?:[-*] |\d+\. |\|)")


def outside_code(markdown, change):
    """Applies `change` to the lines that are in no fenced block."""
    out, fence = [], None
    for line in markdown.split("\n"):
        mark = re.match(r" *(```+|~~~+)", line)
        if mark and (fence is None or mark.group(1).startswith(fence)):
            fence = mark.group(1) if fence is None else None
            out.append(line)
            continue
        out.append(line if fence else change(line, out))
    return "\n".join(out)


def with_blank_line(line, before):
    """GitHub lets a list or a table follow a paragraph at once, Python-Markdown wants an empty line between them."""
    starts = LIST_OR_TABLE.match(line)
    previous = before[-1] if before else ""
    if starts and previous.strip() and not LIST_OR_TABLE.match(previous) and not previous.startswith((" ", "#", "<!--")):
        before.append("")
    return line


def on_page_markdown(markdown, page, config, files):
    folder = posixpath.dirname(page.file.src_path)
    folders = {posixpath.dirname(file.src_path) for file in files}

    def link(match):
        text, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        path = posixpath.normpath(posixpath.join(folder, target.split("#")[0]))
        if path.startswith("../"):  # a file of the source, which the site does not hold
            return f'<span title="{path[3:]} in the source">{text}</span>'
        if path in folders:
            first = min(f.src_path for f in files if posixpath.dirname(f.src_path) == path)
            return f"[{text}]({posixpath.relpath(first, folder or '.')})"
        return match.group(0)

    def change(line, before):
        return with_blank_line(LINK.sub(link, line), before)

    return outside_code(markdown, change)


def on_post_build(config):
    """A page that is opened from a disk can load scripts and nothing else, so the search's index is a script as well."""
    search = os.path.join(config["site_dir"], "search")
    with open(os.path.join(search, "search_index.json"), encoding="utf-8") as file:
        index = json.load(file)
    with open(os.path.join(search, "search_index.js"), "w", encoding="utf-8") as file:
        file.write("var __search = {index: Promise.resolve(" + json.dumps(index, ensure_ascii=False) + ")};\n")
