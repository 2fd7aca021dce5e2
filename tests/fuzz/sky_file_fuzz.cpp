// 100,000 mutated sky files in one process: each is read, or refused with file, line and column. Deterministic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/fuzz/mutation.hpp"
#include "tests/scene/random_scene.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/sky_file.hpp"

namespace welkin {
namespace {

#ifdef __SANITIZE_THREAD__
constexpr int kSkies = 10000;  // it is slow, and there is one thread
#else
constexpr int kSkies = 100000;
#endif

using test::below;

constexpr std::string_view kTokens[] = {"[",
                                        "]",
                                        "[[",
                                        "]]",
                                        "{",
                                        "}",
                                        "=",
                                        ".",
                                        ",",
                                        "\"",
                                        "'",
                                        "\"\"\"",
                                        "'''",
                                        "\\",
                                        "#",
                                        "\n",
                                        "\r\n",
                                        "\t",
                                        std::string_view("\0", 1),
                                        "\xff",
                                        "\xef\xbb\xbf",
                                        "nan",
                                        "-inf",
                                        "1e999",
                                        "-0",
                                        "0x7fffffffffffffff",
                                        "9223372036854775808",
                                        "1_000",
                                        "1979-05-27T07:32:00Z",
                                        "true",
                                        "[[layer]]\n",
                                        "[[sheet]]\n",
                                        "[layer.weather]\n",
                                        "[quality]\n",
                                        "layer = []\n",
                                        "format = 1\n",
                                        "[sun]\n",
                                        "coverage",
                                        "preset = \"ultra\"\n",
                                        "map = \"x.png\"\n",
                                        "[layer.0]\n",
                                        "[[keyframe]]\n",
                                        "time = 5\n",
                                        "sun.elevation = 3\n",
                                        "\\u0000",
                                        "\\U00110000"};

void sayElsewhere(std::string& text, std::size_t at, test::Random& random) {
  const std::string piece = text.substr(at, below(random, 80));
  text.insert(below(random, text.size()), piece);
}
void moveLine(std::string& text, std::size_t at, test::Random& random) {
  const std::size_t a = text.find('\n', at), b = text.find('\n', below(random, text.size()));
  if (a == std::string::npos || b == std::string::npos || a >= b) return;
  const std::string line = text.substr(a, text.find('\n', a + 1) - a);
  text.erase(a, line.size());
  text.insert(std::min(b, text.size()), line);
}
void anotherNumber(std::string& text, std::size_t at, test::Random& random) {
  const std::size_t digit = text.find_first_of("0123456789", at);
  if (digit != std::string::npos) text.replace(digit, 1, std::to_string(random()));
}
void nest(std::string& text, std::size_t at, test::Random& random) {
  static constexpr std::array<const char*, 4> kOpen{"[", "{a=", "a.", "[["};
  const char* open = kOpen[below(random, kOpen.size())];
  std::string deep;
  for (std::size_t i = below(random, 600); i > 0; --i) deep += open;
  text.insert(at, deep);
}
void remark(std::string& text, std::size_t at, test::Random&) {
  text.insert(std::min(text.find('\n', at), text.size()), " # remark");
}
const test::Mutation kSkyMutations[] = {test::piece(kTokens), sayElsewhere, moveLine, test::anotherDigit,
                                        anotherNumber,        nest,         remark};

TEST(SkyFileFuzz, EveryMutationIsReadOrRefusedWithItsPlace) {
  std::vector<std::string> seeds;
  for (unsigned i = 0; i < 40; ++i) seeds.push_back(writeSky(test::randomAnimation(i, 0.1)));
  test::Random random(2024);
  int read = 0;
  for (int i = 0; i < kSkies; ++i) {
    std::string text = seeds[below(random, seeds.size())];
    for (std::size_t k = 1 + (random() % 3 == 0 ? below(random, 4) : 0); k > 0; --k)
      test::mutate(text, random, kSkyMutations);
    try {
      Scene scene = parseSky(text, "f");
      ++read;
      // What was read lies in range and can be written and read again.
      ASSERT_TRUE(i % 10 != 0 || sameScene(scene, parseSky(writeSky(scene), "f"))) << text;
      for (const Section& s : sectionsOf(scene))
        for (const Field& f : s.fields)
          if (const FieldValue value = f.get(s.object); std::holds_alternative<double>(value)) {
            ASSERT_TRUE(std::isfinite(std::get<double>(value))) << text;
          }
    } catch (const Error& e) {
      ASSERT_EQ(e.kind(), ErrorKind::badInput) << text;
      const std::string& where = e.where();
      std::size_t line = 0, column = 0;
      ASSERT_EQ(std::sscanf(where.c_str(), "f:%zu:%zu", &line, &column), 2) << where << "\n" << text;
      ASSERT_GE(line, 1u);
      ASSERT_GE(column, 1u);
      ASSERT_LE(line, 1u + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'))) << e.what() << text;
    }
  }
  // Neither outcome may be rare, or the mutations test nothing.
  EXPECT_GT(read, kSkies / 10);
  EXPECT_LT(read, kSkies * 9 / 10);
}

}  // namespace
}  // namespace welkin
