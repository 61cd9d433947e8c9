#!/usr/bin/env python3
"""Whether a built site is whole: check_site.py SITE DOCS
 - every link, picture, script and style of a page is a file of the site, and its anchor exists there;
 - nothing is loaded from a network;
 - every page of DOCS is in the menu."""
import os
import sys
import urllib.parse
from html.parser import HTMLParser


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.anchors, self.links, self.loaded, self.menu = set(), [], [], set()
        self.depth_of_menu = 0

    def handle_starttag(self, tag, attributes):
        a = dict(attributes)
        self.anchors.update(a[k] for k in ("id", "name") if a.get(k))
        if tag == "nav" and "md-nav--primary" in (a.get("class") or ""):
            self.depth_of_menu = 1
        elif tag == "nav" and self.depth_of_menu:
            self.depth_of_menu += 1
        if tag == "a" and a.get("href"):
            self.links.append(a["href"])
            if self.depth_of_menu:
                self.menu.add(a["href"].split("#")[0])
        if tag in ("img", "script", "iframe") and a.get("src"):
            self.loaded.append(a["src"])
        if tag == "link" and a.get("href") and a.get("rel") != "canonical":
            self.loaded.append(a["href"])

    def handle_endtag(self, tag):
        if tag == "nav" and self.depth_of_menu:
            self.depth_of_menu -= 1


def main():
    site, docs = (os.path.abspath(p) for p in sys.argv[1:3])
    pages = {}
    for folder, _, names in os.walk(site):
        for name in names:
            if name.endswith(".html"):
                path = os.path.join(folder, name)
                pages[path] = Page()
                with open(path, encoding="utf-8") as file:
                    pages[path].feed(file.read())
    faults = set()
    for path, page in pages.items():
        name = os.path.relpath(path, site)
        if name == "404.html":  # its addresses are those of a server's root
            continue
        for target in page.loaded:
            if urllib.parse.urlparse(target).netloc:
                faults.add(f"{name}: loads {target}")
        for target in page.links + page.loaded:
            url = urllib.parse.urlparse(target)
            if url.scheme or url.netloc or target.startswith("data:"):
                continue
            to = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(url.path))) if url.path else path
            if os.path.isdir(to):
                to = os.path.join(to, "index.html")
            if not os.path.isfile(to):
                faults.add(f"{name}: no file {target}")
            elif url.fragment and to in pages and urllib.parse.unquote(url.fragment) not in pages[to].anchors:
                faults.add(f"{name}: no anchor {target}")
    menu = {os.path.normpath(link) for link in pages[os.path.join(site, "index.html")].menu}
    for folder, _, names in os.walk(docs):
        for name in names:
            if name.endswith(".md") and name != "README.md":
                page = os.path.relpath(os.path.join(folder, name), docs)[:-3] + ".html"
                if page not in menu:
                    faults.add(f"{page}: in no menu")
    for fault in sorted(faults):
        print("site:", fault, file=sys.stderr)
    return 1 if faults or len(pages) < 10 else 0


sys.exit(main())
