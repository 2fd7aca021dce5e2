#include <fmt/format.h>

#include <cstdio>
#include <span>

#include "apps/welkin/command.hpp"
#include "welkin/base/error.hpp"

namespace welkin::app {

namespace {

std::vector<std::string> namesOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : command.get_subcommands({}))
    if (!sub->get_group().empty()) names.push_back(sub->get_name());
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// The parser's message, and the nearest name when a word was not expected.
std::string usageMessage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* used = &app;
  while (!used->get_subcommands().empty()) used = used->get_subcommands().front();
  const std::vector<std::string> extras = app.remaining(true);
  const bool unexpected = dynamic_cast<const CLI::ExtrasError*>(&error) || used == &app;
  if (!unexpected || extras.empty()) return error.what();
  const std::string word = extras.front().substr(0, extras.front().find('='));
  const std::string near = nearestName(word, namesOf(*used));
  return fmt::format("'{}' is not {}{}", word, word.starts_with('-') ? "an option" : "a command",
                     near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

int exitCodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::badInput:
      return kBadInput;
    case ErrorKind::noOpenGl:
      return kNoOpenGl;
    case ErrorKind::failed:
      break;
  }
  return kFailed;
}

int run(int argc, char** argv) {
  CLI::App app("Volumetric clouds and skies: one text file describes a sky, every output shows the same clouds.",
               "welkin");
  app.set_version_flag("--version", "welkin " WELKIN_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error&) { return std::string(); });
  addRender(app);
  addView(app);
  addFly(app);
  addHdri(app);
  addCompare(app);
  addPresets(app);
  addFields(app);
  addCheck(app);
  addInfo(app);
  addNoise(app);
  addWeather(app);
  addCloud(app);
  addVdb(app);
  addVideo(app);
  addFlux(app);
  addValidate(app);
  addDoctor(app);
  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0) throw Error(ErrorKind::failed, "standard output", "cannot be written");
    return kOk;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    fmt::print(stderr, "welkin: {}\n`welkin --help` shows how it is used.\n", usageMessage(app, e));
    return kUsage;
  } catch (const UsageError& e) {
    fmt::print(stderr, "welkin: {}\n", e.what());
    return kUsage;
  } catch (const Error& e) {
    fmt::print(stderr, "welkin: {}\n", e.what());
    return exitCodeOf(e.kind());
  } catch (const std::exception& e) {
    fmt::print(stderr, "welkin: {}\n", e.what());
    return kFailed;
  }
}

}  // namespace
}  // namespace welkin::app

int main(int argc, char** argv) { return welkin::app::run(argc, argv); }
