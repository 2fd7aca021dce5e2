"""The field tables as a tree, and skies as text. Nothing of Blender is needed here."""
import json
import struct


class Table:
    """A table of parameters: its rows, the tables inside it, and whether a sky has a list of it."""

    def __init__(self, name):
        self.name, self.about, self.is_list = name, "", False
        self.rows, self.children = [], {}

    def child(self, name):
        return self.children.setdefault(name, Table(name))


def tree(rows):
    """The root of the tables that the rows of `welkin fields --json` describe."""
    root = Table("")
    for row in rows:
        table = root
        for part in filter(None, row["table"].split(".")):
            table = table.child(part)
        table.about = row["about"]
        table.is_list = bool(row["list"]) and row["table"] == row["list"]
        table.rows.append(dict(row, name=row["path"].rpartition(".")[2]))
    return root


def _single(value):
    return struct.unpack("f", struct.pack("f", value))[0]


def number(value):
    """The shortest decimal that is the same single-precision number, as TOML writes it."""
    for digits in range(1, 10):
        text = f"{value:.{digits}g}"
        if _single(float(text)) == _single(value):
            break
    return repr(float(text))


def literal(row, value):
    """A value as a sky file writes it."""
    if row["kind"] == "vector":
        return "[" + ", ".join(number(v) for v in value) + "]"
    if row["kind"] == "real":
        return number(value)
    if row["kind"] == "boolean":
        return "true" if value else "false"
    if row["kind"] == "integer":
        return str(int(value))
    return json.dumps(value, ensure_ascii=False)


def text(root, read):
    """A sky file. `read(place, row)` is a value and `read(place, None)` the length of a list, None for one to leave
    out, at a place such as ("layer", 0, "weather")."""
    out = ["format = 1"]
    for name, child in root.children.items():
        if child.is_list and read((name,), None) == 0:
            out.append(f"{name} = []")

    def write(table, place, header):
        if table.rows and header:
            out.append(f"\n{header}")
        out.extend(f"{row['name']} = {literal(row, read(place, row))}" for row in table.rows)
        for name, child in table.children.items():
            words = [p for p in place if isinstance(p, str)] + [name]
            if child.is_list:
                for i in range(read((*place, name), None) or 0):
                    write(child, (*place, name, i), f"[[{'.'.join(words)}]]")
            else:
                write(child, (*place, name), f"[{'.'.join(words)}]")

    write(root, (), "")
    return "\n".join(out) + "\n"
