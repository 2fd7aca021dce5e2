#include <gtest/gtest.h>

#include <string>

#include "welkin/io/sky_file.hpp"
#include "welkin/scene/surface.hpp"

namespace welkin {
namespace {

// What clouds reflect over black ground, by `welkin flux --sun diffuse --periodic xy --phase draine:20` over
// `welkin vdb --region -24000,-24000,24000,24000 --voxel 100` of these presets, to .03 (rms over all of them: .036).
TEST(Presets, ReflectAsMuchAsPathTraced) {
  const auto of = [](const char* preset) {
    return airSurface(loadSky(std::string(WELKIN_SOURCE_DIR "/presets/") + preset + ".sky.toml")).clouds;
  };
  EXPECT_NEAR(of("cumulus"), 0.086f, 0.03f);
  EXPECT_NEAR(of("stratocumulus"), 0.416f, 0.03f);
  EXPECT_NEAR(of("altocumulus"), 0.130f, 0.03f);
  EXPECT_NEAR(of("altostratus"), 0.382f, 0.03f);
  EXPECT_NEAR(of("nimbostratus"), 0.799f, 0.03f);
}

}  // namespace
}  // namespace welkin
