"""Volumetric clouds and skies: load, change and save them, ask for their density, draw and bake them.

    import welkin
    sky = welkin.Sky("cumulus")              # a preset, a sky file, or nothing for the default sky
    sky.sun.elevation = 20
    sky.layers[0].weather.coverage = 0.6
    light = sky.render(640, 360)             # kcd/m^2, float32 (360, 640, 3)
    sky.save_picture("afternoon.png", light)
    sigma = sky.clouds().extinction(points)  # 1/m at (..., 3) points in m
    sky.bake("cumulus.vdb", voxel=20)

Parameters, their units, ranges and defaults are those of sky files; fields() lists them. Angles are degrees.
"""
import os
import pathlib

from ._welkin import BadInput, Cancelled, Clouds, Error, Failed, NoOpenGl, __version__, fields
from . import _welkin

__all__ = ["BadInput", "Cancelled", "Clouds", "Error", "Failed", "NoOpenGl", "Section", "SkyList", "Sky",
           "__version__", "fields", "parse", "presets"]


def _preset_folder():
    """$WELKIN_PRESETS, or the folder of an installation or of the source tree that this package is in."""
    chosen = os.environ.get("WELKIN_PRESETS", "")
    root = pathlib.Path(__file__).resolve().parents[min(4, len(pathlib.Path(__file__).resolve().parents) - 1)]
    for folder in ([chosen] if chosen else [root / "share/welkin/presets", root / "presets"]):
        if os.path.isdir(folder):
            return str(folder)
    return ""


def presets():
    """The skies that come with Welkin: dictionaries of name, genus, sentence and file."""
    return _welkin.presets(_preset_folder())


def parse(text, name="sky"):
    """A sky from the text of a sky file; `name` stands in errors, and files are looked for in its folder."""
    sky = Sky()
    sky._parse(text, name)
    return sky


class Section:
    """A table of parameters of a sky; its attributes are parameters and tables inside it."""

    __slots__ = ("_sky", "_path")

    def __init__(self, sky, path):
        object.__setattr__(self, "_sky", sky)
        object.__setattr__(self, "_path", path)

    def _names(self):
        start = self._path + "." if self._path else ""
        return {p[len(start):].split(".")[0] for p in self._sky._paths() if p.startswith(start)}

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        path = f"{self._path}.{name}"
        if any(p.startswith(path + ".") for p in self._sky._paths()):
            return Section(self._sky, path)
        try:
            return self._sky[path]
        except BadInput as error:
            raise AttributeError(str(error)) from None

    def __setattr__(self, name, value):
        self._sky[f"{self._path}.{name}"] = value

    def __dir__(self):
        return sorted(self._names())

    def __repr__(self):
        start = self._path + "."
        rows = [f"{p[len(start):]}={self._sky[p]!r}" for p in self._sky._paths() if p.startswith(start)]
        return f"<{self._path}: {', '.join(rows)}>"


class SkyList:
    """The layers, sheets, grids or hero clouds of a sky."""

    def __init__(self, sky, name):
        self._sky, self._name = sky, name

    def _index(self, i):
        size = len(self)
        if not -size <= i < size:
            raise IndexError(f"the sky has {size} [[{self._name}]]; they are counted from 0")
        return i % size

    def __len__(self):
        return self._sky._lists()[self._name]

    def __getitem__(self, i):
        return Section(self._sky, f"{self._name}.{self._index(i)}")

    def __delitem__(self, i):
        self._sky._remove(self._name, self._index(i))

    def append(self, **values):
        """Adds an element of defaults and sets parameters; those of a table inside it are a dictionary.

        A hero cloud's `species` is set first, whatever the order."""
        before = self._sky.copy()
        self._sky._append(self._name)
        path = f"{self._name}.{len(self) - 1}"
        try:
            self._fill(path, values)
        except Error:
            self._sky._copy(before)
            raise
        return self[-1]

    def _fill(self, path, values):
        for name in sorted(values, key=lambda n: n != "species"):
            if isinstance(values[name], dict):
                self._fill(f"{path}.{name}", values[name])
            else:
                self._sky[f"{path}.{name}"] = values[name]

    def clear(self):
        while len(self):
            del self[-1]

    def __repr__(self):
        return f"<{len(self)} [[{self._name}]]>"


class Sky(_welkin.Sky):
    """A sky: every parameter by attribute (sky.sun.elevation) or by path (sky["sun.elevation"])."""

    # Lists by more than one name: as many, and as their tables in files.
    _LISTS = {"layers": "layer", "sheets": "sheet", "grids": "grid", "heroes": "hero"}

    def __init__(self, sky=""):
        super().__init__()
        self._load(os.fspath(sky), _preset_folder())

    def __getitem__(self, path):
        return self._get(path)

    def __setitem__(self, path, value):
        self._set(path, os.fspath(value) if isinstance(value, os.PathLike) else value)

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if Sky._LISTS.get(name, name) in self._lists():
            return SkyList(self, Sky._LISTS.get(name, name))
        if any(p.startswith(name + ".") for p in self._paths()):
            return Section(self, name)
        try:
            return self[name]
        except BadInput as error:
            raise AttributeError(str(error)) from None

    def __setattr__(self, name, value):
        self[name] = value

    def __dir__(self):
        own = ({p.split(".")[0] for p in self._paths()} | set(self._lists())) - set(Sky._LISTS.values())
        return sorted(set(super().__dir__()) | own | set(Sky._LISTS))

    def __eq__(self, other):
        return self._same(other) if isinstance(other, Sky) else NotImplemented

    __hash__ = None

    def copy(self):
        other = Sky()
        other._copy(self)
        return other

    __copy__ = copy

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce__(self):
        return parse, (self.text(),)

    def paths(self):
        """The path of every parameter that this sky has."""
        return self._paths()

    def __repr__(self):
        return f"<welkin.Sky {self.title!r}: " + ", ".join(f"{n} {k}" for k, n in self._lists().items()) + ">"
