// The include for the host's shaders against what the frame itself shows, and its bindings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/realtime/stage.hpp"
#include "welkin/atmosphere/sun.hpp"
#include "welkin/base/error.hpp"
#include "welkin/density/field.hpp"
#include "welkin/density/params.hpp"
#include "welkin/realtime/law.hpp"
#include "welkin/scene/shade.hpp"

namespace welkin::realtime::test {
namespace {

// A host's pass over the whole target. Its shader sees the ray of its pixel (`ray`, length 1 along the view's axis, in
// the host's axes) and two numbers, and writes `vec4 answer`.
class HostPass {
 public:
  HostPass(const gl::Api& gl, const std::string& answer, int width = kWidth, int height = kHeight)
      : gl_(gl), program_(gl, "host", "", shader(answer), [](std::string_view) { return std::string_view(); }),
        target_(gl, gl::Texture::Kind::plane, gl::kRgba32F, width, height, 0, gl::Filter::nearest,
                gl::Addressing::clamp, nullptr),
        framebuffer_(gl), triangle_(gl) {}

  unsigned program() const { return program_.id(); }

  // RGBA, top row first.
  Image draw(Renderer& sky, const View& view, const Frame& frame, float a = 0.0f, float b = 0.0f) {
    const gl::Texture* targets[] = {&target_};
    framebuffer_.target(targets);
    sky.bindHost(view, program_.id(), {.firstUnit = 3, .uniformBlock = 2});
    gl_.UseProgram(program_.id());
    const glm::mat3 axes = glm::transpose(glm::mat3(frame.view));
    const glm::vec3 right = axes[0] / frame.projection[0][0], above = axes[1] / frame.projection[1][1];
    gl_.Uniform3f(program_.uniform("uForward"), -axes[2].x, -axes[2].y, -axes[2].z);
    gl_.Uniform3f(program_.uniform("uRight"), right.x, right.y, right.z);
    gl_.Uniform3f(program_.uniform("uAbove"), above.x, above.y, above.z);
    gl_.Uniform2f(program_.uniform("uNumbers"), a, b);
    gl_.BindVertexArray(triangle_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    const int width = target_.width(), height = target_.height();
    std::vector<float> rgba(static_cast<std::size_t>(width) * height * 4);
    gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
    gl_.check("a pass of the host's");
    Image image(width, height, 4);
    for (int y = 0; y < height; ++y)
      std::copy_n(rgba.data() + static_cast<std::size_t>(height - 1 - y) * width * 4, width * 4, image.at(0, y));
    return image;
  }

 private:
  static std::string shader(const std::string& answer) {
    return Renderer::hostShader() +
           // Names that the house has too.
           "#define saturate(x) clamp(x, 0.0, 1.0)\nfloat select(float a) { return a; }\nstruct Real { float xyz; };\n"
           "float march(float x) { return saturate(x); }\nconst float kReduced = 1.0;\n"
           "in vec2 vUv;\nout vec4 oColour;\nuniform vec3 uForward, uRight, uAbove;\nuniform vec2 uNumbers;\n"
           "void main() {\n  vec3 ray = uForward + uRight * (vUv.x * 2.0 - 1.0) + uAbove * (vUv.y * 2.0 - 1.0);\n"
           "  vec4 answer;\n" +
           answer + "\n  oColour = answer;\n}\n";
  }
  const gl::Api& gl_;
  gl::Program program_;
  gl::Texture target_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray triangle_;
};

const char* const kFrontAtDistance =
    "WelkinFront f = welkinFront(normalize(ray) * uNumbers.x); answer = vec4(f.light, f.clouds);";

Scene cumulus() {
  Scene scene = plainScene(LayerShape::profile);
  scene.layers[0].weather.coverage = 0.7f;
  scene.camera.pitch = 0.25f;
  return scene;
}

class HostShader : public testing::TestWithParam<gl::ContextKind> {};

TEST_P(HostShader, StartsWithNothingAndEndsWithTheFramesOwnClouds) {
  Stage stage(kWidth, kHeight, GetParam());
  const Scene scene = cumulus();
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  frame.background = Background::host;
  frame.preExposure = 0.5f;
  HostPass pass(stage.gl, kFrontAtDistance);
  View view;
  const Image black = stage.draw(view, frame);
  frame.output = Output::transmittance;
  const Image clear = stage.draw(view, frame);
  const Image none = pass.draw(*stage.sky, view, frame, 0.0f), all = pass.draw(*stage.sky, view, frame, 250000.0f);
  double least = 1.0, most = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < 3; ++c) ASSERT_EQ(none.at(x, y)[c], 0.0f);
      ASSERT_EQ(none.at(x, y)[3], 1.0f);
      const double own = clear.at(x, y)[1];
      ASSERT_NEAR(all.at(x, y)[3], own, 1e-3);
      // The clouds' light and, through them, that of all the air.
      ASSERT_GE(all.at(x, y)[1], 0.998f * black.at(x, y)[1] - 2e-3f);
      if (own < 0.02) {
        ASSERT_NEAR(all.at(x, y)[1], black.at(x, y)[1], 0.02 * black.at(x, y)[1] + 0.02);
      }
      least = std::min(least, own);
      most = std::max(most, own);
    }
  EXPECT_LT(least, 0.02);
  EXPECT_GT(most, 0.9);
}

// A march that ends at a wall is the truth for what stands before it.
TEST_P(HostShader, SplitsCloudsNearTheTruth) {
  Stage stage(kWidth, kHeight, GetParam());
  const Scene scene = cumulus();
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  frame.background = Background::host;
  frame.output = Output::transmittance;
  HostPass pass(stage.gl, kFrontAtDistance);
  std::vector<Image> split;
  const double distances[] = {2500.0, 4000.0, 6000.0, 9000.0};
  View view;
  stage.draw(view, frame);
  for (const double distance : distances) split.push_back(pass.draw(*stage.sky, view, frame, float(distance)));
  const Image open = stage.draw(view, frame);
  for (std::size_t i = 0; i < split.size(); ++i) {
    // Reversed infinite depth of a wall that is as far in every pixel.
    std::vector<float> depth(static_cast<std::size_t>(kWidth) * kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double right = (2.0 * (x + 0.5) / kWidth - 1.0) / frame.projection[0][0];
        const double above = (2.0 * (y + 0.5) / kHeight - 1.0) / frame.projection[1][1];
        depth[static_cast<std::size_t>(y) * kWidth + x] =
            float(frame.projection[3][2] * std::sqrt(1.0 + right * right + above * above) / distances[i]);
      }
    const gl::Texture wall = stage.depth(depth);
    Frame cut = frame;
    cut.depthTexture = wall.id();
    View fresh;
    const Image truth = stage.draw(fresh, cut);
    double error = 0.0, nothing = 0.0, everything = 0.0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double t = truth.at(x, y)[1];
        error += std::abs(split[i].at(x, y)[3] - t) / (kWidth * kHeight);
        nothing += std::abs(1.0 - t) / (kWidth * kHeight);
        everything += std::abs(open.at(x, y)[1] - t) / (kWidth * kHeight);
      }
    std::printf("at %5.0f m: transmittance off by %.4f; %.4f without clouds, %.4f with all of them\n", distances[i],
                error, nothing, everything);
    EXPECT_LT(error, 0.05);
    EXPECT_LT(error, 0.5 * std::max(nothing, everything));
  }
}

