"""The plain notation of the theory manual, `q = -h^3/(12 mu) dp/dx`, in LaTeX.

The manual writes equations as the code names their symbols (docs/notation.md), so that both can be searched alike; the site
shows them typeset. Words stay words. What a line may hold: sums over something (`sum over i of`), integrals, fractions by `/`,
`_` and `^` with one name, a number or brackets, `x` between two operands for the cross product, ` . ` for the scalar product,
`dot` and `ddot` and `~` behind a name, and the signs <=, >=, ->, <-, .., (x), (+).
"""

import re

GREEK = ("alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi pi rho sigma tau phi chi psi omega "
         "Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega").split()
FUNCTIONS = {"sin", "cos", "tan", "cot", "exp", "ln", "log", "max", "min", "det", "tanh"}
NAMED = {"tr", "diag", "atan2", "sym", "grad", "Ad", "log2", "log10"}
SIGNS = {"<=": r"\le", ">=": r"\ge", "->": r"\to", "<-": r"\leftarrow", "...": r"\dots", "..": r"\dots", "(x)": r"\otimes",
         "(+)": r"\oplus", "+=": r"\mathrel{+}=", "%": r"\%", "&": r"\&", "#": r"\#"}
TOKEN = re.compile(r"""(?P<space>\s+)
 |(?P<unit>(?<=\d)\ (?:rad/s|MPa|GPa|Pa\ s|1/Pa|Pa|mm/s|K)(?![\w^/]))
 |(?P<reference>\([a-z-]+\.\d+(?:\ to\ [a-z-]+\.\d+)?\))
 |(?P<tensor>\(x\)|\(\+\))
 |(?P<number>\d+(?:\.\d+)?(?:e-?\d+)?(?![A-Za-z]))
 |(?P<name>[A-Za-z]+[0-9]*)
 |(?P<sign><=|>=|->|<-|\+=|\.\.\.|\.\.|.)""", re.VERBOSE)
CLOSING = {"(": ")", "[": "]", "{": "}"}


def greek(word):
    return {"epsilon": r"\varepsilon", "phi": r"\varphi"}.get(word, "\\" + word)


def name_tex(word):
    """LaTeX of a name without sub- and superscripts; None for a word of English."""
    if word in GREEK:
        return greek(word)
    if len(word) == 1:
        return word
    if word == "inf":
        return r"\infty"
    if word in FUNCTIONS:
        return "\\" + word
    if word in NAMED:
        return rf"\operatorname{{{word}}}" if word not in ("log2", "log10") else rf"\log_{{{word[3:]}}}"
    for ending, accent in (("ddot", "ddot"), ("dot", "dot"), ("bar", "bar")):
        inner = name_tex(word[: -len(ending)]) if word.endswith(ending) and len(word) > len(ending) else None
        if inner and not inner.startswith("\\text"):
            return rf"\{accent}{{{inner}}}"
    digits = re.fullmatch(r"([A-Za-z]|[a-zA-Z]{2,}?)(\d+)", word)
    if digits:
        inner = name_tex(digits.group(1))
        return f"{{{inner}_{{{digits.group(2)}}}}}" if inner else None
    if word[0] == "d" and len(word) > 1:
        inner = name_tex(word[1:]) if len(word) == 2 or word[1:] in GREEK or word.endswith("dot") else None
        return rf"\mathrm{{d}}{inner}" if inner else None
    return None


def script_tex(text):
    """What stands below or above: indices as they are, words upright."""
    parts = re.split(r"([^A-Za-z]+)", text)
    out = ""
    for part in parts:
        if not part:
            continue
        if part.isalpha():
            known = greek(part) if part in GREEK else r"\infty" if part == "inf" else None
            out += known + " " if known else part if len(part) <= 2 else rf"\mathrm{{{part}}}"
        else:
            out += {"_": r"\,", "<=": r"\le "}.get(part, part)
    return out


