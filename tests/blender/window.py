"""Runs inside a Blender with a window for addon_test.py: presses buttons that wait for the command, and cancels one."""
import json
import os
import sys
import time
import traceback

import bpy

archive, folder = sys.argv[-2:]
bpy.ops.preferences.addon_install(filepath=archive)
bpy.ops.preferences.addon_enable(module="welkin_sky")
from welkin_sky import operators  # noqa: E402

found = {}
settings = bpy.context.scene.welkin
settings.folder, settings.file_name, settings.preview_width = folder, "window", 64
bpy.context.preferences.view.show_splash = False


def view():
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    return {"window": window, "area": area, "region": next(r for r in area.regions if r.type == "WINDOW")}


def press(operator):
    with bpy.context.temp_override(**view()):
        return sorted(operator("INVOKE_DEFAULT"))


def steps():
    """Each yield waits until it is true."""
    view()["area"].spaces[0].show_region_ui = True
    found["pressed"] = press(bpy.ops.welkin.preview)
    yield lambda: not operators._Work.busy
    found["preview"] = "Welkin preview" in bpy.data.images
    settings.voxel, settings.use_region = 4, True
    found["bake"] = press(bpy.ops.welkin.bake)
    begin = time.time()
    yield lambda: time.time() > begin + 3
    found["busy"] = operators._Work.busy
    try:
        press(bpy.ops.welkin.preview)
    except RuntimeError as error:
        found["refused"] = str(error)
    settings.cancel = True
    yield lambda: not operators._Work.busy
    found["left"] = sorted(f for f in os.listdir(folder) if f.startswith(("window", ".window")))
    found["progress"] = settings.progress
    begin = time.time()
    yield lambda: time.time() > begin + 1
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.screenshot(filepath=folder + "/window.png")


running, waiting = steps(), [lambda: True]


def go_on():
    try:
        if waiting[0]():
            waiting[0] = next(running)
        return 0.3
    except StopIteration:
        pass
    except Exception:
        found["error"] = traceback.format_exc()
    with open(folder + "/window.json", "w", encoding="utf-8") as file:
        json.dump(found, file)
    bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(go_on, first_interval=1.0)
