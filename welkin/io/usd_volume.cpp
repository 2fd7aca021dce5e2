#include "welkin/io/usd_volume.hpp"

#include <fmt/format.h>

namespace welkin {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out + '"';
}

// "@./name@"; three signs allow one inside.
std::string asset(const std::string& file) {
  const char* sign = file.find('@') == std::string::npos ? "@" : "@@@";
  return fmt::format("{}./{}{}", sign, file, sign);
}

}  // namespace

std::string usdStage(const UsdStage& stage, std::span<const UsdVolume> volumes) {
  std::string out = fmt::format(
      "#usda 1.0\n(\n    doc = {}\n    defaultPrim = \"Clouds\"\n    metersPerUnit = {}\n    upAxis = \"{}\"\n",
      quoted(stage.title), stage.metresPerUnit, stage.upAxis);
  const std::size_t frames = volumes.empty() ? 0 : volumes.front().files.size();
  if (frames > 1)
    out += fmt::format("    startTimeCode = {}\n    endTimeCode = {}\n    timeCodesPerSecond = {}\n", stage.firstFrame,
                       stage.firstFrame + static_cast<int>(frames) - 1, stage.framesPerSecond);
  out += ")\n\ndef Xform \"Clouds\"\n{\n";
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const UsdVolume& v = volumes[i];
    out += fmt::format(
        "    def Volume \"Volume_{0}\"\n    {{\n        float3[] extent = [({1}, {2}, {3}), ({4}, {5}, {6})]\n"
        "        rel field:density = </Clouds/Volume_{0}/density>\n\n        def OpenVDBAsset \"density\"\n        {{\n"
        "            token fieldName = \"density\"\n            token fieldClass = \"fogVolume\"\n",
        i, v.low.x, v.low.y, v.low.z, v.high.x, v.high.y, v.high.z);
    if (v.files.size() == 1) {
      out += fmt::format("            asset filePath = {}\n", asset(v.files.front()));
    } else {
      out += "            asset filePath.timeSamples = {\n";
      for (std::size_t f = 0; f < v.files.size(); ++f)
        out += fmt::format("                {}: {},\n", stage.firstFrame + static_cast<int>(f), asset(v.files[f]));
      out += "            }\n";
    }
    out += "        }\n    }\n";
  }
  return out + "}\n";
}

}  // namespace welkin
