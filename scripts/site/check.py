#!/usr/bin/python3
"""check.py SITE   the built site: every link leads somewhere, every page is reached by links from the start, no equation is plain
text, and nothing is fetched from elsewhere."""

import html.parser
import os
import re
import sys
import urllib.parse

SITE = os.path.abspath(sys.argv[1])
# Blocks of code that look like an equation: a relation or a fraction between symbols, and the number of an equation behind it.
NUMBERED = re.compile(r"\S\s{2,}\([\w-]+\.\d+\)")


class Reader(html.parser.HTMLParser):
    """Links, anchors, what is loaded, and the text of code blocks of one page."""

    def __init__(self):
        super().__init__()
        self.links, self.anchors, self.loaded, self.blocks, self.equations = [], set(), [], [], 0
        self.inside = 0

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors |= {values[name] for name in ("id", "name") if values.get(name)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag in ("img", "script") and values.get("src"):
            self.loaded.append(values["src"])
        if tag == "link" and values.get("rel") in ("stylesheet", "icon", "preconnect") and values.get("href"):
            self.loaded.append(values["href"])
        if tag == "pre":
            self.inside += 1
            self.blocks.append("")
        self.equations += "katex" in (values.get("class") or "").split()

    def handle_endtag(self, tag):
        self.inside -= tag == "pre"

    def handle_data(self, data):
        if self.inside:
            self.blocks[-1] += data


def read_site():
    pages = {}
    for folder, _, names in os.walk(SITE):
        for name in names:
            if name.endswith(".html"):
                path = os.path.join(folder, name)
                pages[path] = Reader()
                with open(path, encoding="utf-8") as file:
                    pages[path].feed(file.read())
    return pages


def target(page, link):
    """(file, anchor) that a link of a page leads to; None for another site."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = os.path.normpath(os.path.join(os.path.dirname(page), urllib.parse.unquote(parts.path))) if parts.path else page
    return os.path.join(path, "index.html") if os.path.isdir(path) else path, parts.fragment


def check_links(pages, faults):
    for page, found in pages.items():
        if os.path.basename(page) == "404.html":
            continue
        for link in found.links + found.loaded:
            led = target(page, link)
            if led is None:
                continue
            file, anchor = led
            if not os.path.exists(file):
                faults.append(f"{shown(page)} links to {link}, which does not exist")
            elif anchor and file in pages and urllib.parse.unquote(anchor) not in pages[file].anchors | {"__skip"}:
                faults.append(f"{shown(page)} links to {link}: {shown(file)} has no such place")


def check_reach(pages, faults):
    start = os.path.join(SITE, "index.html")
    reached, todo = {start}, [start]
    while todo:
        page = todo.pop()
        for link in pages[page].links:
            led = target(page, link)
            if led and led[0] in pages and led[0] not in reached:
                reached.add(led[0])
                todo.append(led[0])
    faults += [f"no link leads to {shown(page)}" for page in pages if page not in reached and os.path.basename(page) != "404.html"]


def check_equations(pages, faults):
    for page, found in pages.items():
        for block in found.blocks:
            if NUMBERED.search(block) or os.sep + "theory" + os.sep in page and re.search(r"^\s*\S+ = ", block) and "$" not in block:
                faults.append(f"{shown(page)} shows an equation as plain text: {block.strip().splitlines()[0]}")
        if os.sep + "theory" + os.sep in page and not found.equations:
            faults.append(f"{shown(page)} has no equation that is typeset")


def shown(path):
    return os.path.relpath(path, SITE)


def main():
    pages, faults = read_site(), []
    check_links(pages, faults)
    check_reach(pages, faults)
    check_equations(pages, faults)
    faults += [f"{shown(page)} loads {what} from elsewhere" for page, found in pages.items() for what in found.loaded
               if re.match(r"(https?:)?//", what)]
    if faults:
        sys.exit("\n".join(faults))
    print(f"{len(pages)} pages, {sum(page.equations for page in pages.values())} equations")


if __name__ == "__main__":
    main()