// Welkin's own ground, lit and seen through the air as the include says: shadows, light of the sky and haze in one.
TEST_P(HostShader, DrawsTheGroundThatTheFrameDraws) {
  Stage stage(kWidth, kHeight, GetParam());
  Scene scene = cumulus();
  scene.camera.position.z = 900.0;
  scene.camera.pitch = -0.55f;
  stage.sky->setScene(scene);
  const Frame frame = stage.frame(scene);
  HostPass pass(stage.gl,
                "vec3 p = normalize(ray); p *= 900.0 / -p.z; WelkinLight l = welkinLight(p); WelkinFront f = "
                "welkinAir(p); answer = vec4(vec3(0.13, 0.15, 0.08) / 3.14159265 * (l.sun * l.toSun.z + l.sky) * "
                "f.through + f.light, welkinSunShare(p));");
  View view;
  stage.sky->prepare(view, frame);
  const Image own = pass.draw(*stage.sky, view, frame);
  const Image drawn = stage.draw(view, frame);
  double shade = 0.0, open = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      shade += own.at(x, y)[3] < 0.5f ? 1.0 : 0.0;
      open += own.at(x, y)[3] > 0.9f ? 1.0 : 0.0;
    }
  EXPECT_GT(shade, 50.0);
  EXPECT_GT(open, 50.0);
  // The plane and the sphere are some metres apart.
  EXPECT_GT(displayedPsnr(own, drawn), 45.0);
}

