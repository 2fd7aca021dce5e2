"""What the buttons do. Long work runs beside Blender, with progress, and Esc cancels it."""
import json
import os
import shlex

import bpy

from . import command, nodes, parameters, scene

PREVIEW = "Welkin preview"


def program(context):
    """The `welkin` command of this add-on's version. Raises WelkinError."""
    addon = context.preferences.addons.get(__package__)
    path = command.find(bpy.path.abspath(addon.preferences.program) if addon and addon.preferences.program else "")
    version = command.ask(path, "--version").split()[-1]
    if version != parameters.VERSION:
        raise command.WelkinError(f"{path} is version {version}; this add-on was made for {parameters.VERSION}")
    return path


class _Failing:
    """Turns what the command says into Blender's message."""

    def fail(self, error):
        self.report({"INFO" if isinstance(error, command.Cancelled) else "ERROR"}, str(error))
        return {"CANCELLED"}


class _Work(_Failing):
    """An operator whose work is a job of the command: `start` begins it, `end` takes its output."""

    _job = None
    busy = ""  # what is at work

    def execute(self, context):
        try:
            self.end(context, self.start(context).result())
        except (command.WelkinError, OSError) as error:
            return self.fail(error)
        return {"FINISHED"}

    def invoke(self, context, event):
        if _Work.busy:
            return self.fail(f"{_Work.busy} is still at work: Esc cancels it")
        try:
            self._job = self.start(context)
        except (command.WelkinError, OSError) as error:
            return self.fail(error)
        _Work.busy = self.bl_label
        self._timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        settings = context.scene.welkin
        if event.type == "ESC" or settings.cancel:
            settings.cancel = False
            self._job.cancel()
        elif event.type != "TIMER" or self._job.running():
            settings.progress = f"{self.bl_label}: {self._job.progress:.0%}  (Esc cancels)"
            context.window_manager.progress_update(100 * self._job.progress)
            context.workspace.status_text_set(settings.progress)
            if event.type == "TIMER":
                self._redraw(context)
            return {"PASS_THROUGH"}
        self._leave(context)
        try:
            self.end(context, self._job.result())
        except (command.WelkinError, OSError) as error:
            return self.fail(error)
        finally:
            self._redraw(context)
        return {"FINISHED"}

    def cancel(self, context):
        """Blender ends it: another file is opened, or Blender closed."""
        self._job.cancel()
        self._leave(context)

    def _leave(self, context):
        _Work.busy = ""
        context.scene.welkin.progress = ""
        context.workspace.status_text_set(None)
        context.window_manager.progress_end()
        context.window_manager.event_timer_remove(self._timer)

    @staticmethod
    def _redraw(context):
        for area in context.screen.areas if context.screen else ():
            area.tag_redraw()

    def sky_file(self, context):
        """The sky of the properties, written where the command finds it."""
        path = os.path.join(bpy.app.tempdir, "welkin.sky.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(parameters.to_text(context.scene.welkin))
        return path


class WELKIN_OT_load(_Failing, bpy.types.Operator):
    """Take over the parameters of a preset or a sky file"""

    bl_idname, bl_label = "welkin.load", "Load sky"
    bl_options = {"REGISTER", "UNDO"}

    sky: bpy.props.StringProperty(name="Sky", description="a preset's name or a sky file")

    def execute(self, context):
        try:
            rows = command.values(program(context), bpy.path.abspath(self.sky))
            parameters.from_values(context.scene.welkin, rows)
        except (command.WelkinError, OSError) as error:
            return self.fail(error)
        return {"FINISHED"}


class WELKIN_OT_save(_Failing, bpy.types.Operator):
    """Write the parameters as a sky file"""

    bl_idname, bl_label = "welkin.save", "Save sky"

    filepath: bpy.props.StringProperty(subtype="FILE_PATH")

    def execute(self, context):
        path = bpy.path.abspath(self.filepath)
        path += "" if path.endswith(".toml") else ".sky.toml"
        try:
            with open(path + ".part", "w", encoding="utf-8") as file:
                file.write(parameters.to_text(context.scene.welkin))
            os.replace(path + ".part", path)
        except OSError as error:
            return self.fail(f"{path}: {error.strerror}")
        return {"FINISHED"}

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}


