"""Runs inside Blender for addon_test.py: installs the add-on, uses every button, and prints what came of it as JSON."""
import json
import sys

import bpy
import numpy as np

archive, folder = sys.argv[-2:]
MODULE = "welkin_sky"
found = {}


def check(name, result):
    if result != {"FINISHED"}:
        raise RuntimeError(f"{name}: {result}")


bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_install(filepath=archive)
bpy.ops.preferences.addon_enable(module=MODULE)
scene = bpy.context.scene
settings = scene.welkin
settings.folder, settings.file_name = folder, "test"
found["properties"] = settings.sky.sun.bl_rna.properties["elevation"].hard_max

# Presets, parameters, sky files.
check("load", bpy.ops.welkin.load(sky="hero_congestus"))
found["loaded"] = [len(settings.sky.layer), len(settings.sky.hero), settings.sky.hero[0].species]
settings.sky.hero[0].species = "mediocris"
check("species", bpy.ops.welkin.species())
settings.sky.hero[0].position = (0, 4000, 1200)
settings.sky.hero[0].extinction = 0.1
settings.sky.camera.position, settings.sky.camera.pitch, settings.sky.camera.heading = (0, 0, 300), 17, 0
settings.sky.camera.fov = 35
settings.sky.sun.elevation, settings.sky.sun.azimuth = 35, 130
found["width"] = settings.sky.hero[0].form.width
check("save", bpy.ops.welkin.save(filepath=folder + "/saved.sky.toml"))
check("list", bpy.ops.welkin.list(name="sheet", add=True))
check("list", bpy.ops.welkin.list(name="sheet", add=False))
settings.sky.wind.speed = 99
check("reset", bpy.ops.welkin.reset(place='["wind"]'))
found["wind"] = settings.sky.wind.speed

# Camera, preview, world, volume.
check("camera", bpy.ops.welkin.camera())
settings.preview_width = 64
check("preview", bpy.ops.welkin.preview())
found["preview"] = list(bpy.data.images["Welkin preview"].size)
settings.world_size, settings.voxel = 256, 40
check("world", bpy.ops.welkin.world())
sun = bpy.data.objects["Welkin sun"]
found["to_sun"] = list(sun.matrix_basis.to_quaternion() @ __import__("mathutils").Vector((0, 0, 1)))
found["sun"] = [sun.data.energy * c for c in sun.data.color]
check("bake", bpy.ops.welkin.bake())
cloud = bpy.data.objects["Welkin clouds"]
cloud.data.grids.load()
found["grids"] = [grid.name for grid in cloud.data.grids]
shader = next(n for n in cloud.data.materials[0].node_tree.nodes if n.type == "PRINCIPLED_VOLUME")
found["material"] = [shader.inputs["Density"].default_value, shader.inputs["Anisotropy"].default_value]

scene.render.engine = "CYCLES"
scene.cycles.samples, scene.cycles.use_denoising = 8, False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 96, 54, 100


def picture(name):
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = f"{folder}/{name}.exr"
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.array(image.pixels[:]).reshape(image.size[1], image.size[0], -1)[..., :3]
    bpy.data.images.remove(image)
    return pixels


with_cloud = picture("with")
scene.render.image_settings.file_format = "PNG"
scene.render.filepath = folder + "/with.png"
bpy.ops.render.render(write_still=True)
cloud.hide_render = True
without = picture("without")
changed = np.abs(with_cloud - without).max(-1) > 0.3 * without.max(-1) + 0.05
found["changed"] = float(changed.mean())
found["middle"] = float(changed[20:40, 38:58].mean())
found["sky"] = float(without[-8:].mean())

# A sequence: file and frame have the same number.
settings.sequence, settings.file_name, settings.voxel = True, "flow", 100
scene.frame_start, scene.frame_end = 5, 7
check("bake", bpy.ops.welkin.bake())
volume = bpy.data.objects["Welkin clouds"].data
found["frames"] = []
for frame in (5, 7):
    scene.frame_set(frame)
    volume.grids.load()
    found["frames"].append(volume.grids.frame_filepath.rpartition("/")[2])
settings.sequence = False

# A live cloud, and its density on slices of its box, as light of a plane.
from welkin_sky import nodes  # noqa: E402

settings.sky.hero[0].form.shape = "classic"
check("live_cloud", bpy.ops.welkin.live_cloud())
for thing in list(scene.objects):
    thing.hide_render = True
mesh = bpy.data.meshes.new("slice")
mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
plane = bpy.data.objects.new("slice", mesh)
scene.collection.objects.link(plane)
material = bpy.data.materials.new("slice")
material.use_nodes = True
mesh.materials.append(material)
lens = bpy.data.cameras.new("slice")
lens.type, lens.ortho_scale = "ORTHO", 2.0
eye = bpy.data.objects.new("slice", lens)
eye.location.z = 10
scene.collection.objects.link(eye)
scene.camera = eye
scene.world = None
scene.cycles.samples, scene.cycles.pixel_filter_type, scene.cycles.filter_width = 1, "BOX", 0.01
scene.render.resolution_x = scene.render.resolution_y = 128
scene.render.image_settings.color_depth = "32"
form = {"width": 2000.0, "breadth": 1.0, "height": 2000.0, "radii_low": (0.7, 0.9, 0.8), "radii_high": (0.7, 0.5, 0.2)}
classic = {name: row["default"] for name, row in nodes.rows("classic").items()}
found["classic"] = dict(form, **{"classic": classic})
found["slices"] = []
for height in (0.2, 0.4, 0.6, 0.8):
    tree = material.node_tree
    tree.nodes.clear()
    dense = nodes.density(tree, form, classic)
    b = nodes._Build(tree)
    geometry = b.node("ShaderNodeNewGeometry").outputs["Position"]
    share = b.vector("MULTIPLY_ADD", geometry, (0.5, 0.5, 0.0), (0.5, 0.5, height))
    metres = b.vector("MULTIPLY_ADD", geometry, (1000.0, 1000.0, 0.0), (0.0, 0.0, 2000.0 * height))
    for group in [n for n in tree.nodes if n.type == "GROUP"]:
        for socket, value in (("Generated", share), ("Position", metres)):
            if socket in group.inputs:
                tree.links.new(value, group.inputs[socket])
    light = b.node("ShaderNodeEmission")
    tree.links.new(dense, light.inputs["Strength"])
    tree.links.new(light.outputs[0], b.node("ShaderNodeOutputMaterial").inputs["Surface"])
    values = picture("slice")[..., 0]
    found["slices"].append({"height": height, "mean": float(values.mean()), "sd": float(values.std()),
                            "cover": float((values > 0).mean())})
bpy.ops.preferences.addon_disable(module=MODULE)
found["gone"] = not hasattr(bpy.types.Scene, "welkin")
print("FOUND " + json.dumps(found))
