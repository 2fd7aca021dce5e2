#include "welkin/gl/source.hpp"

#include <gtest/gtest.h>

#include <map>

#include "welkin/base/error.hpp"

namespace welkin::gl {
namespace {

SourceResolver files(std::map<std::string, std::string, std::less<>> texts) {
  return [texts = std::move(texts)](std::string_view path) -> std::string_view {
    static thread_local std::string kept;
    const auto found = texts.find(path);
    kept = found == texts.end() ? "" : found->second;
    return kept;
  };
}

TEST(Source, ExpandsEachFileOnceAndKeepsLines) {
  const ExpandedSource out = expandIncludes("a\n#include \"x\"\n#include \"y\"\nb\n", "main",
                                            files({{"x", "in x\n"}, {"y", "#include \"x\"\nin y\n"}}));
  EXPECT_EQ(out.files, (std::vector<std::string>{"main", "x", "y"}));
  EXPECT_EQ(out.text, "a\nin x\nin y\nb\n");
  EXPECT_EQ(out.place(2), "x:1");
  EXPECT_EQ(out.place(3), "y:2");
  EXPECT_EQ(out.place(4), "main:4");
}

TEST(Source, NamesTheMissingFileAndWhoAskedForIt) {
  try {
    expandIncludes("\n#include \"nowhere.glsl\"\n", "main.frag", files({}));
    FAIL() << "accepted";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "main.frag:2: no shader source is called 'nowhere.glsl'");
  }
}

}  // namespace
}  // namespace welkin::gl
