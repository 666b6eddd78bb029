"""Models as YAML text: nested dicts and lists of strings and numbers, lengths in mm, angles in deg and so on."""

import math
import re

_PLAIN = re.compile(r"-?[A-Za-z0-9_.][A-Za-z0-9_.+/^ -]*")


def number(value):
    """A number with all its digits: what the checks compute with is what the program reads."""
    return repr(float(value))


def mm(value):
    return f"{number(1e3 * value)} mm"


def um(value):
    return f"{number(1e6 * value)} um"


def deg(value):
    return f"{number(math.degrees(value))} deg"


def bar(value):
    return f"{number(1e-5 * value)} bar"


def rpm(value):
    return f"{number(value * 30 / math.pi)} rpm"


def _scalar(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    return value if _PLAIN.fullmatch(value) else '"' + value.replace('"', '\\"') + '"'


def _flow(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_flow, value)) + "]"
    return _scalar(value)


def yaml(model, indent=0):
    """The text of a mapping. A mapping that fits into one line stands in braces, as a person would write it."""
    lines = []
    for key, value in model.items():
        flow = _flow(value)
        is_block = isinstance(value, dict) and value and (indent == 0 or len(flow) > 100 - indent)
        if is_block:
            lines.append(" " * indent + f"{key}:")
            lines.append(yaml(value, indent + 2).rstrip("\n"))
        else:
            lines.append(" " * indent + f"{key}: {flow}")
    return "\n".join(lines) + "\n"
