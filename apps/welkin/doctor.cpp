// welkin doctor: what this machine offers, and what is missing.
#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <hwy/detect_targets.h>
#include <hwy/targets.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "apps/welkin/command.hpp"
#include "welkin/base/error.hpp"
#include "welkin/gl/api.hpp"
#include "welkin/gl/context.hpp"
#include "welkin/io/exr.hpp"
#include "welkin/io/png.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin::app {

namespace {

using Json = nlohmann::ordered_json;

// The driver of one kind of context, or why there is none.
Json describeOpenGl(gl::ContextKind kind) {
  try {
    const gl::Context context(kind);
    const gl::Api api = gl::loadApi(context.loader());
    const auto text = [&](GLenum name) {
      const auto* bytes = api.GetString(name);
      return std::string(bytes ? reinterpret_cast<const char*>(bytes) : "");
    };
    GLint side = 0, volume = 0;
    api.GetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    api.GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &volume);
    return {{"available", true},           {"vendor", text(GL_VENDOR)}, {"renderer", api.driver()},
            {"version", text(GL_VERSION)}, {"max_texture_size", side},  {"max_3d_texture_size", volume},
            {"software", api.software()}};
  } catch (const Error& e) {
    return {{"available", false}, {"reason", e.what()}};
  }
}

Json describe() {
  Json simd = Json::array();
  for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1)
    simd.push_back(hwy::TargetName(rest & -rest));
  Json report{{"welkin", WELKIN_VERSION},
              {"opengl", describeOpenGl(gl::ContextKind::desktop)},
              {"opengl_es", describeOpenGl(gl::ContextKind::es)},
              {"cpu", {{"threads", std::thread::hardware_concurrency()}, {"simd", simd}}},
              {"libraries",
               {{"OpenEXR", exrVersion()},
                {"libpng", pngVersion()},
                {"toml++", tomlVersion()},
                {"CLI11", CLI11_VERSION},
                {"OpenVDB", hasOpenVdb() ? openVdbVersion() : "none"}}}};
  const std::string presets = presetFolder();
  report["presets"] = presets;
  Json missing = Json::array();
  if (!report["opengl"]["available"] && !report["opengl_es"]["available"])
    missing.push_back(
        "OpenGL 3.3 or OpenGL ES 3.0 without a display; on Debian: apt-get install libegl1 libgl1-mesa-dri");
  if (presets.empty()) missing.push_back("the folder of presets; WELKIN_PRESETS may name it");
  if (!hasOpenVdb())
    missing.push_back("OpenVDB, for .vdb files; on Debian: apt-get install libopenvdb-dev, then build again");
  report["missing"] = missing;
  return report;
}

void printText(const Json& report) {
  fmt::print("welkin      {}\n", report["welkin"].get<std::string>());
  for (const auto& [key, label] : {std::pair("opengl", "OpenGL"), std::pair("opengl_es", "OpenGL ES")}) {
    const Json& gl = report[key];
    if (gl["available"])
      fmt::print("{:<11} {}, {}{}\n", label, gl["version"].get<std::string>(), gl["renderer"].get<std::string>(),
                 gl["software"] ? " (software)" : "");
    else
      fmt::print("{:<11} none: {}\n", label, gl["reason"].get<std::string>());
  }
  fmt::print("CPU         {} threads;", report["cpu"]["threads"].get<unsigned>());
  for (const Json& target : report["cpu"]["simd"]) fmt::print(" {}", target.get<std::string>());
  fmt::print("\nlibraries  ");
  for (const auto& [name, version] : report["libraries"].items())
    fmt::print(" {} {}", name, version.get<std::string>());
  fmt::print("\npresets     {}\n", report["presets"].get<std::string>());
  if (report["missing"].empty()) fmt::print("Nothing is missing.\n");
  for (const Json& what : report["missing"]) fmt::print("missing: {}\n", what.get<std::string>());
}

}  // namespace

void addDoctor(CLI::App& app) {
  auto* command = app.add_subcommand("doctor", "what this machine offers, and what is missing");
  const auto json = addJsonFlag(*command);
  command->callback([json] {
    const Json report = describe();
    if (*json)
      fmt::print("{}\n", report.dump(2));
    else
      printText(report);
    if (!report["opengl"]["available"] && !report["opengl_es"]["available"])
      throw Error(ErrorKind::noOpenGl, "", "there is no OpenGL to render with");
  });
}

}  // namespace welkin::app