class Reader:
    """One line of plain notation, read from left to right into factors."""

    def __init__(self, text):
        text = re.sub(r"_([nkl])([+-]1)(?!\d)", r"_(\1\2)", text)
        text = re.sub(r"_(-1)(?=[/)])", r"_(\1)", text)
        text = re.sub(r"\bd2Phi/dt2", "d^2 Phi/dt^2", text)
        self.tokens = [(m.lastgroup, m.group()) for m in TOKEN.finditer(text)]
        self.at = 0

    def peek(self, ahead=0):
        index = self.at + ahead
        return self.tokens[index] if index < len(self.tokens) else ("end", "")

    def take(self):
        token = self.peek()
        self.at += 1
        return token

    def line(self, until=None):
        """LaTeX up to the closing bracket `until` or the end."""
        out = []  # entries (kind, latex): operand, sign, text
        while self.peek()[0] != "end":
            kind, text = self.peek()
            if until and text == until:
                break
            if kind == "space":
                self.take()
                if len(text) > 1 and out and self.peek()[0] != "end":
                    out.append(("sign", r"\quad" if len(text) < 6 or until else r"\qquad"))
            elif text == "/" and out and out[-1][0] == "operand":
                self.take()
                if self.peek()[0] == "space":
                    self.take()
                out[-1] = ("operand", rf"\frac{{{bare(out[-1][1])}}}{{{bare(self.factor())}}}")
            elif self.is_cross(out):
                self.take()
                starred = self.peek()[1] == "*"
                if starred:
                    self.take()
                out.append(("sign", r"\times^{*}" if starred else r"\times"))
            elif kind == "name" and text in ("sum", "int", "integral"):
                out.append(("sign", self.big(text)))
            elif self.is_word():
                out.append(("text", self.words()))
            elif kind in ("name", "number") or text in CLOSING or self.opens_bars(out):
                out.append(("operand", self.factor()))
            else:
                self.take()
                out.append(("sign" if kind != "unit" else "operand-unit", self.sign(kind, text)))
        return " ".join(entry for _, entry in out)

    def sign(self, kind, text):
        if kind == "unit":
            return rf"\,\text{{{text.strip()}}}"
        before, after = self.tokens[self.at - 2] if self.at > 1 else ("end", ""), self.peek()
        if kind == "reference":
            return rf"\text{{{text}}}"
        if text == "." and before[0] == "space" and after[0] == "space":
            return r"\cdot"
        if text == "*":
            return "^{*}"
        if text in "{}":
            return "\\" + text
        return SIGNS.get(text, text if text not in "~^_\\$" else "")

    def opens_bars(self, out):
        """Whether a | or < here begins |...| or <...>."""
        text = self.peek()[1]
        if text not in ("|", "<") or (out and out[-1][0] == "operand" and self.tokens[self.at - 1][0] != "space"):
            return False
        rest = "".join(t for _, t in self.tokens[self.at + 1:])
        return not rest.startswith(" ") and ("|" if text == "|" else ">") in rest

    def is_cross(self, out):
        if self.peek() != ("name", "x") or not out or out[-1][0] not in ("operand", "text"):
            return False
        after = self.peek(2 if self.peek(1)[1] == "*" else 1)
        beyond = self.peek(3 if self.peek(1)[1] == "*" else 2)
        before = self.tokens[self.at - 1]
        return (before[0] == "space" and after[0] == "space"
                and (beyond[0] in ("name", "number") or beyond[1] in ("(", "[")) and not self.english(beyond[1]))

    def english(self, word):
        return word.isalpha() and name_tex(word) is None and len(word) > 1

    def is_word(self):
        kind, text = self.peek()
        if kind != "name" or text == "sqrt":
            return False
        if text in ("a", "A") and self.peek(1) == ("space", " ") and self.peek(2)[0] == "name" and self.english(self.peek(2)[1]):
            return self.peek(2)[1] not in ("is", "and", "or", "for", "with", "on", "at")
        if name_tex(text) is not None:
            return False
        keyword = self.peek(1)[1] == "_" and len(text) > 3 and len(self.peek(2)[1]) > 3  # mass_conserving
        return keyword or self.peek(1)[1] not in ("_", "^")

    def words(self):
        """Words in a row, as text with the blanks around them."""
        found = []
        while self.is_word():
            found.append(self.take()[1])
            if self.peek()[1] == "_":
                self.take()
                found[-1] += r"\_" + self.take()[1]
            while self.peek()[1] in ("'", "-") and self.peek(1)[0] == "name" and self.peek(1)[1] not in GREEK:
                found[-1] += self.take()[1] + self.take()[1]
            if self.peek() == ("space", " ") and self.peek(1)[0] == "name":
                self.take()
        return rf"\text{{ {' '.join(found)} }}"

    def big(self, word):
        self.take()
        sign = r"\sum" if word == "sum" else r"\int"
        start = self.at
        if word == "sum" and [self.peek(k)[1] for k in range(3)] == [" ", "over", " "]:
            self.at += 3
            inner = []
            while self.peek()[0] != "end" and self.peek()[1] not in ("of", ")", "]", ",") and not (
                    self.peek()[0] == "space" and len(self.peek()[1]) > 1):
                inner.append(self.take()[1])
            if self.peek()[1] == "of":
                self.take()
                return rf"\sum_{{{convert(''.join(inner))}}}"
            self.at = start
        return sign + self.scripts()

    def factor(self):
        """A name, a number or brackets, with what is written below, above and behind it."""
        if self.peek()[1] == "-":
            self.take()
            return "-" + self.factor()
        kind, text = self.take()
        if kind == "number":
            base = re.sub(r"^1e(-?\d+)$", r"10^{\1}", text)
            base = re.sub(r"e(-?\d+)$", r" \\cdot 10^{\1}", base)
        elif kind == "name":
            base = name_tex(text) or rf"\mathrm{{{text}}}"
            if text in FUNCTIONS | NAMED:
                scripts = self.scripts()
                if self.peek()[1] in CLOSING:
                    return base + scripts + self.factor()
                if self.peek()[0] == "space" and self.peek(1)[1] == "|":
                    self.take()
                    return base + scripts + r"\," + self.factor()
                return base + scripts
            if text == "sqrt" and self.peek()[1] == "(":
                return rf"\sqrt{{{bare(self.factor())}}}" + self.scripts()
        elif text in CLOSING:
            inner = self.line(CLOSING[text])
            closed = self.peek()[1] == CLOSING[text]
            if closed:
                self.take()
            left, right = ("\\{", "\\}") if text == "{" else (text, CLOSING[text])
            base = rf"\left{left} {inner} \right{right if closed else '.'}"
        elif text in ("|", "<"):
            end = "|" if text == "|" else ">"
            inner = self.line(end)
            self.take()
            base = rf"\lvert {inner} \rvert" if text == "|" else rf"\langle {inner} \rangle"
        else:
            return self.sign(kind, text)
        if kind == "name" and self.peek()[1] == "'" and self.peek(1)[1] == "~":
            base += self.take()[1]
        if kind == "name" and self.peek()[1] == "~":
            self.take()
            base = rf"\tilde{{{base}}}"
        base += self.scripts()
        # f(x) without a blank is one factor: the argument belongs to the function.
        if kind == "name" and self.peek()[1] == "(" and not base.startswith(r"\mathrm{d}"):
            base += self.factor()
        return base

    def scripts(self):
        out, primes, below, above = "", "", "", ""
        while True:
            kind, text = self.peek()
            following = self.peek(1)
            if text == "'":
                primes += "'"
                self.take()
            elif text == "*" and following[0] in ("space", "end", "sign"):
                self.take()
                above += "*"
            elif text == "_" and (following[0] in ("name", "number") or following[1] in ("(", "{", "-")):
                self.take()
                below += ("," if below else "") + self.script(True)
            elif text == "^" and following[0] != "space":
                self.take()
                above += self.script(False)
            else:
                break
        if primes or above:
            out += f"^{{{primes.replace(chr(39), chr(92) + 'prime ')}{above}}}"
        return (f"_{{{below}}}" if below else "") + out

    def script(self, index):
        if self.peek()[1] in ("(", "{"):
            end = CLOSING[self.take()[1]]
            inner = self.line(end)
            self.take()
            return inner
        sign = ""
        if self.peek()[1] == "-":
            sign = self.take()[1]
        text = self.take()[1]
        if not index and self.peek()[1] == "_" and self.peek(1)[0] == "name":
            return sign + script_tex(text)
        if index:  # r_b,x and E_boundary_friction go on
            while self.peek()[1] in (",", "_") and self.peek(1)[0] == "name":
                text += self.take()[1] + self.take()[1]
        return sign + script_tex(text)


def bare(tex):
    """Without the brackets that a fraction or a root makes superfluous."""
    match = re.fullmatch(r"\\left\( (.*) \\right\)", tex, re.DOTALL)
    if not match:
        return tex
    depth = 0
    for word in re.findall(r"\\left|\\right", match.group(1)):
        depth += 1 if word == r"\left" else -1
        if depth < 0:
            return tex
    return match.group(1)


def convert(text):
    """LaTeX of one line of plain notation."""
    reader, out = Reader(text.strip()), ""
    while reader.peek()[0] != "end":
        out += reader.line()
        if reader.peek()[0] != "end":
            out += reader.take()[1]
    return out


NUMBER = re.compile(r"^(?P<text>.*?\S)\s{2,}\((?P<number>[\w-]+\.\d+)\)(?P<stop>[,.:;]?)$")


def lines_of(block):
    """(LaTeX, number or None) of each line of a displayed equation."""
    for line in block.splitlines():
        if line.strip():
            match = NUMBER.match(line.rstrip())
            yield (convert(match["text"]), match["number"]) if match else (convert(line), None)
