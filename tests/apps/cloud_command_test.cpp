// welkin cloud: the list, tables that a sky file takes, previews.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/command.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin {
namespace {

using test::Outcome;
using test::run;

std::string folder() {
  const std::string path = testing::TempDir() + "welkin_cloud";
  std::filesystem::create_directories(path);
  return path;
}

TEST(CloudCommand, ListsEverySpecies) {
  const auto list = nlohmann::json::parse(run("cloud --json").out);
  ASSERT_EQ(list.size(), ChoiceNames<HeroSpecies>::names.size());
  const std::string text = run("cloud").out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i]["species"], ChoiceNames<HeroSpecies>::names[i]);
    EXPECT_GT(list[i]["width"], 0.0);
    EXPECT_NE(text.find(ChoiceNames<HeroSpecies>::names[i]), std::string::npos);
  }
}

// What it prints makes, in a sky file, the cloud that was asked for.
TEST(CloudCommand, PrintsTablesOfASkyFile) {
  for (const std::string_view name : ChoiceNames<HeroSpecies>::names) {
    const Outcome o = run("cloud " + std::string(name) + " --set seed=4 --set form.anvil=8000");
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    const Scene found = parseSky("format = 1\n" + o.out, "printed");
    Scene expected;
    expected.layers.clear();
    expected.heroes.resize(1);
    setField(expected, "hero.species=" + std::string(name));
    setField(expected, "hero.seed=4");
    setField(expected, "hero.form.anvil=8000");
    EXPECT_TRUE(sameScene(found, expected)) << name;
  }
  EXPECT_EQ(run("cloud congestus").out.find("\n[hero.classic]"), std::string::npos);
  EXPECT_NE(run("cloud congestus --set form.shape=classic").out.find("\n[hero.classic]"), std::string::npos);
}

TEST(CloudCommand, WrongUseSaysWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"cloud cumulus", "is \"cumulus\", but must be one of"},
      {"cloud congestus --set form.widht=3", "did you mean"},
      {"cloud congestus --set form.width=1", "outside"},
      {"cloud --preview a.png", "name a species first"},
      {"cloud congestus --volume", "name its file with --preview"},
      {"cloud congestus --preview a.exr", "name it .png"},
      {"cloud congestus --preview a.jpg", ".png"},
      {"cloud congestus --json", "--json is for the list"},
      {"cloud congestus --preview a.png --size 0x4", "write WIDTHxHEIGHT"}};
  for (const auto& [arguments, message] : cases) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(o.out, "") << arguments;
    EXPECT_NE(o.err.find(message), std::string::npos) << arguments << ": " << o.err;
  }
  EXPECT_EQ(run("cloud congestus --preview /no/such/folder/a.png").code, 1);
}

// Clear at the sides, dense in the middle, and shapes that differ by species.
TEST(CloudCommand, DrawsASection) {
  std::vector<Image> pictures;
  for (const char* species : {"congestus", "lenticularis"}) {
    const std::string file = folder() + "/" + species + ".png";
    ASSERT_EQ(run(std::string("cloud ") + species + " --size 96x72 --preview " + file).code, 0);
    pictures.push_back(loadPng(file));
    const Image& p = pictures.back();
    ASSERT_EQ(p.width, 96);
    ASSERT_EQ(p.height, 72);
    ASSERT_EQ(p.channels, 1);
    EXPECT_EQ(*p.at(0, 0), 0.0f);
    EXPECT_GT(*std::max_element(p.pixels.begin(), p.pixels.end()), 0.8f);
  }
  const auto cloudy = [](const Image& p) {
    return std::count_if(p.pixels.begin(), p.pixels.end(), [](float v) { return v > 0.5f; });
  };
  EXPECT_GT(cloudy(pictures[0]), 96 * 72 / 10);
  EXPECT_LT(cloudy(pictures[1]), cloudy(pictures[0]));  // four flat plates
}

// A bright cloud before a darker sky.
TEST(CloudCommand, TracesTheVolume) {
  const std::string file = folder() + "/volume.png";
  const Outcome o = run("cloud mediocris --volume --samples 8 --size 64x48 --preview " + file);
  ASSERT_EQ(o.code, 0) << o.err;
  const Image p = loadPng(file);
  ASSERT_EQ(p.channels, 3);
  const auto red = [&](int x, int y) { return p.at(x, y)[0]; };
  EXPECT_GT(red(32, 24), red(2, 2) + 0.1f);
}

}  // namespace
}  // namespace welkin
