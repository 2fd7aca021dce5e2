// The scalar readings of every case, and the list of cases.
#include "tests/parity/parity.hpp"
#include "tests/parity/readings.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#define LAW(...) __VA_ARGS__
#define CASE(name, tolerance, scale, lowA, highA, lowB, highB, ...)                                                  \
  [[maybe_unused]] static Vec4 case_##name([[maybe_unused]] const Vec4& a, [[maybe_unused]] const Vec4& b,           \
                                           [[maybe_unused]] const Sampler2& s2, [[maybe_unused]] const Sampler3& s3, \
                                           [[maybe_unused]] const Sampler2Array& sA) __VA_ARGS__
#include "tests/parity/cases.inc"
#undef CASE
#undef LAW
#include "welkin/base/law_end.inc"
}  // namespace welkin::law

namespace welkin::parity {

const Suite& suite() {
  using glm::vec4;
  static const Suite kSuite = [] {
    Suite s;
    s.files = {WELKIN_LAW_FILES};
    s.prelude =
#define LAW(...) #__VA_ARGS__ "\n"
#define CASE(...)
#include "tests/parity/cases.inc"
#undef CASE
#undef LAW
        "";
#define LAW(...)
#define CASE(name, tolerance, scale, lowA, highA, lowB, highB, ...) \
  s.cases.push_back({#name, #__VA_ARGS__, tolerance, scale, lowA, highA, lowB, highB, &law::case_##name});
#include "tests/parity/cases.inc"
#undef CASE
#undef LAW
    return s;
  }();
  return kSuite;
}

}  // namespace welkin::parity
