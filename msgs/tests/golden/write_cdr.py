"""Writes cdr.txt: CDR of every standard message, serialised by the independent Python library `rosbags`.

Members are filled in order from a counter, as `tests/golden_cdr.rs` fills them; sequences have one
element, sequences of octets three. Run below `msgs/`, with `rosbags` installed:

    python tests/golden/write_cdr.py
"""

from pathlib import Path

import numpy
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

DUMMY = "structure_needs_at_least_one_member"
OCTETS = ("byte", "char", "uint8", "octet")


class Filler:
    """Values from a counter."""

    def __init__(self, store):
        self.store = store
        self.counter = 0

    def message(self, name):
        fields = self.store.fielddefs[name][1]
        values = {field: self.value(kind) for field, kind in fields}
        return self.store.types[name](**values)

    def value(self, kind):
        node, detail = kind
        if node == Nodetype.BASE:
            return self.primitive(detail[0])
        if node == Nodetype.NAME:
            return self.message(detail)
        inner, length = detail
        if node == Nodetype.SEQUENCE:
            octets = inner[0] == Nodetype.BASE and inner[1][0] in OCTETS
            length = 3 if octets else 1
        values = [self.value(inner) for _ in range(length)]
        if inner[0] == Nodetype.BASE and inner[1][0] != "string":
            name = inner[1][0]
            return numpy.array(values, dtype="uint8" if name in OCTETS else name)
        return values

    def primitive(self, name):
        self.counter += 1
        if name == "string":
            return f"s{self.counter}"
        if name == "bool":
            return self.counter % 2 == 1
        if name.startswith("float"):
            return self.counter + 0.5
        return self.counter % 100


def main():
    store = get_typestore(Stores.EMPTY)
    types = {}
    for path in sorted(Path("standard").glob("*/msg/*.msg")):
        name = f"{path.parts[1]}/msg/{path.stem}"
        types.update(get_types_from_msg(path.read_text() or f"uint8 {DUMMY}", name))
    for name, (_, fields) in types.items():
        if not fields:
            types[name] = ([], [(DUMMY, (Nodetype.BASE, ("uint8", 0)))])
    store.register(types)
    lines = []
    for name in sorted(types):
        message = Filler(store).message(name)
        for little in (True, False):
            data = bytes(store.serialize_cdr(message, name, little_endian=little))
            lines.append(f"{name} {data.hex()}")
    Path("tests/golden/cdr.txt").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
