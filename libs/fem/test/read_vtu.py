#!/usr/bin/python3
"""Reads a .pvd series independently of the program that wrote it, and prints what the test compares, as one line.

Follows the VTK XML format: raw appended arrays, each behind its length in bytes as UInt64.
"""

import os
import struct
import sys
import xml.etree.ElementTree as ElementTree

FORMATS = {"Float64": "d", "Int64": "q", "UInt8": "B"}


def arrays(path):
    with open(path, "rb") as file:
        content = file.read()
    begin = content.index(b'<AppendedData encoding="raw">')
    data = content.index(b"_", begin) + 1
    # The XML around the raw bytes is well formed once they are cut out.
    end = content.rindex(b"</AppendedData>")
    root = ElementTree.fromstring(content[:begin] + b"<AppendedData>" + content[end:])
    assert root.get("header_type") == "UInt64" and root.get("byte_order") == "LittleEndian"
    result = {}
    for array in root.iter("DataArray"):
        offset = data + int(array.get("offset"))
        (size,) = struct.unpack_from("<Q", content, offset)
        letter = FORMATS[array.get("type")]
        values = struct.unpack_from(f"<{size // struct.calcsize(letter)}{letter}", content, offset + 8)
        result[array.get("Name")] = (int(array.get("NumberOfComponents")), values)
    piece = root.find(".//Piece")
    return int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells")), result


pvd = sys.argv[1]
series = ElementTree.parse(pvd).getroot().iter("DataSet")
for entry in series:
    points, cells, fields = arrays(os.path.join(os.path.dirname(pvd), entry.get("file")))
    assert len(fields["Points"][1]) == 3 * points
    assert len(fields["types"][1]) == cells == len(fields["offsets"][1])
    assert fields["offsets"][1][-1] == len(fields["connectivity"][1])
    assert max(fields["connectivity"][1]) < points
    types = "".join(f"{t}," for t in sorted(set(fields["types"][1])))
    components, displacement = fields["displacement"]
    print(f"t={float(entry.get('timestep'))} points={points} cells={cells} types={types} "
          f"displacement={components}x{len(displacement) // components} sum={sum(displacement)!r}", end=";")
