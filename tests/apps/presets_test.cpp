// Every preset is a sky that could be: base, top and optical depth of its genus, as `welkin info` measures them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/apps/command.hpp"

namespace welkin::test {
namespace {

using nlohmann::json;

struct Range {
  double least, most;
};
struct Plausible {
  Range base, top;     // m
  Range opticalDepth;  // vertical, mean over the cloudy columns
};

// Bases and tops: WMO, International Cloud Atlas (low below 2 km, middle 2 to 7 km, high above 5 km; nimbostratus grows
// from low to middle, cumulonimbus to the tropopause). Optical depths: what is measured of real clouds, cumulus 2 to
// 30, stratocumulus 5 to 30, altostratus 5 to 40, nimbostratus over 30, cumulonimbus over 100, cirrus and its relatives
// 0.03 to 3; stratus as stratocumulus from 2 and altocumulus as altostratus from 1, since thin ones are common. Stratus
// that stands on the ground is fog: 30 to 500 m deep, of visibilities of 50 to 1000 m.
const std::map<std::string, Plausible> kGenera = {{"cumulus", {{400, 2000}, {600, 6500}, {2, 30}}},
                                                  {"stratocumulus", {{400, 2000}, {600, 2500}, {5, 30}}},
                                                  {"stratus", {{0, 1200}, {100, 2000}, {2, 30}}},
                                                  {"fog", {{0, 0}, {30, 500}, {0.5, 20}}},
                                                  {"nimbostratus", {{100, 2500}, {3000, 7000}, {30, 200}}},
                                                  {"cumulonimbus", {{400, 2000}, {7000, 14000}, {100, 1000}}},
                                                  {"altocumulus", {{2000, 6000}, {2100, 7000}, {1, 40}}},
                                                  {"altostratus", {{2000, 6000}, {2500, 7000}, {5, 40}}},
                                                  {"cirrus", {{5000, 13000}, {5000, 13000}, {0.03, 3}}},
                                                  {"cirrocumulus", {{5000, 13000}, {5000, 13000}, {0.03, 3}}},
                                                  {"cirrostratus", {{5000, 13000}, {5000, 13000}, {0.03, 3}}}};

// A preset that departs for its look says so in a comment: "... by a factor of 2.5".
double statedFactor(const std::string& text) {
  std::smatch found;
  return std::regex_search(text, found, std::regex("by a factor of ([0-9]+\\.?[0-9]*)")) ? std::stod(found[1]) : 1.0;
}

void expectWithin(double value, const Range& range, double factor, const char* what) {
  EXPECT_GE(value, range.least / factor) << what;
  EXPECT_LE(value, range.most * factor) << what;
}

std::vector<std::filesystem::path> presets() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(WELKIN_SOURCE_DIR "/presets"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Presets, ArePhysicallyPlausible) {
  ASSERT_GE(presets().size(), 20u);
  for (const std::filesystem::path& file : presets()) {
    const Outcome o = run("info --json " + file.string());
    ASSERT_EQ(o.code, 0) << file << ": " << o.err;
    const json report = json::parse(o.out);
    const double factor = statedFactor(slurp(file));
    EXPECT_GT(report["layers"].size() + report["sheets"].size() + report["heroes"].size(), 0u) << file;
    for (const char* kind : {"layers", "sheets"})
      for (const json& row : report[kind]) {
        SCOPED_TRACE(file.filename().string() + ": " + row.dump());
        const bool fog = row["genus"] == "stratus" && row["base"] == 0.0;
        const auto genus = kGenera.find(fog ? "fog" : row["genus"].get<std::string>());
        ASSERT_NE(genus, kGenera.end());
        const double height = row.value("configured_height", 0.0);
        expectWithin(row.value("base", height), genus->second.base, 1.0, "base");
        expectWithin(row.value("top", height), genus->second.top, 1.0, "top");
        expectWithin(row["cloudy_optical_depth"], genus->second.opticalDepth, factor, "optical depth");
      }
  }
}

}  // namespace
}  // namespace welkin::test
