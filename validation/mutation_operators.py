"""Faults by machine: one operator, sign, constant or term of a kernel's line changed, drawn by a seed.

`drawn(source, modules, count, seed)` gives as many faults as `mutations.py` plants, each in one line of the sources of `modules`; comments,
text, preprocessor lines, checks of contracts and messages are left alone. What is drawn hangs on a change's own text, so that a line
written, moved or taken out elsewhere leaves the rest of a sample as it was.

A fault that does not compile says nothing. One that is drawn and stands in `EQUIVALENT` is not tried but counted by itself, with its reason, of
which there are three kinds:
- nothing changes: the line does the same for every input that can reach it (an allocation's size, a bound that something else keeps),
- round-off: results change by no more than rounding does, since the line chooses between two right ways (a pivot, an order of sums),
- cost: an iteration whose end another criterion decides converges later or sooner, at the same answer within its tolerance. A constant whose
  change moves answers beyond that, lets a case fail or makes an outcome say something else is no such constant, however heuristic.
"""

import hashlib
import os
import re

# What each operator does: (name, pattern, replacement of the match). Blanks around binary operators are clang-format's.
COMPARISONS = {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "=="}
LITERAL = re.compile(r"(?<![\w.])(\d+\.\d*|\d+)(e[-+]?\d+)?(?![\w.])")

SKIP = re.compile(r"^\s*(//|#|\*|using |namespace |static_assert|template|HERSEY_|case |extern)|HERSEY_(REQUIRE|ENSURE|ASSERT)|"
                  r"\b(require|ensure|throw|fmt::|InputError|std::string|reserve|for \(|array<|Matrix<|Eigen::Ref|constexpr int)\b")

# Changes that are no faults: (file, part of the line, part of the changed line, empty where any change of it): kind and reason.
EQUIVALENT = {
    ("film/src/balance/flow_balance.cpp", "has_tension() || !is_on_prescribed_edge(node)) return outflow(node);", "has_tension() && "):
        "nothing changes: nodes that are on no prescribed edge have, under laws with tension, neither u on an edge nor an outflow of their row; laws "
        "without it no p < 0",
    ("solver/src/symmetric_factor.cpp", "icntl(7) = 5;", ""): "cost: the ordering of a factor, whose answers do not depend on it",
    ("solver/src/kinematics.cpp", "Index worst = 0;", ""): "nothing changes: where the largest stands is written there in any case",
    ("solver/src/equilibrium.cpp", "|| mu_ > 1e30) {", "(1.5 * 1e30)"): "cost: a search that grows tenfold without success ends one step later",
    ("mbd/src/elastic/nodal_factors.cpp", "if (!archive.restores() || K_.rows() > 0) return;", "() && "):
        "cost: factors of a state that is saved are made anew, or dropped until they are asked for, from the same matrices",
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
        before = unique_context(lines, k)
        head = "".join(lines[k - (before or 0):k])
        for operator, changed in changes(line):
            if before is not None:
                yield file, k + 1, operator, head + line, head + changed


def why_equivalent(file, line, changed):
    """The reason for which a change of a line is no fault, or nothing."""
    for (other, part, new), reason in EQUIVALENT.items():
        if file == other and part in line and new in changed:
            return reason
    return ""


def drawn(source, modules, count, seed):
    """`count` changes of each module, each operator as often as it can be: (name, file, old, new, why it is no fault or nothing)."""
    faults = []
    for module in modules:
        by_operator = {}
        for candidate in candidates(source, module):
            by_operator.setdefault(candidate[2], []).append(candidate)
        for pool in by_operator.values():
            pool.sort(key=lambda candidate: lot(seed, candidate), reverse=True)
        order = sorted(by_operator)
        for k in range(count):
            pool = by_operator[order[k % len(order)]]
            if pool:
                file, line, operator, old, new = pool.pop()
                name = f"{module}: {operator}, {os.path.basename(file)}:{line}"
                faults.append((name, file, old, new, why_equivalent(file, last_line(old), last_line(new))))
    return faults


def last_line(text):
    return text.splitlines()[-1].strip()


def lot(seed, candidate):
    """Where a candidate stands in the order of a seed, by its own text alone."""
    file, _, _, old, new = candidate
    return hashlib.sha256("\n".join((str(seed), file, last_line(old), last_line(new))).encode()).hexdigest()
