"""What bakes become in a Blender scene: volume, material, world, sun, camera."""
import json
import math
import os

import bpy
from mathutils import Matrix, Vector

VOLUME, MATERIAL, WORLD, SUN, CAMERA = "Welkin clouds", "Welkin cloud", "Welkin sky", "Welkin sun", "Welkin camera"


def _object(name, data, context):
    """The object of this name with this data, new and linked where there is none."""
    found = bpy.data.objects.get(name)
    if found is None or found.type != _type_of(data):
        found = bpy.data.objects.new(name, data)
    found.data = data
    if found.name not in context.scene.objects:
        context.scene.collection.objects.link(found)
    return found


def _type_of(data):
    return {"Volume": "VOLUME", "SunLight": "LIGHT", "Camera": "CAMERA"}[type(data).__name__]


def cloud_material(medium):
    """The material with the numbers of `welkin vdb`: density, albedo and mean cosine of its medium."""
    material = bpy.data.materials.get(MATERIAL) or bpy.data.materials.new(MATERIAL)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    volume = nodes.new("ShaderNodeVolumePrincipled")
    volume.inputs["Density"].default_value = medium["density"]
    volume.inputs["Density Attribute"].default_value = "density"
    volume.inputs["Color"].default_value = (*[medium["albedo"]] * 3, 1.0)
    volume.inputs["Anisotropy"].default_value = medium["asymmetry"]
    output = nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 300
    links.new(volume.outputs["Volume"], output.inputs["Volume"])
    return material


def place_volume(context, made, frames):
    """The files of `welkin vdb --json` as one volume object; `frames` (first, last) of a sequence, or None."""
    volume = bpy.data.volumes.get(VOLUME) or bpy.data.volumes.new(VOLUME)
    volume.filepath = made["files"][0]
    volume.is_sequence = frames is not None
    if frames:
        first, last = frames
        volume.frame_start, volume.frame_duration = first, last - first + 1
        volume.frame_offset = first - 1  # file and frame of the scene have the same number
        volume.sequence_mode = "EXTEND"
    volume.grids.unload()
    cloud = _object(VOLUME, volume, context)
    volume.materials.clear()
    volume.materials.append(cloud_material(made))
    return cloud


def _at_least(holder, name, value):
    if getattr(holder, name, value) < value:
        setattr(holder, name, value)


def prepare_render(context, made):
    """What clouds need of Cycles and the camera: steps, scatterings, a far end of the view."""
    cycles = getattr(context.scene, "cycles", None)
    if cycles is not None:
        _at_least(cycles, "volume_max_steps", 1024)
        _at_least(cycles, "volume_bounces", 64)
        _at_least(cycles, "max_bounces", 64)
    size = (Vector(made["high"]) - Vector(made["low"])).length
    if context.scene.camera:
        _at_least(context.scene.camera.data, "clip_end", 10 * size)


def _world_nodes(world, picture):
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    sky = nodes.new("ShaderNodeTexEnvironment")
    sky.image = picture
    background = nodes.new("ShaderNodeBackground")
    background.location.x = 300
    output = nodes.new("ShaderNodeOutputWorld")
    output.location.x = 500
    links.new(sky.outputs["Color"], background.inputs["Color"])
    links.new(background.outputs["Background"], output.inputs["Surface"])


def set_world(context, path):
    """The picture of `welkin hdri --target blender` as world; the light of its sidecar as a sun.

    Both keep the picture's unit: radiance in kcd/m^2, the sun's irradiance in klx."""
    with open(path + ".json", encoding="utf-8") as file:
        sidecar = json.load(file)
    picture = next((i for i in bpy.data.images if bpy.path.abspath(i.filepath) == path), None)
    if picture is None:
        picture = bpy.data.images.load(path)
    picture.reload()
    world = bpy.data.worlds.get(WORLD) or bpy.data.worlds.new(WORLD)
    _world_nodes(world, picture)
    context.scene.world = world
    for light in sidecar["lights"]:
        set_sun(context, light)
    if not sidecar["lights"] and SUN in bpy.data.objects:
        bpy.data.objects.remove(bpy.data.objects[SUN])
    return sidecar


def set_sun(context, light):
    lamp = bpy.data.lights.get(SUN)
    if lamp is None or lamp.type != "SUN":
        lamp = bpy.data.lights.new(SUN, "SUN")
    irradiance = [c * light["illuminance"] / 1000 for c in light["color"]]
    lamp.energy = max(irradiance)
    lamp.color = [c / max(lamp.energy, 1e-20) for c in irradiance]
    lamp.angle = math.radians(light["angular_diameter"])
    sun = _object(SUN, lamp, context)
    sun.rotation_mode = "QUATERNION"
    sun.rotation_quaternion = Vector(light["direction"]).to_track_quat("Z", "Y")
    return sun


def set_exposure(context, film):
    """Blender's exposure for light in kcd/m^2 where the sky's film has an exposure value of its own."""
    if film.exposure == "manual":
        context.scene.view_settings.exposure = math.log2(1000 / (1.2 * 2**film.ev)) + film.compensation


def set_camera(context, camera):
    """Blender's camera where the sky's is."""
    lens = bpy.data.cameras.get(CAMERA) or bpy.data.cameras.new(CAMERA)
    lens.sensor_fit = "HORIZONTAL"
    lens.angle = math.radians(camera.fov)
    lens.clip_end = max(lens.clip_end, 1e5)
    found = _object(CAMERA, lens, context)
    turn = (Matrix.Rotation(-math.radians(camera.heading), 3, "Z")
            @ Matrix.Rotation(math.pi / 2 + math.radians(camera.pitch), 3, "X")
            @ Matrix.Rotation(-math.radians(camera.roll), 3, "Z"))
    found.rotation_mode = "XYZ"
    found.rotation_euler = turn.to_euler()
    found.location = camera.position
    context.scene.camera = found
    return found


def folder_of(path):
    """An absolute folder that exists, for what the add-on writes; Blender's temporary one for an unsaved `//`."""
    if path.startswith("//") and not bpy.data.filepath:
        path = os.path.join(bpy.app.tempdir, path[2:])
    path = os.path.abspath(bpy.path.abspath(path))
    os.makedirs(path, exist_ok=True)
    return path
