// The driver lays uniform blocks out as C++ lays out the structs that are uploaded into them.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <sstream>
#include <string>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/law.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::realtime {
namespace {

constexpr const char* kFiles[] = {"welkin/base/law.glsl",
                                  "welkin/light/phase.glsl",
                                  "welkin/light/transmittance.glsl",
                                  "welkin/noise/hash.glsl",
                                  "welkin/noise/lattice.glsl",
                                  "welkin/noise/remap.glsl",
                                  "welkin/density/space.glsl",
                                  "welkin/density/weather.glsl",
                                  "welkin/density/profile.glsl",
                                  "welkin/density/nubis.glsl",
                                  "welkin/density/sheet.glsl",
                                  "welkin/density/scatter.glsl",
                                  "welkin/atmosphere/atmosphere.glsl",
                                  "welkin/atmosphere/models.glsl",
                                  "welkin/precipitation/precipitation.glsl",
                                  "welkin/scene/rain.glsl",
                                  "welkin/realtime/drops.glsl",
                                  "welkin/realtime/light_volume.glsl",
                                  "welkin/realtime/march_params.glsl",
                                  "welkin/realtime/host_params.glsl",
                                  "welkin/realtime/shaders/frame.glsl"};

using Offsets = std::map<std::string, std::size_t>;

// The members of the house's uniform structs where a C++ compiler puts them: every scalar and vector aligned to 4.
class Structs {
 public:
  Structs() {
    for (const char* file : kFiles) parse(std::string(shaderSource(file)));
  }
  std::size_t size(const std::string& type) const {
    if (type == "float" || type == "int" || type == "uint") return 4;
    if (type == "vec4") return 16;
    std::size_t sum = 0;
    for (const auto& [memberType, name] : members_.at(type)) sum += size(memberType);
    return sum;
  }
  std::size_t add(const std::string& type, const std::string& path, std::size_t at, Offsets& offsets) const {
    const auto found = members_.find(type);
    if (found == members_.end()) {
      offsets[path] = at;
      return at + size(type);
    }
    for (const auto& [memberType, name] : found->second) at = add(memberType, path + "." + name, at, offsets);
    return at;
  }

 private:
  void parse(const std::string& text) {
    for (std::size_t at = text.find("struct "); at != std::string::npos; at = text.find("struct ", at + 1)) {
      const std::size_t open = text.find('{', at), close = text.find('}', at);
      const std::string name = text.substr(at + 7, text.find_first_of(" {", at + 7) - at - 7);
      std::string body, line;
      std::istringstream lines(text.substr(open + 1, close - open - 1));
      while (std::getline(lines, line)) body += line.substr(0, line.find("//")) + "\n";
      std::istringstream declarations(body);
      for (std::string declaration; std::getline(declarations, declaration, ';');) {
        for (char& c : declaration)
          if (c == ',') c = ' ';
        std::istringstream words(declaration);
        std::string type;
        words >> type;
        for (std::string member; words >> member;) members_[name].emplace_back(type, member);
      }
    }
  }
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> members_;
};

class UniformBlocks : public testing::TestWithParam<gl::ContextKind> {
 protected:
  // Offsets of all members of the block called "Block" that `declaration` declares; `use` is a float that reads it.
  Offsets offsets(const std::string& declaration, const std::string& block, const std::string& use) {
    std::string text;
    for (const char* file : kFiles) text += "#include \"" + std::string(file) + "\"\n";
    text += declaration + "\nout vec4 oResult;\nvoid main() { oResult = vec4(" + use + "); }\n";
    const gl::Program program(gl_, "offsets", "", text, shaderSource);
    const GLuint wanted = gl_.GetUniformBlockIndex(program.id(), block.c_str());
    GLint count = 0;
    gl_.GetProgramiv(program.id(), GL_ACTIVE_UNIFORMS, &count);
    Offsets found;
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
      GLint index = -1, offset = -1;
      gl_.GetActiveUniformsiv(program.id(), 1, &i, GL_UNIFORM_BLOCK_INDEX, &index);
      if (index < 0 || static_cast<GLuint>(index) != wanted) continue;
      gl_.GetActiveUniformsiv(program.id(), 1, &i, GL_UNIFORM_OFFSET, &offset);
      char name[256];
      GLint size = 0;
      GLenum type = 0;
      gl_.GetActiveUniform(program.id(), i, sizeof name, nullptr, &size, &type, name);
      found[name] = static_cast<std::size_t>(offset);
    }
    return found;
  }

  gl::Context context_{GetParam()};
  gl::Api gl_ = gl::loadApi(context_.loader());
};

