"""Formulas within sentences of the theory manual: which words of a sentence are one."""

import re

import notation

# What is left alone: code, links, headings, rows of tables, HTML, emphasis that opens a paragraph.
KEPT = re.compile(r"(`[^`]*`|\[[^\]]*\]\([^)]*\)|^#.*$|^\|.*$|<[^>\n]+>|\ue000\d+\ue001|https?://\S+|\([a-z-]+\.\d+\))", re.MULTILINE)
WORD = re.compile(r"\S+")
NAME = r"(?:[A-Za-z]\d?|d(?:[A-Za-z]|GREEK)|(?:GREEK)\d?|[a-zA-Z](?:dot|ddot)|(?:GREEK)d?dot)".replace("GREEK", "|".join(notation.GREEK))
INDEXED = rf"{NAME}(?:~|'+|\*)?(?:_(?:\w+(?:,\w+)?|\([^)]*\)|\{{[^}}]*\}}))?(?:\^(?:-?\w+|\([^)]*\)))?(?:'+|\*)?"
SYMBOL = re.compile(rf"-?{INDEXED}(?:\([^()\s]*\))?")
RATIO = re.compile(rf"-?(?:{INDEXED}|\d[\d.]*|\([^()]*\)|\|[^|]*\|)(?:(?:/|\+|-(?=\w))(?:{INDEXED}|\d[\d.]*|\([^()]*\)))+")
NUMBER = re.compile(r"-?\d[\d.]*(?:e-?\d+)?")
RELATION = {"=", "<=", ">=", "<", ">", "->"}
JOINING = RELATION | {"+", "-", "."}
# Words that are a formula on their own; single letters that are also words of English need company.
ENGLISH = {"a", "A", "I", "do", "de", "d", "nu", "so", "x"}


def kind(word):
    """How one word stands in a formula: symbol, number, joint (an operator), or none of them."""
    if word in JOINING:
        return "joint"
    if word in ENGLISH:
        return "weak"
    if SYMBOL.fullmatch(word) or RATIO.fullmatch(word):
        return "symbol" if re.search(r"[A-Za-z]", word) else "weak"
    if NUMBER.fullmatch(word):
        return "number"
    return "symbol" if is_bracketed(word) else None


def is_bracketed(word):
    """Whether a word is brackets around nothing but formulas, with what stands before and behind: `c^3/(12 mu0)`."""
    if not re.search(r"[(\[{]", word) or not re.search(r"[A-Za-z]", word):
        return False
    inner = re.sub(r"[()\[\]{}/^|,;]+", " ", word).split()
    return bool(inner) and all(kind(part) or part in notation.FUNCTIONS | notation.NAMED | {"sqrt", "...", "~", "'", "_", "..", "x"}
                               or re.fullmatch(r"[a-z]+_\w+", part) for part in inner) and any(kind(part) == "symbol" for part in inner)


def words(text):
    """(start, end) of each word; brackets that hold blanks and nothing but formulas make one word."""
    at = 0
    while match := WORD.search(text, at):
        end = match.end()
        if is_open(match.group()):
            further, close = end, None
            while further < min(len(text), end + 90) and close is None:
                following = WORD.search(text, further)
                if following is None or "\n\n" in text[further:following.start()]:
                    break
                further = following.end()
                if not is_open(text[match.start():further]):
                    close = further
            if close and is_bracketed(bare_word(text[match.start():close])[0]):
                end = close
        yield match.start(), end
        at = end


def is_open(text):
    return sum(text.count(c) for c in "([{") > sum(text.count(c) for c in ")]}")


def bare_word(word):
    """The word without the punctuation behind it, and that."""
    match = re.fullmatch(r"(.*?)([.,:;]*)", word, re.DOTALL)
    return match[1], match[2]


def formulas(text):
    """(start, end) of each formula: symbols, alone or joined by operators; it ends where punctuation follows."""
    run, found = [], []

    def close():
        while run and run[-1][2] in ("joint", "number") and not (run[-1][2] == "number" and len(run) > 1 and run[-2][2] == "joint"):
            run.pop()
        while run and run[0][2] in ("joint",):
            run.pop(0)
        if run and any(k == "symbol" for _, _, k in run):
            found.append((run[0][0], run[-1][1]))
        run.clear()

    for start, end in words(text):
        whole = text[start:end]
        if is_open(whole):  # "(z along the axis"
            start += len(whole) - len(whole.lstrip("([{"))
            whole = text[start:end]
        word, stop = bare_word(whole) if whole not in JOINING else (whole, "")
        sort = kind(word)
        if sort == "weak" and not stop and next_word(text, end) in RELATION or word in notation.FUNCTIONS and next_is_symbol(text, end):
            sort = "symbol"
        joined = bool(run) and run[-1][2] == "joint"
        if sort == "joint" and not run or sort in ("number", "weak") and not joined:
            close()
            sort = None
        if sort == "symbol" and run and not joined and not multiplies(run, text):
            close()
        if run and (sort is None or "\n\n" in text[run[-1][1]:start]):
            close()
        if sort is None:
            continue
        run.append((start, start + len(word), sort))
        if stop:
            close()
    close()
    return found


def next_word(text, at):
    match = WORD.search(text, at)
    return match.group() if match else ""


def next_is_symbol(text, at):
    return kind(bare_word(next_word(text, at))[0]) == "symbol"


def multiplies(run, text):
    """Whether a symbol right behind another one is its factor: only within an equation that has begun."""
    return any(text[start:end] in RELATION | {"+"} for start, end, k in run if k == "joint") or text[slice(*run[-1][:2])] in notation.FUNCTIONS


def replace(text, typeset):
    """The text with each formula replaced by what `typeset` makes of it."""
    out = ""
    for part in KEPT.split(text):
        if KEPT.fullmatch(part or ""):
            out += part
            continue
        at = 0
        for start, end in formulas(part):
            out += part[at:start] + typeset(part[start:end])
            at = end
        out += part[at:]
    return out