class WELKIN_OT_list(bpy.types.Operator):
    """Add or remove a layer, sheet, grid or hero cloud"""

    bl_idname, bl_label = "welkin.list", "Change list"
    bl_options = {"REGISTER", "UNDO"}

    name: bpy.props.StringProperty()
    add: bpy.props.BoolProperty()

    def execute(self, context):
        sky = context.scene.welkin.sky
        items, active = parameters.at(sky, (self.name,)), f"active_{self.name}"
        if self.add:
            items.add()
            setattr(sky, active, len(items) - 1)
        elif len(items):
            items.remove(min(getattr(sky, active), len(items) - 1))
            setattr(sky, active, max(0, min(getattr(sky, active), len(items) - 1)))
        return {"FINISHED"}


class WELKIN_OT_reset(bpy.types.Operator):
    """Give the parameters of this table their defaults"""

    bl_idname, bl_label = "welkin.reset", "Reset"
    bl_options = {"REGISTER", "UNDO"}

    place: bpy.props.StringProperty()

    def execute(self, context):
        parameters.reset(context.scene.welkin.sky, tuple(json.loads(self.place)))
        return {"FINISHED"}


class WELKIN_OT_species(_Failing, bpy.types.Operator):
    """Give a hero cloud the shape that its species has"""

    bl_idname, bl_label = "welkin.species", "Take the species' shape"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        sky = context.scene.welkin.sky
        if not len(sky.hero):
            return {"CANCELLED"}
        index = min(sky.active_hero, len(sky.hero) - 1)
        path = os.path.join(bpy.app.tempdir, "species.sky.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(f'format = 1\n[[hero]]\nspecies = "{sky.hero[index].species}"\n')
        kept = {n: getattr(sky.hero[index], n) for n in ("heading", "scale", "seed")}
        kept["position"] = tuple(sky.hero[index].position)
        try:
            rows = command.values(program(context), path)
        except command.WelkinError as error:
            return self.fail(error)
        for row in rows:
            if not row["path"].startswith("hero.0."):
                continue
            *place, name = row["path"].split(".")[2:]
            value = str(row["value"]) if "choices" in row else row["value"]
            setattr(parameters.at(sky.hero[index], place), parameters.identifier(name), value)
        for name, value in kept.items():
            setattr(sky.hero[index], name, value)
        return {"FINISHED"}


class WELKIN_OT_preview(_Work, bpy.types.Operator):
    """Draw the sky through its own camera with the real-time renderer"""

    bl_idname, bl_label = "welkin.preview", "Preview"

    def start(self, context):
        settings = context.scene.welkin
        self._path = os.path.join(bpy.app.tempdir, "welkin_preview.png")
        width = settings.preview_width
        return command.Job(program(context), ["render", self.sky_file(context), "-o", self._path, "--size",
                                              f"{width}x{width * 9 // 16}", "--frames", 4], bpy.app.tempdir)

    def end(self, context, output):
        image = bpy.data.images.get(PREVIEW)
        if image is None:
            image = bpy.data.images.load(self._path)
            image.name = PREVIEW
        image.filepath = self._path
        image.reload()
        image.preview_ensure()


class WELKIN_OT_bake(_Work, bpy.types.Operator):
    """Bake the clouds to OpenVDB and put them into the scene with their material"""

    bl_idname, bl_label = "welkin.bake", "Bake clouds"

    def start(self, context):
        settings = context.scene.welkin
        folder = scene.folder_of(settings.folder)
        arguments = ["vdb", self.sky_file(context), "-o", os.path.join(folder, f"{settings.file_name}.vdb"),
                     "--target", "blender", "--voxel", settings.voxel, "--json"]
        self._frames = None
        if settings.use_region:
            low, high = settings.region_low, settings.region_high
            arguments += ["--region=" + ",".join(str(v) for v in (low[0], low[1], high[0], high[1], low[2], high[2]))]
        if settings.sequence:
            self._frames = context.scene.frame_start, context.scene.frame_end
            fps = context.scene.render.fps / context.scene.render.fps_base
            arguments += ["--frames", f"{self._frames[0]}-{self._frames[1]}", "--fps", fps]
        return command.Job(program(context), arguments, folder)

    def end(self, context, output):
        made = json.loads(output)
        cloud = scene.place_volume(context, made, self._frames)
        if context.scene.welkin.prepare:
            scene.prepare_render(context, made)
        if made["empty"]:
            self.report({"WARNING"}, "there is no cloud in this box: choose another region")
        if made["sheets_left_out"]:
            self.report({"INFO"}, "thin high sheets have no thickness and were left out")
        for other in context.selected_objects:
            other.select_set(False)
        cloud.select_set(True)
        context.view_layer.objects.active = cloud


class WELKIN_OT_world(_Work, bpy.types.Operator):
    """Draw the sky as a picture of all directions, light the scene with it, and match the sun"""

    bl_idname, bl_label = "welkin.world", "Make world"

    def start(self, context):
        settings = context.scene.welkin
        folder = scene.folder_of(settings.folder)
        self._path = os.path.join(folder, f"{settings.file_name}_sky.exr")
        arguments = ["hdri", self.sky_file(context), "-o", self._path, "--target", "blender", "--sun", "none",
                     "--size", settings.world_size]
        if not settings.world_clouds:
            arguments.append("--no-clouds")
        return command.Job(program(context), arguments, folder)

    def end(self, context, output):
        scene.set_world(context, self._path)
        if context.scene.welkin.exposure:
            scene.set_exposure(context, context.scene.welkin.sky.film)


class WELKIN_OT_camera(bpy.types.Operator):
    """Put a camera where the sky's is"""

    bl_idname, bl_label = "welkin.camera", "Match camera"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        scene.set_camera(context, context.scene.welkin.sky.camera)
        return {"FINISHED"}


class WELKIN_OT_cancel(bpy.types.Operator):
    """End the work that is going on"""

    bl_idname, bl_label = "welkin.cancel", "Cancel"

    def execute(self, context):
        context.scene.welkin.cancel = True
        return {"FINISHED"}


class WELKIN_OT_live_cloud(bpy.types.Operator):
    """Add a box whose cloud is computed by nodes while it is rendered"""

    bl_idname, bl_label = "welkin.live_cloud", "Add live cloud"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        box = nodes.live_cloud(context)
        for other in context.selected_objects:
            other.select_set(False)
        box.select_set(True)
        context.view_layer.objects.active = box
        return {"FINISHED"}


class WELKIN_OT_copy_command(bpy.types.Operator):
    """Copy a command line that renders this sky outside Blender"""

    bl_idname, bl_label = "welkin.copy_command", "Copy as command"

    def execute(self, context):
        path = os.path.join(scene.folder_of(context.scene.welkin.folder), f"{context.scene.welkin.file_name}.sky.toml")
        bpy.ops.welkin.save(filepath=path)
        context.window_manager.clipboard = f"welkin render {shlex.quote(path)} -o sky.png"
        return {"FINISHED"}


CLASSES = (WELKIN_OT_load, WELKIN_OT_save, WELKIN_OT_list, WELKIN_OT_reset, WELKIN_OT_species, WELKIN_OT_preview,
           WELKIN_OT_bake, WELKIN_OT_world, WELKIN_OT_camera, WELKIN_OT_cancel, WELKIN_OT_live_cloud,
           WELKIN_OT_copy_command)
