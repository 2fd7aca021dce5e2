// GLSL = scalar C++ = SIMD C++, for every case at 10^5 points.
#include "tests/parity/parity.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <map>
#include <random>

#include "welkin/gl/context.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/shader_sources.hpp"

namespace welkin::parity {
namespace {

constexpr int kSide = 320;
constexpr std::size_t kPoints = kSide * kSide;  // 102,400
using Points = std::vector<glm::vec4>;

std::vector<float> noiseTexels(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> texels(count);
  for (float& t : texels) t = static_cast<float>(random() >> 8) * 0x1p-24f;
  return texels;
}

// A stack of four: layers 0 and 1 hold cloud heights in metres in their first channel, 2 and 3 numbers in [0, 1].
std::vector<float> stackTexels() {
  std::vector<float> texels = noiseTexels(8 * 8 * 4 * 4, 3);
  for (std::size_t i = 0; i < texels.size() / 2; i += 4) texels[i] *= 1800.0f;
  return texels;
}

struct Inputs {
  std::vector<float> texels2 = noiseTexels(16 * 8 * 4, 1), texels3 = noiseTexels(8 * 8 * 8 * 4, 2),
                     texelsA = stackTexels();
  TextureView view2{texels2.data(), 16, 8, 1, 4}, view3{texels3.data(), 8, 8, 8, 4},
      viewA{texelsA.data(), 8, 8, 4, 4, Wrap::clamp, Wrap::clamp};
};
const Inputs& inputs() {
  static const Inputs kInputs;
  return kInputs;
}

Points randomPoints(const glm::vec4& low, const glm::vec4& high, unsigned seed) {
  std::mt19937 random(seed);
  Points points(kPoints);
  for (glm::vec4& p : points)
    for (int c = 0; c < 4; ++c) p[c] = low[c] + (high[c] - low[c]) * (static_cast<float>(random() >> 8) * 0x1p-24f);
  return points;
}

// Largest |x - y| / max(|x|, scale) and where it stands.
struct Difference {
  double worst = 0;
  std::size_t at = 0;
};
Difference compare(const Points& x, const Points& y, double scale) {
  Difference d;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < 4; ++c) {
      const double a = x[i][c], b = y[i][c];
      const double error = std::isfinite(a) && std::isfinite(b) ? std::abs(a - b) / std::max(std::abs(a), scale) : 1e30;
      if (error > d.worst) d = {error, i};
    }
  return d;
}

Points scalarResults(const Case& c, const Points& a, const Points& b) {
  Points out(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
    out[i] = c.scalar(a[i], b[i], inputs().view2, inputs().view3, inputs().viewA);
  return out;
}

class Parity : public testing::TestWithParam<std::size_t> {
 protected:
  const Case& theCase() const { return suite().cases[GetParam()]; }
  Points a() const { return randomPoints(theCase().lowA, theCase().highA, 11); }
  Points b() const { return randomPoints(theCase().lowB, theCase().highB, 12); }
};

TEST_P(Parity, EverySimdTargetAgreesWithScalar) {
  const Points pa = a(), pb = b(), expected = scalarResults(theCase(), pa, pb);
  std::size_t varied = 0;
  for (const glm::vec4& v : expected) varied += v != expected[0] ? 1 : 0;
  ASSERT_GT(varied, kPoints / 20) << "the case says nothing: its result hardly varies";
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    ASSERT_EQ(kPoints % simdLanes(), 0u);
    Points out(kPoints);
    evaluateSimd(GetParam(), pa.data(), pb.data(), inputs().view2, inputs().view3, inputs().viewA, out.data(), kPoints);
    const Difference d = compare(expected, out, theCase().scale);
    EXPECT_LE(d.worst, theCase().tolerance)
        << hwy::TargetName(target) << " at point " << d.at << ": scalar " << expected[d.at].x << " " << expected[d.at].y
        << " " << expected[d.at].z << " " << expected[d.at].w << ", SIMD " << out[d.at].x << " " << out[d.at].y << " "
        << out[d.at].z << " " << out[d.at].w;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

class Evaluator {
 public:
  explicit Evaluator(gl::ContextKind kind) : context_(kind), gl_(gl::loadApi(context_.loader())), framebuffer_(gl_) {
    vertices_ = gl::VertexArray(gl_);
    const Inputs& in = inputs();
    s2_ = gl::Texture(gl_, gl::Texture::Kind::plane, gl::kRgba32F, 16, 8, 0, gl::Filter::linear, gl::Addressing::repeat,
                      in.view2.texels);
    s3_ = gl::Texture(gl_, gl::Texture::Kind::volume, gl::kRgba32F, 8, 8, 8, gl::Filter::linear, gl::Addressing::repeat,
                      in.view3.texels);
    sA_ = gl::Texture(gl_, gl::Texture::Kind::array, gl::kRgba32F, 8, 8, 4, gl::Filter::linear, gl::Addressing::clamp,
                      in.viewA.texels);
    out_ = plane(nullptr);
  }

  Points evaluate(const Case& c, const Points& a, const Points& b) {
    std::string text;
    for (const std::string& file : suite().files) text += "#include \"" + file + "\"\n";
    text +=
        suite().prelude +
        "\nuniform sampler2D uA, uB, uS2;\nuniform sampler3D uS3;\nuniform sampler2DArray uSA;\nout vec4 oResult;\n" +
        "Vec4 evaluate(IN(Vec4) a, IN(Vec4) b, in sampler2D s2, in sampler3D s3, in sampler2DArray sA) " + c.body +
        "\nvoid main() {\n  ivec2 p = ivec2(gl_FragCoord.xy);\n"
        "  oResult = evaluate(texelFetch(uA, p, 0), texelFetch(uB, p, 0), uS2, uS3, uSA);\n}\n";
    const gl::Program program(gl_, c.name, "", text, realtime::shaderSource);
    const gl::Texture ta = plane(a.data()), tb = plane(b.data());
    const gl::Texture* targets[] = {&out_};
    framebuffer_.target(targets);
    gl_.UseProgram(program.id());
    const std::pair<const char*, const gl::Texture*> units[] = {
        {"uA", &ta}, {"uB", &tb}, {"uS2", &s2_}, {"uS3", &s3_}, {"uSA", &sA_}};
    for (int i = 0; i < 5; ++i) {
      gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
      gl_.BindTexture(units[i].second->target(), units[i].second->id());
      gl_.Uniform1i(program.uniform(units[i].first), i);
    }
    gl_.BindVertexArray(vertices_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    Points result(kPoints);
    gl_.ReadPixels(0, 0, kSide, kSide, GL_RGBA, GL_FLOAT, result.data());
    gl_.check("evaluating a law");
    return result;
  }

 private:
  gl::Texture plane(const void* texels) {
    return gl::Texture(gl_, gl::Texture::Kind::plane, gl::kRgba32F, kSide, kSide, 0, gl::Filter::nearest,
                       gl::Addressing::clamp, texels);
  }
  gl::Context context_;
  gl::Api gl_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray vertices_;
  gl::Texture s2_, s3_, sA_, out_;
};

TEST_P(Parity, GlslAgreesWithScalar) {
  const Points pa = a(), pb = b(), expected = scalarResults(theCase(), pa, pb);
  for (const gl::ContextKind kind : {gl::ContextKind::desktop, gl::ContextKind::es}) {
    Evaluator evaluator(kind);
    const Points out = evaluator.evaluate(theCase(), pa, pb);
    const Difference d = compare(expected, out, theCase().scale);
    EXPECT_LE(d.worst, theCase().tolerance)
        << (kind == gl::ContextKind::es ? "GLSL ES" : "GLSL") << " at point " << d.at << " a " << pa[d.at].x << " "
        << pa[d.at].y << " " << pa[d.at].z << " " << pa[d.at].w << ": scalar " << expected[d.at].x << " "
        << expected[d.at].y << " " << expected[d.at].z << " " << expected[d.at].w << ", GLSL " << out[d.at].x << " "
        << out[d.at].y << " " << out[d.at].z << " " << out[d.at].w;
  }
}

INSTANTIATE_TEST_SUITE_P(Law, Parity, testing::Range<std::size_t>(0, suite().cases.size()),
                         [](const auto& chosen) { return std::string(suite().cases[chosen.param].name); });

// A negative control: the comparison does see a difference of one part in 10^4.
TEST(ParityHarness, SeesASmallDifference) {
  const Points x(kPoints, glm::vec4(1.0f));
  Points y = x;
  y[77].z = 1.0001f;
  EXPECT_GT(compare(x, y, 1.0).worst, 5e-5);
  EXPECT_EQ(compare(x, y, 1.0).at, 77u);
}

TEST(ParityHarness, RunTimeDispatchPicksTheWidestTarget) {
  // Sanitizer builds leave targets out.
  const std::int64_t built = hwy::SupportedTargets() & ~static_cast<std::int64_t>(HWY_DISABLED_TARGETS);
  const std::int64_t best = built & -built;
  if (best & (HWY_AVX3 | HWY_AVX3_DL)) {
    EXPECT_EQ(simdLanes(), 16u);
  } else if (best & HWY_AVX2) {
    EXPECT_EQ(simdLanes(), 8u);
  } else {
    EXPECT_GE(simdLanes(), 4u);
  }
}

}  // namespace
}  // namespace welkin::parity
