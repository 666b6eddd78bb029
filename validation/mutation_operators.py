"""Faults by machine: one operator, sign, constant or term of a kernel's line changed, drawn by a seed.

`drawn(source, modules, count, seed)` gives as many faults as `mutations.py` plants, each in one line of the sources of `modules`; comments,
text, preprocessor lines, checks of contracts and messages are left alone. A fault that does not compile says nothing, one whose line
makes no difference that could be seen (the bound of an iteration, the start of a search) may survive with a reason: `EQUIVALENT`.
"""

import os
import random
import re

# What each operator does: (name, pattern, replacement of the match). Blanks around binary operators are clang-format's.
COMPARISONS = {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "=="}
LITERAL = re.compile(r"(?<![\w.])(\d+\.\d*|\d+)(e[-+]?\d+)?(?![\w.])")

SKIP = re.compile(r"^\s*(//|#|\*|using |namespace |static_assert|template|HERSEY_|case |extern)|HERSEY_(REQUIRE|ENSURE|ASSERT)|"
                  r"\b(require|ensure|throw|fmt::|InputError|std::string|reserve|for \(|array<|Matrix<|Eigen::Ref|constexpr int)\b")

# Lines in which a change is no fault: a trial's start, the bound of an iteration. (file, part of the line): reason.
EQUIVALENT = {
    ("solver/src/symmetric_factor.cpp", "icntl(7) = 5;"): "the ordering of a factor: its answers do not depend on it",
}


def without_text(line):
    """The line with comments and text between quotes blanked out, as long as before."""
    line = re.sub(r'"(\\.|[^"\\])*"', lambda m: '"' + " " * (len(m[0]) - 2) + '"', line)
    return re.sub(r"//.*", lambda m: " " * len(m[0]), line)


def ends_of_term(line, start):
    """Where a summand that begins at `start` ends, or None where it does not on this line."""
    depth = 0
    for k in range(start, len(line)):
        c = line[k]
        if c in "([{":
            depth += 1
        elif c in ")]}":
            if depth == 0:
                return k
            depth -= 1
        elif depth == 0 and (c in ",;?" or line.startswith((" + ", " - ", " < ", " > ", " && ", " || ", " : "), k)):
            return k
    return None


def changes(line):
    """(operator, changed line) for every way in which this line can be changed."""
    code = without_text(line)
    for match in re.finditer(r" (<=|>=|==|!=|<|>) ", code):
        yield "comparison", line[:match.start(1)] + COMPARISONS[match[1]] + line[match.end(1):]
    for match in re.finditer(r"(?<=[\w)\]]) ([+-])=? ", code):
        sign = "-" if match[1] == "+" else "+"
        yield "sign", line[:match.start(1)] + sign + line[match.end(1):]
        end = ends_of_term(code, match.end())
        if code[match.end(1)] == " " and end is not None:
            yield "dropped term", line[:match.start()] + line[end:]
    for match in re.finditer(r"(?<=[=(,?:] )-(?=[\w(])|(?<=\()-(?=[\w(])|(?<=return )-(?=[\w(])", code):
        yield "sign", line[:match.start()] + line[match.end():]
    for match in LITERAL.finditer(code):
        if code[match.end():match.end() + 1] in (">", "]") or code[match.start() - 1:match.start()] in ("<", "["):
            continue  # a size or an index
        value = match[0]
        changed = "1" if value == "0" else "0" if value == "1" else f"(1.5 * {value})" if "." in value or "e" in value else str(int(value) + 1)
        yield "constant", line[:match.start()] + changed + line[match.end():]
    for match in re.finditer(r"std::(min|max)(?=[(<])", code):
        yield "bound", line[:match.start(1)] + {"min": "max", "max": "min"}[match[1]] + line[match.end(1):]
    for match in re.finditer(r" (&&|\|\|) ", code):
        yield "connective", line[:match.start(1)] + {"&&": "||", "||": "&&"}[match[1]] + line[match.end(1):]


def unique_context(lines, k):
    """How many lines before line k are needed for text that occurs once in the file."""
    text = "".join(lines)
    for before in range(0, k + 1):
        if text.count("".join(lines[k - before:k + 1])) == 1:
            return before
    return None


def candidates(source, module):
    """(file below libs/, operator, old text, new text) of all changes of a module's sources."""
    for place, _, names in sorted(os.walk(os.path.join(source, "libs", module, "src"))):
        for name in sorted(names):
            path = os.path.join(place, name)
            with open(path, encoding="utf-8") as handle:
                lines = handle.readlines()
            yield from of_file(os.path.relpath(path, os.path.join(source, "libs")), lines)


def of_file(file, lines):
    for k, line in enumerate(lines):
        if SKIP.search(line) or not re.search(r"[;{,)&|+\-*/]\s*(//.*)?$", line):
            continue
        if any(file == other and part in line for other, part in EQUIVALENT):
            continue
        before = unique_context(lines, k)
        head = "".join(lines[k - (before or 0):k])
        for operator, changed in changes(line):
            if before is not None:
                yield file, k + 1, operator, head + line, head + changed


def drawn(source, modules, count, seed):
    """`count` changes of each module, each operator as often as it can be: (name, file, old, new)."""
    faults = []
    for module in modules:
        by_operator = {}
        for candidate in candidates(source, module):
            by_operator.setdefault(candidate[2], []).append(candidate)
        rng = random.Random(f"{seed}/{module}")
        for pool in by_operator.values():
            rng.shuffle(pool)
        order = sorted(by_operator)
        for k in range(count):
            pool = by_operator[order[k % len(order)]]
            if pool:
                file, line, operator, old, new = pool.pop()
                faults.append((f"{module}: {operator}, {os.path.basename(file)}:{line}", file, old, new))
    return faults
