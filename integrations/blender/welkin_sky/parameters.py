"""Blender properties made from the field tables, and skies read into and written from them."""
import json
import pathlib

import bpy

from . import table

FIELDS = json.loads((pathlib.Path(__file__).parent / "fields.json").read_text(encoding="utf-8"))
ROOT = table.tree(FIELDS["fields"])
VERSION = FIELDS["version"]

_classes = []


def identifier(name):
    """The property of a parameter: its name, with an underscore where Blender has that name already."""
    return name + "_" if hasattr(bpy.types.PropertyGroup, name) else name


def label(name):
    return name.replace("_", " ").capitalize()


def _limits(row):
    low, high = row["range"]
    soft_low, soft_high = row["slider"]
    named = {"min": low, "max": high, "soft_min": soft_low, "soft_max": soft_high}
    return {key: value for key, value in named.items() if value is not None}


def _property(row):
    unit = f" ({row['unit']})" if row["unit"] else ""
    common = {"name": label(row["name"]) + unit, "description": row["help"][:1].upper() + row["help"][1:]}
    kind = row["kind"]
    if "choices" in row:
        items = [(str(c), label(str(c)), "") for c in row["choices"]]
        return bpy.props.EnumProperty(items=items, default=str(row["default"]), **common)
    if kind == "boolean":
        return bpy.props.BoolProperty(default=row["default"], **common)
    if kind == "integer":
        return bpy.props.IntProperty(default=row["default"], **_limits(row), **common)
    if kind == "real":
        return bpy.props.FloatProperty(default=row["default"], precision=4, **_limits(row), **common)
    if kind == "vector":
        return bpy.props.FloatVectorProperty(size=3, default=row["default"], precision=4, **_limits(row), **common)
    if kind == "file":
        return bpy.props.StringProperty(default=row["default"], subtype="FILE_PATH", **common)
    return bpy.props.StringProperty(default=row["default"], **common)


def _group(node, path):
    members = {identifier(row["name"]): _property(row) for row in node.rows}
    for name, child in node.children.items():
        group = _group(child, f"{path}_{name}")
        if child.is_list:
            members[identifier(name)] = bpy.props.CollectionProperty(type=group)
            members[f"active_{name}"] = bpy.props.IntProperty(name=f"Active {name}", min=0)
        else:
            members[identifier(name)] = bpy.props.PointerProperty(type=group)
    made = type(path, (bpy.types.PropertyGroup,), {"__annotations__": members})
    bpy.utils.register_class(made)
    _classes.append(made)
    return made


def at(sky, place):
    """The group or list at a place such as ("layer", 0, "weather")."""
    for part in place:
        sky = sky[part] if isinstance(part, int) else getattr(sky, identifier(part))
    return sky


def _table_at(place):
    node = ROOT
    for part in place:
        if isinstance(part, str):
            node = node.children[part]
    return node


def to_text(settings):
    """The sky file that the properties stand for. Paths of files are made absolute. Lists that nobody has touched yet
    are left out, so that a new scene has the default sky."""
    sky = settings.sky

    def read(place, row):
        if row is None:
            return len(at(sky, place)) if settings.loaded or len(at(sky, place)) else None
        value = getattr(at(sky, place), identifier(row["name"]))
        return bpy.path.abspath(value) if row["kind"] == "file" and value else value

    return table.text(ROOT, read)


def from_values(settings, rows):
    """Takes over the rows of `welkin fields SKY --json`."""
    sky = settings.sky
    settings.loaded = True
    sizes = {name: 0 for name, child in ROOT.children.items() if child.is_list}
    split = []
    for row in rows:
        place = tuple(int(p) if p.isdigit() else p for p in row["path"].split("."))
        split.append((place[:-1], place[-1], row))
        if len(place) > 1 and isinstance(place[1], int):
            sizes[place[0]] = max(sizes[place[0]], place[1] + 1)
    for name, size in sizes.items():
        items = at(sky, (name,))
        items.clear()
        for _ in range(size):
            items.add()
        setattr(sky, f"active_{name}", 0)
    for place, name, row in split:
        value = str(row["value"]) if "choices" in row else row["value"]
        setattr(at(sky, place), identifier(name), value)


def reset(sky, place):
    """Gives the parameters of one table, with those inside it, their defaults."""
    group, node = at(sky, place), _table_at(place)
    for row in node.rows:
        group.property_unset(identifier(row["name"]))
    for name, child in node.children.items():
        if not child.is_list:
            reset(sky, (*place, name))


def register():
    """The group of a whole sky."""
    return _group(ROOT, "WELKIN_sky")


def unregister():
    while _classes:
        bpy.utils.unregister_class(_classes.pop())
