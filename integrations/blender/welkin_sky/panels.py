"""The sidebar's tab. Its tables of parameters are made from the field tables."""
import json

import bpy

from . import command, operators, parameters

_presets = []  # (name, what it is), asked for once
_classes = []


def presets(context):
    if not _presets:
        _presets.extend((p["name"], p["sentence"]) for p in command.presets(operators.program(context)))
    return _presets


class _Panel:
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Welkin"


class WELKIN_MT_presets(bpy.types.Menu):
    bl_label = "Presets"

    def draw(self, context):
        try:
            for name, _ in presets(context):
                self.layout.operator("welkin.load", text=parameters.label(name)).sky = name
        except command.WelkinError as error:
            self.layout.label(text=str(error), icon="ERROR")


class WELKIN_PT_main(_Panel, bpy.types.Panel):
    bl_label = "Welkin"

    def draw(self, context):
        settings, layout = context.scene.welkin, self.layout
        layout.menu("WELKIN_MT_presets", icon="PRESET")
        row = layout.row(align=True)
        row.prop(settings, "file", text="")
        row.operator("welkin.load", text="", icon="IMPORT").sky = settings.file
        row.operator("welkin.save", text="", icon="EXPORT")
        if settings.progress:
            row = layout.row()
            row.label(text=settings.progress, icon="TIME")
            row.operator("welkin.cancel", text="", icon="CANCEL")
        layout.prop(settings, "folder")
        layout.prop(settings, "file_name")
        layout.operator("welkin.copy_command", icon="COPYDOWN")


class WELKIN_PT_preview(_Panel, bpy.types.Panel):
    bl_label, bl_parent_id = "Preview", "WELKIN_PT_main"

    def draw(self, context):
        row = self.layout.row(align=True)
        row.prop(context.scene.welkin, "preview_width")
        row.operator("welkin.preview", icon="RENDER_STILL")
        image = bpy.data.images.get(operators.PREVIEW)
        if image and image.preview:
            self.layout.template_icon(image.preview.icon_id, scale=10)
        self.layout.operator("welkin.camera", icon="CAMERA_DATA")


class WELKIN_PT_volume(_Panel, bpy.types.Panel):
    bl_label, bl_parent_id = "Clouds as a volume", "WELKIN_PT_main"

    def draw(self, context):
        settings, layout = context.scene.welkin, self.layout
        layout.prop(settings, "voxel")
        layout.prop(settings, "use_region")
        if settings.use_region:
            layout.prop(settings, "region_low")
            layout.prop(settings, "region_high")
        layout.prop(settings, "sequence")
        layout.prop(settings, "prepare")
        layout.operator("welkin.bake", icon="VOLUME_DATA")


class WELKIN_PT_world(_Panel, bpy.types.Panel):
    bl_label, bl_parent_id = "Sky as a world", "WELKIN_PT_main"

    def draw(self, context):
        settings, layout = context.scene.welkin, self.layout
        layout.prop(settings, "world_size")
        layout.prop(settings, "world_clouds")
        layout.prop(settings, "exposure")
        layout.operator("welkin.world", icon="WORLD")


class WELKIN_PT_nodes(_Panel, bpy.types.Panel):
    bl_label, bl_parent_id = "Live nodes", "WELKIN_PT_main"

    def draw(self, context):
        self.layout.operator("welkin.live_cloud", icon="NODE_MATERIAL")


def _draw_group(layout, node, group):
    column = layout.column()
    column.use_property_split = True
    for row in node.rows:
        column.prop(group, parameters.identifier(row["name"]))


def _draw_node(layout, node, group, place):
    if node.rows:
        layout.operator("welkin.reset", icon="LOOP_BACK").place = json.dumps(place)
        _draw_group(layout, node, group)
    for name, child in node.children.items():
        box = layout.box()
        box.label(text=parameters.label(name), icon="DOT")
        _draw_node(box, child, getattr(group, parameters.identifier(name)), [*place, name])


def _draw_list(layout, name, node, sky):
    items, active = parameters.at(sky, (name,)), f"active_{name}"
    row = layout.row(align=True)
    if len(items) > 1:
        row.prop(sky, active, text=f"of {len(items)}, from 0")
    else:
        row.label(text="none" if not len(items) else "one")
    for add, icon in ((True, "ADD"), (False, "REMOVE")):
        button = row.operator("welkin.list", text="", icon=icon)
        button.name, button.add = name, add
    if len(items):
        index = min(getattr(sky, active), len(items) - 1)
        if name == "hero":
            layout.operator("welkin.species", icon="SHAPEKEY_DATA")
        _draw_node(layout, node, items[index], [name, index])


def _parameter_panel(name, node):
    def draw(self, context):
        sky = context.scene.welkin.sky
        if node.is_list:
            _draw_list(self.layout, name, node, sky)
        elif name:
            _draw_node(self.layout, node, parameters.at(sky, (name,)), [name])
        else:
            _draw_group(self.layout, node, sky)

    return type(f"WELKIN_PT_parameters_{name or 'sky'}", (_Panel, bpy.types.Panel),
                {"bl_label": parameters.label(name or "sky"), "bl_parent_id": "WELKIN_PT_parameters",
                 "bl_options": {"DEFAULT_CLOSED"}, "bl_description": node.about, "draw": draw})


class WELKIN_PT_parameters(_Panel, bpy.types.Panel):
    bl_label, bl_options = "Parameters", {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.label(text="as sky files name them")


def register():
    own = [WELKIN_MT_presets, WELKIN_PT_main, WELKIN_PT_preview, WELKIN_PT_volume, WELKIN_PT_world, WELKIN_PT_nodes,
           WELKIN_PT_parameters, _parameter_panel("", parameters.ROOT)]
    own += [_parameter_panel(name, node) for name, node in parameters.ROOT.children.items()]
    for made in own:
        bpy.utils.register_class(made)
        _classes.append(made)


def unregister():
    _presets.clear()
    while _classes:
        bpy.utils.unregister_class(_classes.pop())
