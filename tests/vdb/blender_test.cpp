// Blender imports our file at its place and size and renders it: a long test, for where Blender is installed.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/vdb/volumes.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin {
namespace {

// Prints the volume's box in metres, the grid's type, and the mean of a small picture with and without the volume.
constexpr const char* kScript = R"py(
import bpy, sys, array
path, out = sys.argv[-2:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.object.volume_import(filepath=path)
cloud = bpy.context.object
grid = cloud.data.grids
grid.load()
corners = [cloud.matrix_world @ __import__('mathutils').Vector(c) for c in cloud.bound_box]
print('BOX', *[round(f(c[i] for c in corners), 2) for f in (min, max) for i in range(3)])
print('GRID', grid[0].name, grid[0].data_type)
material = bpy.data.materials.new('cloud')
material.use_nodes = True
nodes = material.node_tree
nodes.nodes.clear()
volume = nodes.nodes.new('ShaderNodeVolumePrincipled')
volume.inputs['Density'].default_value = 1.0
output = nodes.nodes.new('ShaderNodeOutputMaterial')
nodes.links.new(volume.outputs['Volume'], output.inputs['Volume'])
cloud.data.materials.append(material)
scene = bpy.context.scene
camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
camera.location, camera.rotation_euler = (50, 550, 3000), (0, 0, 0)
camera.data.clip_end, camera.data.angle = 10000, 0.4
scene.collection.objects.link(camera)
scene.camera = camera
sun = bpy.data.objects.new('sun', bpy.data.lights.new('sun', 'SUN'))
sun.data.energy = 5
scene.collection.objects.link(sun)
scene.render.engine = 'CYCLES'
scene.cycles.samples, scene.cycles.use_denoising = 4, False
scene.cycles.volume_bounces = 4
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 32, 32, 100
scene.render.image_settings.file_format = 'OPEN_EXR'
for name, hidden in (('WITH', False), ('WITHOUT', True)):
    cloud.hide_render = hidden
    scene.render.filepath = out + name + '.exr'
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(scene.render.filepath)
    pixels = array.array('f', picture.pixels[:])
    print(name, sum(pixels[0::4]) / (len(pixels) / 4))
)py";

std::string outputOf(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return text;
  char block[4096];
  while (const std::size_t got = std::fread(block, 1, sizeof block, pipe)) text.append(block, got);
  ::pclose(pipe);
  return text;
}

double numberAfter(const std::string& text, const std::string& word) {
  const std::size_t at = text.find("\n" + word + " ");
  return at == std::string::npos ? -1.0 : std::stod(text.substr(at + word.size() + 2));
}

TEST(BlenderLong, ImportsAndRendersTheVolume) {
  if (outputOf("command -v blender").empty()) GTEST_SKIP() << "Blender is not installed (Debian: blender)";
  const std::string path = test::temporary("for_blender.vdb"), script = test::temporary("blender.py");
  saveVdb(path, test::ball({40, 24, 32}, {-200.0, 400.0, 800.0}, glm::dvec3(12.5)), {}, VolumePrecision::half);
  writeBytes(script, kScript);
  const std::string text = outputOf("blender -b --factory-startup -noaudio -t 2 --python " + script + " -- " + path +
                                    " " + test::temporary("blender_"));
  EXPECT_NE(text.find("GRID density FLOAT"), std::string::npos) << text;
  double box[6] = {};
  const std::size_t at = text.find("\nBOX ");
  ASSERT_NE(at, std::string::npos) << text;
  ASSERT_EQ(std::sscanf(text.c_str() + at, "\nBOX %lf %lf %lf %lf %lf %lf", &box[0], &box[1], &box[2], &box[3], &box[4],
                        &box[5]),
            6);
  const double expected[6] = {-200.0, 400.0, 800.0, 300.0, 700.0, 1200.0};
  // Blender's box is of its preview mesh or of voxel centres: within a voxel of ours.
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(box[i], expected[i], 12.6) << text;
  EXPECT_GT(numberAfter(text, "WITH"), 0.01) << text;
  EXPECT_NEAR(numberAfter(text, "WITHOUT"), 0.0, 1e-6) << text;
}

}  // namespace
}  // namespace welkin