TEST_P(HostShader, LightsASkyWithoutAVolumeOfLight) {
  Stage stage(kWidth, kHeight, GetParam());
  Scene scene = cumulus();
  scene.quality.lightVolume = false;
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  frame.background = Background::host;
  HostPass pass(stage.gl,
                "WelkinLight l = welkinLight(ray * 10.0); answer = vec4(l.sun.y, l.sky.y, "
                "welkinSunShare(ray), welkinThrough(vec4(1.0), ray * 100.0).a);");
  View view;
  stage.draw(view, frame);
  const Image image = pass.draw(*stage.sky, view, frame);
  const Outputs outputs = stage.sky->outputs(view);
  EXPECT_NEAR(image.at(5, 5)[0], outputs.sunIrradiance.y, 0.02 * outputs.sunIrradiance.y);
  EXPECT_NEAR(image.at(5, 5)[1], outputs.skyUnderClouds.y, 1e-3 * outputs.skyUnderClouds.y);
  EXPECT_EQ(image.at(5, 5)[2], 1.0f) << "the shade is not known";
  EXPECT_EQ(image.at(5, 5)[3], 1.0f);
  EXPECT_EQ(outputs.sunDepth.name, 0u);
}

INSTANTIATE_TEST_SUITE_P(Kinds, HostShader, testing::Values(gl::ContextKind::desktop, gl::ContextKind::es),
                         [](const auto& kind) {
                           return std::string(kind.param == gl::ContextKind::es ? "es" : "desktop");
                         });

// The same share on the CPU from the density itself: shade.hpp states the error.
TEST(SunShare, OfTheCpuIsThatOfTheShader) {
  Stage stage(kWidth, kHeight);
  Scene scene = plainScene(LayerShape::profile);
  scene.quality.preset = QualityPreset::high;
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  HostPass pass(stage.gl, "answer = vec4(welkinSunShare(vec3((vUv - 0.5) * vec2(8000.0, 4500.0), -uNumbers.x)));");
  View view;
  stage.sky->prepare(view, frame);
  const Image gpu = pass.draw(*stage.sky, view, frame, 150.0f);
  const DensityField field({.layers = scene.layers,
                            .noise = scene.noise,
                            .drift = {scene.wind.speed, scene.wind.from, 0.0},
                            .seed = scene.seed});
  const glm::dvec3 toSun = stage.sky->outputs(view).toSun;
  double error = 0.0, mean = 0.0, bias = 0.0;
  int count = 0;
  for (int y = 0; y < kHeight; y += 2)
    for (int x = 0; x < kWidth; x += 2) {
      const glm::dvec3 p(((x + 0.5) / kWidth - 0.5) * 8000.0, (0.5 - (y + 0.5) / kHeight) * 4500.0, 0.0);
      const double cpu = sunShare(field, p, toSun);
      error += std::abs(gpu.at(x, y)[0] - cpu);
      bias += gpu.at(x, y)[0] - cpu;
      mean += cpu;
      ++count;
    }
  std::printf("sun share %.3f, GPU off by %.4f in the mean, %.4f with its sign\n", mean / count, error / count,
              bias / count);
  EXPECT_GT(mean / count, 0.1);
  EXPECT_LT(mean / count, 0.95);
  EXPECT_LT(error / count, 0.06);
  EXPECT_LT(std::abs(bias / count), 0.03);
  EXPECT_FLOAT_EQ(static_cast<float>(kTurnedAside), law::kReduced);
}

