#pragma once
// One text, three readings: a case is a law function's call, evaluated in GLSL, scalar C++ and SIMD C++ at the same
// points.
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "welkin/base/sampler.hpp"

namespace welkin::parity {

struct Case {
  const char* name;
  const char* body;         // GLSL text of `Vec4 f(Vec4 a, Vec4 b, Sampler2 s2, Sampler3 s3, Sampler2Array sA)`
  double tolerance, scale;  // |x - y| <= tolerance max(|x|, scale)
  glm::vec4 lowA, highA, lowB, highB;  // inputs are uniform in these boxes
  glm::vec4 (*scalar)(const glm::vec4& a, const glm::vec4& b, const TextureView& s2, const TextureView& s3,
                      const TextureView& sA);
};

struct Suite {
  std::vector<std::string> files;  // law files, in the order that they are read
  std::string prelude;             // law text before the cases
  std::vector<Case> cases;
};

// All cases of the house, in the order of cases.inc.
const Suite& suite();

// Evaluates case `index` with the SIMD reading of the current target; `count` is a multiple of simdLanes().
void evaluateSimd(std::size_t index, const glm::vec4* a, const glm::vec4* b, const TextureView& s2,
                  const TextureView& s3, const TextureView& sA, glm::vec4* out, std::size_t count);
std::size_t simdLanes();

}  // namespace welkin::parity
