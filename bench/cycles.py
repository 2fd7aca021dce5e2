# Draws a cloud in Blender's Cycles, for bench/cycles.hpp:
#   blender -b --factory-startup -noaudio --python bench/cycles.py -- SETTINGS.json
# Written for Blender 3.4. For every shot it prints "SHOT name CPU-seconds" of the call that renders it.
import json
import resource
import sys

import bpy
from mathutils import Vector

with open(sys.argv[-1]) as file:
    want = json.load(file)

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def imported_volume():
    """The cloud of a file; its density as a socket of its material."""
    bpy.ops.object.volume_import(filepath=want['volume'])
    cloud = bpy.context.object
    # Cycles samples volumes half a voxel low on every axis.
    cloud.location = Vector(want['location']) - Vector((want['voxel'] / 2,) * 3)
    material = new_material(cloud)
    density = material.node_tree.nodes.new('ShaderNodeAttribute')
    density.attribute_name = 'density'
    return material, density.outputs['Fac']


def live_volume():
    """A cloud of the add-on's nodes in its box, computed while it is drawn."""
    live = want['live']
    sys.path.insert(0, live['add_on'])
    from welkin_sky import nodes
    form = live['form']
    box = nodes._box('cloud', form['width'], form['width'] * form['breadth'], form['height'])
    cloud = bpy.data.objects.new('cloud', box)
    cloud.location = live['location']
    scene.collection.objects.link(cloud)
    material = new_material(cloud)
    material.cycles.volume_step_rate = nodes.STEP_RATE
    return material, nodes.density(material.node_tree, form, live['classic'])


def new_material(cloud):
    material = bpy.data.materials.new('cloud')
    material.use_nodes = True
    material.node_tree.nodes.clear()
    cloud.data.materials.append(material)
    return material


material, density = live_volume() if 'live' in want else imported_volume()
nodes, links = material.node_tree.nodes, material.node_tree.links
extinction = nodes.new('ShaderNodeMath')
extinction.operation = 'MULTIPLY'
extinction.inputs[1].default_value = want['extinction']
scatter = nodes.new('ShaderNodeVolumeScatter')
scatter.inputs['Color'].default_value = (1, 1, 1, 1)
scatter.inputs['Anisotropy'].default_value = want['asymmetry']
output = nodes.new('ShaderNodeOutputMaterial')
links.new(density, extinction.inputs[0])
links.new(extinction.outputs[0], scatter.inputs['Density'])
links.new(scatter.outputs[0], output.inputs['Volume'])

# A sky of one radiance above the horizon and none below.
world = bpy.data.worlds.new('sky')
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
nodes.clear()
direction = nodes.new('ShaderNodeTexCoord')
split = nodes.new('ShaderNodeSeparateXYZ')
above = nodes.new('ShaderNodeMath')
above.operation = 'GREATER_THAN'
above.inputs[1].default_value = want['horizon']
background = nodes.new('ShaderNodeBackground')
background.inputs['Color'].default_value = (*want['sky'], 1)
output = nodes.new('ShaderNodeOutputWorld')
links.new(direction.outputs['Generated'], split.inputs[0])
links.new(split.outputs['Z'], above.inputs[0])
links.new(above.outputs[0], background.inputs['Strength'])
links.new(background.outputs[0], output.inputs['Surface'])
world.cycles.sampling_method = 'NONE'
scene.world = world

lamp = bpy.data.lights.new('sun', 'SUN')
lamp.energy = max(want['irradiance'])
lamp.color = [c / lamp.energy for c in want['irradiance']]
lamp.angle = want['sun_angle']
sun = bpy.data.objects.new('sun', lamp)
sun.rotation_euler = Vector(want['to_sun']).to_track_quat('Z', 'Y').to_euler()
scene.collection.objects.link(sun)

lens = bpy.data.cameras.new('camera')
lens.sensor_fit, lens.angle, lens.clip_end = 'HORIZONTAL', want['fov'], 1e6
camera = bpy.data.objects.new('camera', lens)
camera.location = want['eye']
camera.rotation_euler = Vector(want['backward']).to_track_quat('Z', 'Y').to_euler()
scene.collection.objects.link(camera)
scene.camera = camera

scene.render.engine = 'CYCLES'
scene.render.resolution_x, scene.render.resolution_y = want['width'], want['height']
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = 'OPEN_EXR'
scene.render.image_settings.color_depth = '32'
scene.render.use_persistent_data = True
cycles = scene.cycles
cycles.use_denoising = cycles.use_adaptive_sampling = False
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.pixel_filter_type, cycles.filter_width = 'BOX', 1
cycles.volume_max_steps = 65536
cycles.max_bounces = 1024
cycles.transparent_max_bounces = 1024  # sides of the volume's boxes count

for shot in want['shots']:
    cycles.samples, cycles.seed = shot['samples'], shot['seed']
    cycles.volume_step_rate = shot['step_rate']
    cycles.volume_bounces = shot['scatterings'] - 1
    scene.render.filepath = want['folder'] + '/' + shot['name'] + '.exr'
    begin = resource.getrusage(resource.RUSAGE_SELF)
    bpy.ops.render.render(write_still=True)
    end = resource.getrusage(resource.RUSAGE_SELF)
    print('SHOT', shot['name'], end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime, flush=True)