// A sheet above dims them too.
TEST(SunShare, SheetsAboveTakeTheirPart) {
  Stage stage(kWidth, kHeight);
  Scene scene = plainScene(LayerShape::profile);
  Sheet sheet;
  sheet.kind = SheetKind::cirrostratus;
  sheet.opticalDepth = 2.0f;
  sheet.coverage = 1.0f;
  scene.sheets = {sheet};
  HostPass pass(stage.gl, "answer = vec4(welkinSunShare(vec3((vUv - 0.5) * vec2(8000.0, 4500.0), -uNumbers.x)));");
  const auto share = [&](const Scene& sky, glm::vec3& toSun) {
    stage.sky->setScene(sky);
    Frame frame = stage.frame(sky);
    View view;
    stage.sky->prepare(view, frame);
    toSun = stage.sky->outputs(view).toSun;
    return pass.draw(*stage.sky, view, frame, 150.0f);
  };
  glm::vec3 toSun;
  const Image under = share(scene, toSun);
  const law::SheetParams params = sheetParams(sheet, glm::dvec2(0.0), 0.0, scene.seed);
  scene.sheets.clear();
  const Image clear = share(scene, toSun);
  double least = 1.0;
  for (int y = 0; y < kHeight; y += 2)
    for (int x = 0; x < kWidth; x += 2) {
      const glm::vec2 p(((x + 0.5f) / kWidth - 0.5f) * 8000.0f, (0.5f - (y + 0.5f) / kHeight) * 4500.0f);
      const float depth =
          law::sheetDepthToward(p, sheet.height, toSun, toSun.z, static_cast<float>(1.0 / kPlanetRadius), params);
      EXPECT_NEAR(under.at(x, y)[0], clear.at(x, y)[0] * std::exp(-depth), 0.02) << x << " " << y;
      least = std::min(least, std::exp(-static_cast<double>(depth)));
    }
  EXPECT_LT(least, 0.75);
}

TEST(HostAxes, TheIncludeTakesBothUps) {
  Stage stage(kWidth, kHeight);
  Scene scene = cumulus();
  scene.camera.position = {1200.0, -3400.0, 900.0};
  stage.sky->setScene(scene);
  Frame z = stage.frame(scene);
  z.background = Background::host;
  Frame y = z;
  y.up = UpAxis::y;
  y.position = {z.position.x, z.position.z, -z.position.y};
  y.view =
      z.view * glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, -1, 0, 0), glm::vec4(0, 0, 0, 1));
  HostPass pass(stage.gl,
                "WelkinFront f = welkinFront(ray * 5000.0); answer = vec4(f.light + welkinLight(ray * "
                "5000.0).sun * 0.1, f.clouds);");
  View a, b;
  stage.draw(a, z);
  const Image expected = pass.draw(*stage.sky, a, z);
  const glm::dvec3 sunZ = stage.sky->outputs(a).toSun;
  stage.draw(b, y);
  EXPECT_GT(displayedPsnr(pass.draw(*stage.sky, b, y), expected), 60.0);
  const glm::dvec3 sunY = stage.sky->outputs(b).toSun;
  EXPECT_EQ(sunY, glm::dvec3(sunZ.x, sunZ.z, -sunZ.y));
}

