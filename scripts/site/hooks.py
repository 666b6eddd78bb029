"""What mkdocs does besides turning Markdown into pages: equations in plain notation become typeset ones.

On pages of the theory manual every indented block is an equation, as are the formulas within sentences; elsewhere a block is one
where a line ends with an equation's number. Where the plain notation is a drawing (a matrix over several lines), a comment before
the block holds its LaTeX: `<!-- latex: ... -->`."""

import json
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import inline  # noqa: E402
import notation  # noqa: E402

MODULES = os.environ.get("HERSEY_SITE_MODULES", os.path.join(HERE, "../../build/site"))
BLOCK = re.compile(r"(?:^<!-- latex: (?P<latex>[^>]*?) -->\n\n?)?(?P<block>(?:^    .*\S.*\n(?:[ \t]*\n(?=    \S))?)+)", re.MULTILINE)
FENCE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
ENDING = re.compile(r"(?<=\S) {2,}\(([\w-]+\.\d+)\)$", re.MULTILINE)
TITLED = re.compile(r"^(\*\*[^*\n]+\*\*) \(([\w-]+\.\d+)\)", re.MULTILINE)
REFERENCE = re.compile(r"(?<![\w`\]>])\(((?:film-surface|flexible-bodies|film|bearing|contact|beams|elastic|integrator|mechanisms|thermal)\.\d+)\)")


class Page:
    """One page's equations: places are kept while Markdown is made into HTML, and filled afterwards."""

    def __init__(self):
        self.wanted = []

    def place(self, tex, display):
        self.wanted.append({"tex": tex, "display": display})
        return f"\ue000{len(self.wanted) - 1}\ue001"

    def display(self, match):
        """The rows of one block, each with its number as anchor."""
        rows = [(match["latex"], None)] if match["latex"] else list(notation.lines_of(match["block"]))
        if match["latex"]:
            numbers = [number for _, number in notation.lines_of(match["block"]) if number]
            rows = [(match["latex"], numbers[-1] if numbers else None)]
        out = "".join(f'<div class="equation"{f" id={json.dumps(number)}" if number else ""} tabindex="0">{self.place(tex, True)}'
                      f'{f"<span class=number>({number})</span>" if number else ""}</div>' for tex, number in rows)
        return f'\n<div class="equations">{out}</div>\n\n'


def is_equation(page, match):
    return page.startswith("theory/") or any(notation.NUMBER.match(line) for line in match["block"].splitlines())


def outside_fences(text, change):
    return "".join(part if part.startswith("```") else change(part) for part in FENCE.split(text))


pages = {}


def on_page_markdown(markdown, page, **_):
    work = pages[page.file.src_path] = Page()
    source = page.file.src_path

    def change(text):
        text = BLOCK.sub(lambda m: work.display(m) if is_equation(source, m) else m.group(), text)
        if source.startswith("theory/"):
            text = inline.replace(text, lambda plain: work.place(notation.convert(plain), False))
        return text

    text = outside_fences(markdown, change)
    prefix = "" if source.startswith("theory/") else "theory/"
    text = ENDING.sub(r' <span class="number" id="\1">(\1)</span>', text)
    text = TITLED.sub(r'\1 <span class="number" id="\2">(\2)</span>', text)
    return REFERENCE.sub(lambda m: f"[({m[1]})]({link(m[1], source)})" if link(m[1], source) else m[0], text) if prefix == "" else text


def on_post_page(output, page, **_):
    """Scripts of our own: the search of a site that is opened from a folder (before the theme's), and reading by keyboard."""
    base = os.path.relpath(".", os.path.dirname(page.file.dest_path) or ".")
    return output.replace("</head>", f'<script src="{base}/local_search.js" data-base="{base}"></script>'
                          f'<script src="{base}/reading.js"></script></head>', 1)


CHAPTER_PAGES = {"elastic": "elastic-bodies"}


def link(number, source):
    chapter = number.rsplit(".", 1)[0]
    page = f"{CHAPTER_PAGES.get(chapter, chapter)}.md"
    return f"{'' if source == 'theory/' + page else page}#{number}"


def on_page_content(html_text, page, **_):
    work = pages.pop(page.file.src_path)
    if not work.wanted:
        return html_text
    run = subprocess.run(["node", os.path.join(HERE, "render.mjs"), MODULES], input=json.dumps(work.wanted), text=True,
                         capture_output=True, check=False)
    if run.returncode != 0:
        raise SystemExit(f"{page.file.src_path}: {run.stderr}")
    rendered = json.loads(run.stdout)
    return re.sub("\ue000(\\d+)\ue001", lambda m: rendered[int(m[1])], html_text)
