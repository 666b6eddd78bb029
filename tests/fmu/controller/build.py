"""Builds the controller of the tests (controller.c) as an FMU."""

import os
import subprocess
import zipfile
from platform import machine

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "controller.c")
PLATFORMS = {2: "linux64", 3: "x86_64-linux"} if machine() == "x86_64" else dict.fromkeys((2, 3), f"{machine()}-linux")

UNITS = """<UnitDefinitions>
  <Unit name="rpm"><BaseUnit rad="1" s="-1" factor="0.10471975511965977"/></Unit>
  <Unit name="rad/s"><BaseUnit rad="1" s="-1"/></Unit>
  <Unit name="N.m"><BaseUnit kg="1" m="2" s="-2"/></Unit>
  <Unit name="kN.m.s/rad"><BaseUnit kg="1" m="2" s="-1" rad="-1" factor="1000"/></Unit>
  <Unit name="T"><BaseUnit kg="1" s="-2" A="-1"/></Unit>
  <Unit name="bananas"/>
</UnitDefinitions>
"""
# name, reference, type of FMI 2, type of FMI 3, causality, start, unit
VARIABLES = [
    ("speed", 1, "Real", "Float64", "input", "0", "rpm"),
    ("wanted", 2, "Real", "Float64", "input", "0", "rad/s"),
    ("gain[1].proportional", 3, "Real", "Float64", "parameter", "1", "N.m.s/rad"),
    ("gain[1].integral", 4, "Real", "Float64", "parameter", "0", None),
    ("fault_time", 5, "Real", "Float64", "parameter", "1e300", None),
    ("torque", 6, "Real", "Float64", "output", None, "N.m"),
    ("fault", 7, "Integer", "Int32", "parameter", "0", None),
    ("is_reversed", 8, "Boolean", "Boolean", "parameter", "false", None),
    ("name", 9, "String", "String", "parameter", "PI", None),
    ("flux", 10, "Real", "Float64", "output", None, "T"),
    ("distance", 11, "Real", "Float64", "output", None, "bananas"),
    ("count", 12, "Integer", "Int32", "output", None, None),
    ("sum", 13, "Real", "Float64", "local", None, None),
]


def description(version, saves_state=True, **changes):
    """The text of modelDescription.xml; `changes` replace attributes: fmi_version, kind, more;
    units and variables are the text of the definitions and the list of variables."""
    state = "FMUstate" if version == 2 else "FMUState"
    flags = "".join(f' {key}{state}="{str(saves_state).lower()}"' for key in ("canGetAndSet", "canSerialize"))
    lines = []
    for name, reference, type_2, type_3, causality, start, unit in changes.get("variables", VARIABLES):
        common = f'name="{name}" valueReference="{reference}" causality="{causality}"'
        if causality == "parameter":
            common += ' variability="fixed"'
        elif "Integer" in type_2:
            common += ' variability="discrete"'
        typed = (f' start="{start}"' if start is not None else "") + (f' unit="{unit}"' if unit else "")
        if version == 2:
            lines.append(f"<ScalarVariable {common}><{type_2}{typed}/></ScalarVariable>")
        elif type_3 == "String":
            lines.append(f'<String {common}><Start value="{start}"/></String>')
        else:
            lines.append(f"<{type_3} {common}{typed}/>")
    if version == 3:
        lines.append('<Float64 name="row" valueReference="20" causality="output"><Dimension start="3"/></Float64>')
    token = "guid" if version == 2 else "instantiationToken"
    number = changes.get("fmi_version", f"{version}.0")
    kind = changes.get("kind", "CoSimulation")
    return (f'<?xml version="1.0" encoding="UTF-8"?>\n<fmiModelDescription fmiVersion="{number}" modelName="controller" '
            f'{token}="controller-of-the-tests">\n<{kind} modelIdentifier="controller"{flags}{changes.get("more", "")}/>\n'
            f"{changes.get('units', UNITS)}<ModelVariables>\n" + "\n".join(lines) + "\n</ModelVariables>\n<ModelStructure/>\n</fmiModelDescription>\n")


def build(path, version, saves_state=True, platform=None, method=zipfile.ZIP_DEFLATED, flags=(), **changes):
    """Writes the FMU to `path`; `flags` are further ones of the compiler."""
    library = f"{path}.so"
    flags = [*flags, *([] if saves_state else ["-DNO_STATE"])]
    compiler = os.environ.get("CC", "cc" if subprocess.run(["which", "cc"], capture_output=True, check=False).returncode == 0 else "clang")
    subprocess.run([compiler, f"-DFMI={version}", *flags, "-shared", "-fPIC", "-O1", "-fvisibility=hidden", "-o", library, SOURCE,
                    "-lm"], check=True)
    with zipfile.ZipFile(path, "w", method) as archive:
        archive.writestr("modelDescription.xml", description(version, saves_state, **changes))
        archive.write(library, f"binaries/{platform or PLATFORMS[version]}/controller.so")
        archive.writestr("resources/note.txt", "read by nobody\n")
    os.remove(library)
    return path