TEST(Outputs, NameTheViewsTextures) {
  Stage stage(kWidth, kHeight);
  Scene scene = cumulus();
  scene.quality.historyScale = 2;
  scene.quality.interleave = 2;
  stage.sky->setScene(scene);
  const Frame frame = stage.frame(scene);
  View view, other;
  EXPECT_THROW(stage.sky->outputs(view), Error) << "nothing has been drawn";
  stage.draw(view, frame);
  const Outputs o = stage.sky->outputs(view);
  EXPECT_EQ(o.clouds.width, kWidth / 2);
  EXPECT_EQ(o.clouds.height, kHeight / 2);
  EXPECT_EQ(o.clouds.depth, 0);
  EXPECT_EQ(o.cloudDepth.width, kWidth / 4);
  EXPECT_GT(o.sunDepth.depth, 0);
  EXPECT_NEAR(glm::length(o.toSun), 1.0, 1e-6);
  EXPECT_GT(o.sunIrradiance.y, 20.0f);
  EXPECT_LT(o.sunIrradiance.y, 128.0f);
  EXPECT_GT(o.skyIrradiance.z, 5.0f);
  EXPECT_EQ(o.historyShift, glm::vec2(0.0f));
  // A turn to the right by a quarter of the history's pixels moves the picture to the left.
  Scene turned = scene;
  const float pixel = 2.0f * std::tan(0.5f * scene.camera.fov) / static_cast<float>(kWidth / 2);
  turned.camera.heading += std::atan(0.25f * pixel);
  stage.draw(view, stage.frame(turned));
  const Outputs later = stage.sky->outputs(view);
  EXPECT_NEAR(later.historyShift.x * static_cast<float>(kWidth / 2), -0.25f, 0.01f);
  stage.draw(other, frame);
  EXPECT_THROW(stage.sky->outputs(view), Error) << "another view's turn";
  stage.sky->prepare(view, frame);
  EXPECT_EQ(stage.sky->outputs(view).clouds.name, later.clouds.name);
  stage.sky->setScene(scene);
  EXPECT_THROW(stage.sky->outputs(view), Error) << "a new scene";
}

TEST(HostBinding, RefusesAProgramWithoutTheInclude) {
  Stage stage(kWidth, kHeight);
  const Scene scene = cumulus();
  stage.draw(scene);
  const gl::Program plain(stage.gl, "plain", "", "out vec4 o;\nvoid main() { o = vec4(1.0); }\n",
                          [](std::string_view) { return std::string_view(); });
  EXPECT_THROW(stage.sky->bindHost(stage.view, plain.id(), {}), Error);
}

TEST(HostBinding, RefusesCloudsThatHaveTheSkyInThem) {
  Stage stage(kWidth, kHeight);
  const Scene scene = cumulus();
  stage.sky->setScene(scene);
  const HostPass clouds(stage.gl, kFrontAtDistance), light(stage.gl, "answer = vec4(welkinLight(ray).sun, 1.0);");
  Frame frame = stage.frame(scene);
  View view;
  stage.draw(view, frame);
  EXPECT_THROW(stage.sky->bindHost(view, clouds.program(), {}), Error);
  EXPECT_NO_THROW(stage.sky->bindHost(view, light.program(), {}));
  frame.background = Background::host;
  stage.draw(view, frame);
  EXPECT_NO_THROW(stage.sky->bindHost(view, clouds.program(), {}));
}

TEST(HostBinding, ServesVertexShadersToo) {
  for (const gl::ContextKind kind : {gl::ContextKind::desktop, gl::ContextKind::es}) {
    Stage stage(kWidth, kHeight, kind);
    const Scene scene = cumulus();
    stage.draw(scene);
    const gl::Program lit(
        stage.gl, "lit vertices", "", "in vec3 vLight;\nout vec4 o;\nvoid main() { o = vec4(vLight, 1.0); }\n",
        [](std::string_view) { return std::string_view(); },
        Renderer::hostShader() +
            "out vec3 vLight;\nvoid main() { gl_Position = vec4(0.0); vLight = "
            "welkinLight(vec3(float(gl_VertexID))).sun; }\n");
    EXPECT_NO_THROW(stage.sky->bindHost(stage.view, lit.id(), {}));
  }
}