TEST_P(UniformBlocks, LieAsInCpp) {
  const Structs structs;
  struct Case {
    const char* type;
    std::size_t size;
    const char* use;
    const char* last;  // the last member that is checked against C++'s own offsetof
    std::size_t lastOffset;
  };
  const Case cases[] = {
      {"LayerParams", sizeof(law::LayerParams), "base", "needsExtra", offsetof(law::LayerParams, needsExtra)},
      {"ClipParams", sizeof(law::ClipParams), "level0.margin", "count", offsetof(law::ClipParams, count)},
      {"SheetParams", sizeof(law::SheetParams), "height", "kind", offsetof(law::SheetParams, kind)},
      {"AtmosphereParams", sizeof(law::AtmosphereParams), "groundRadius", "groundRadius",
       offsetof(law::AtmosphereParams, groundRadius)},
      {"LightVolumeParams", sizeof(law::LightVolumeParams), "bottom", "shift", offsetof(law::LightVolumeParams, shift)},
      {"PreethamParams", sizeof(law::PreethamParams), "", "", 0},
      {"GradientParams", sizeof(law::GradientParams), "", "", 0},
      {"MarchParams", sizeof(law::MarchParams), "bottom", "rain", offsetof(law::MarchParams, rain)},
      {"RainParams", sizeof(law::RainParams), "rate", "streaks", offsetof(law::RainParams, streaks)},
      {"DropParams", sizeof(law::DropParams), "rate", "shutter", offsetof(law::DropParams, shutter)},
      {"DropClass", sizeof(law::DropClass), "start.x", "flake", offsetof(law::DropClass, flake)},
      {"HostParams", sizeof(law::HostParams), "bottom", "yUp", offsetof(law::HostParams, yUp)},
      {"WeatherParams", sizeof(law::WeatherParams), "coverage", "seed", offsetof(law::WeatherParams, seed)}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.type);
    const std::string type = c.type;
    ASSERT_EQ(structs.size(type), c.size);
    EXPECT_EQ(c.size % 16, 0u) << "elements of an array of it start at multiples of 16";
    if (!*c.use) continue;
    Offsets expected;
    for (int i = 0; i < 3; ++i)
      structs.add(type, "uValue[" + std::to_string(i) + "]", c.size * static_cast<std::size_t>(i), expected);
    EXPECT_EQ(expected.at(std::string("uValue[0].") + c.last), c.lastOffset);
    const Offsets found = offsets("layout(std140) uniform Block { " + type + " uValue[3]; };", "Block",
                                  std::string("uValue[1].") + c.use);
    EXPECT_GE(found.size(), expected.size() / 3) << "the driver names the members";
    for (const auto& [name, offset] : found) {
      ASSERT_TRUE(expected.count(name)) << name;
      EXPECT_EQ(offset, expected.at(name)) << name;
    }
  }
}

// The sky's block holds three structs one after the other.
TEST_P(UniformBlocks, SkyBlockLiesAsInCpp) {
  const Structs structs;
  Offsets expected;
  structs.add("AtmosphereParams", "uAir", offsetof(SkyParams, air), expected);
  structs.add("PreethamParams", "uPreetham", offsetof(SkyParams, preetham), expected);
  structs.add("GradientParams", "uGradient", offsetof(SkyParams, gradient), expected);
  const Offsets found = offsets(
      "layout(std140) uniform SkyBlock { AtmosphereParams uAir; PreethamParams uPreetham; GradientParams uGradient; };",
      "SkyBlock", "uAir.groundRadius");
  EXPECT_EQ(found, expected);
}

TEST_P(UniformBlocks, FrameLiesAsInCpp) {
  const Offsets expected{{"uCamera.forward", offsetof(FrameParams, camera.forward)},
                         {"uCamera.right", offsetof(FrameParams, camera.right)},
                         {"uCamera.above", offsetof(FrameParams, camera.above)},
                         {"uCamera.angles", offsetof(FrameParams, camera.angles)},
                         {"uSize", offsetof(FrameParams, size)},
                         {"uMarchSize", offsetof(FrameParams, marchSize)},
                         {"uOffset", offsetof(FrameParams, offset)},
                         {"uTiming", offsetof(FrameParams, timing)},
                         {"uDepthInfo", offsetof(FrameParams, depthInfo)},
                         {"uPrevious0", offsetof(FrameParams, previous0)},
                         {"uPrevious1", offsetof(FrameParams, previous1)},
                         {"uPrevious3", offsetof(FrameParams, previous3)},
                         {"uWind", offsetof(FrameParams, wind)},
                         {"uOptions", offsetof(FrameParams, options)},
                         {"uTarget", offsetof(FrameParams, target)},
                         {"uLock", offsetof(FrameParams, lock)}};
  EXPECT_EQ(offsets("", "Frame", "uCamera.forward.x"), expected);
}

INSTANTIATE_TEST_SUITE_P(Kinds, UniformBlocks, testing::Values(gl::ContextKind::desktop, gl::ContextKind::es),
                         [](const auto& kind) {
                           return std::string(kind.param == gl::ContextKind::es ? "es" : "desktop");
                         });

}  // namespace
}  // namespace welkin::realtime
