"""An afternoon of cumulus from Python: run it cell by cell, or as a whole: afternoon.py [FOLDER]"""
# %% A sky is a preset, a file or the default; every parameter of docs/fields.md is an attribute.
import pathlib
import sys
import tempfile

import numpy as np

import welkin

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp())
sky = welkin.Sky("cumulus")
print(sky)
print(sky.layers[0].weather)

# %% Change it. Wrong values are refused with the message that `welkin --set` gives.
sky.title = "From Python"
sky.layers[0].weather.coverage = 0.45
sky.wind.speed = 12
try:
    sky.sun.elevation = 200
except welkin.BadInput as error:
    print("refused:", error)
sky.save(folder / "from_python.sky.toml")

# %% Density as arrays: a level through the clouds, and the cover that one sees from below.
clouds = sky.clouds()
edge = np.arange(-4000.0, 4000.0, 100.0)
east, north = np.meshgrid(edge, edge, indexing="ij")
base = sky.layers[0].base
level = clouds.extinction(np.stack([east, north, np.full_like(east, base + 300)], -1))  # 1/m
depth = clouds.optical_depth(np.stack([east, north], -1), base - 200, base + 3000, step=50)
print(f"cloud at {base + 300:.0f} m: {(level > 0).mean():.0%} of the level; cover {(depth > 0.3).mean():.0%}, "
      f"mean optical depth {depth.mean():.1f}")

# %% The same question through the day: what the sun's height does to a small picture.
for elevation in (60, 10):
    sky.sun.elevation = elevation
    light = sky.render(96, 54, frames=4)  # kcd/m^2, linear Rec.709
    print(f"sun at {elevation} degrees: mean luminance {1000 * (light @ [0.2126, 0.7152, 0.0722]).mean():.0f} cd/m^2")
    sky.save_picture(folder / f"sun_{elevation}.png", light)

# %% A volume for another renderer, with the numbers to type there.
medium = sky.bake(folder / "clouds.vol", voxel=100, region=(-2000, -2000, 2000, 2000), target="mitsuba",
                  progress=lambda done: print(f"\rbaking {done:4.0%}", end="", flush=True))
print(f"\nextinction at 1: {medium['density']:.3g} 1/m, mean cosine {medium['asymmetry']:.3f}")
print("written to", folder)