// Two eyes 3 km apart and at two heights, turn by turn, share tables and volume of light. What the volume knows of
// light without direction depends a little on what it held before.
TEST(Views, AtTwoPlacesLookAsEachAlone) {
  Scene scene = cumulus();
  const auto frames = [&](Stage& stage, int which) {
    Scene there = scene;
    if (which == 1) there.camera.position = {3000.0, 500.0, 900.0}, there.camera.heading = 2.0f;
    return stage.frame(there);
  };
  Image alone[2], together[2];
  for (int which = 0; which < 2; ++which) {
    Stage stage(kWidth, kHeight);
    stage.sky->setScene(scene);
    View view;
    for (int i = 0; i < 3; ++i) alone[which] = stage.draw(view, frames(stage, which));
  }
  Stage stage(kWidth, kHeight);
  stage.sky->setScene(scene);
  View views[2];
  for (int i = 0; i < 3; ++i)
    for (int which = 0; which < 2; ++which) together[which] = stage.draw(views[which], frames(stage, which));
  for (int which = 0; which < 2; ++which) {
    const double same = displayedPsnr(together[which], alone[which]);
    std::printf("view %d: %.1f dB\n", which, same);
    EXPECT_GT(same, 34.0);
  }
}

// A host's origin may stand anywhere: the wind has carried the same clouds there.
TEST(OriginShift, ChangesNothing) {
  Scene scene = cumulus();
  scene.layers[0].cloud.detailDrift = 1.0f;
  scene.layers[0].cloud.updraft = 0.0f;
  scene.wind = {128.0f, 4.7123890f};
  // On a stage of its own: a volume of light remembers.
  const auto shot = [&](double shift, double time, Image& include) {
    Stage stage(kWidth, kHeight);
    HostPass pass(stage.gl,
                  "WelkinFront f = welkinFront(normalize(ray) * 6000.0); answer = vec4(f.light + "
                  "vec3(welkinSunShare(ray * 1000.0)), 1.0);");
    stage.sky->setScene(scene);
    Frame frame = stage.frame(scene);
    frame.background = Background::host;
    frame.origin = driftOffset({scene.wind.speed, scene.wind.from, shift / scene.wind.speed});
    frame.time = time;
    View view;
    const Image picture = stage.draw(view, frame);
    include = pass.draw(*stage.sky, view, frame);
    return picture;
  };
  Image include, includeHere;
  const Image here = shot(0.0, 0.0, includeHere);
  for (const double shift : {4096.0, 1e6}) {
    const double time = shift / scene.wind.speed;
    EXPECT_GT(displayedPsnr(shot(shift, time, include), here), 60.0) << shift;
    EXPECT_GT(displayedPsnr(include, includeHere), 60.0) << shift;
    EXPECT_LT(displayedPsnr(shot(shift, 0.0, include), here), 30.0) << "negative control: other clouds";
  }
}

// What the origin gains the positions lose: history and clouds stay where they are. 3 km on, up leans by 0.03 deg.
TEST(OriginShift, KeepsTheHistory) {
  Stage stage(kWidth, kHeight);
  Scene scene = cumulus();
  scene.quality.interleave = 4;
  stage.sky->setScene(scene);
  Frame frame = stage.frame(scene);
  View moved, still;
  for (int i = 0; i < 16; ++i) stage.draw(moved, frame), stage.draw(still, frame);
  const Image expected = stage.draw(still, frame);
  frame.position.x -= 3000.0;
  frame.position.z -= 0.7;  // as high above the sphere
  frame.origin.x += 3000.0;
  EXPECT_GT(displayedPsnr(stage.draw(moved, frame), expected), 35.0);
}

}  // namespace
}  // namespace welkin::realtime::test
