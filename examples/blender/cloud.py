"""Installs the add-on and draws a hero cloud with it:
blender -b --factory-startup --python examples/blender/cloud.py -- welkin_sky.zip picture.png"""
import sys
import tempfile

import bpy

archive, picture = sys.argv[-2:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_install(filepath=archive)
bpy.ops.preferences.addon_enable(module="welkin_sky")
scene = bpy.context.scene
settings = scene.welkin
settings.folder = tempfile.mkdtemp()

# The sky: a congestus beside the sun.
settings.sky.hero.add()
cloud = settings.sky.hero[0]
cloud.species = "congestus"
bpy.ops.welkin.species()
cloud.position, cloud.scale, cloud.seed = (0, 6500, 1200), 0.7, 3
settings.sky.sun.elevation, settings.sky.sun.azimuth = 40, 240
camera = settings.sky.camera
camera.position, camera.pitch, camera.heading, camera.fov = (0, 0, 300), 17, 0, 34

bpy.ops.welkin.camera()
settings.world_size = 1024
bpy.ops.welkin.world()
settings.voxel = 16
bpy.ops.welkin.bake()

scene.render.engine = "CYCLES"
scene.cycles.samples, scene.cycles.use_denoising = 24, False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 400, 225, 100
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
