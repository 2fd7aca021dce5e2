"""Welkin in Blender: skies as volumes, worlds and live nodes. Light, density and pictures are those of the `welkin`
command, which runs beside Blender."""
import bpy

from . import operators, panels, parameters

bl_info = {
    "name": "Welkin",
    "author": "The Welkin authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Welkin",
    "description": "Volumetric clouds and skies from the welkin command",
    "category": "Lighting",
}


class WelkinPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(name="welkin", subtype="FILE_PATH",
                                      description="the command; empty: $WELKIN, or the one on the PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


def _settings(sky):
    """The group behind scene.welkin: the sky and what is made of it."""
    p = bpy.props
    members = {
        "sky": p.PointerProperty(type=sky),
        "loaded": p.BoolProperty(description="a sky has been taken over"),
        "file": p.StringProperty(name="Sky file", subtype="FILE_PATH", description="a .sky.toml to load"),
        "folder": p.StringProperty(name="Folder", subtype="DIR_PATH", default="//welkin",
                                   description="where volumes and pictures go"),
        "file_name": p.StringProperty(name="Name", default="sky", description="how their files begin"),
        "preview_width": p.IntProperty(name="Width", default=480, min=64, max=4096),
        "voxel": p.FloatProperty(name="Voxel (m)", default=20, min=0.05, max=10000, soft_min=2, soft_max=200,
                                 description="edge of a voxel; half of it takes eight times the space"),
        "use_region": p.BoolProperty(name="Own region",
                                     description="otherwise 6 km round the sky's camera, or its hero clouds' box"),
        "region_low": p.FloatVectorProperty(name="West, south, bottom", size=3, default=(-3000, -3000, 0)),
        "region_high": p.FloatVectorProperty(name="East, north, top", size=3, default=(3000, 3000, 4000)),
        "sequence": p.BoolProperty(name="Sequence", description="a volume for every frame of the scene"),
        "prepare": p.BoolProperty(name="Prepare Cycles and camera", default=True,
                                  description="steps, scatterings and a far end of the view that clouds need"),
        "world_size": p.IntProperty(name="Width", default=2048, min=16, max=16384, step=4,
                                    description="of the picture of all directions; a multiple of 4"),
        "world_clouds": p.BoolProperty(name="With clouds",
                                       description="for scenes without the volume, which would show them twice"),
        "exposure": p.BoolProperty(name="Set exposure", default=True, description="to the sky's film"),
        "progress": p.StringProperty(options={"SKIP_SAVE"}),
        "cancel": p.BoolProperty(options={"SKIP_SAVE"}),
    }
    return type("WELKIN_settings", (bpy.types.PropertyGroup,), {"__annotations__": members})


_registered = []


def register():
    settings = _settings(parameters.register())
    for made in (settings, WelkinPreferences, *operators.CLASSES):
        bpy.utils.register_class(made)
        _registered.append(made)
    bpy.types.Scene.welkin = bpy.props.PointerProperty(type=settings)
    panels.register()


def unregister():
    panels.unregister()
    del bpy.types.Scene.welkin
    while _registered:
        bpy.utils.unregister_class(_registered.pop())
    parameters.unregister()
