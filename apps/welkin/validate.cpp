// welkin validate: the solver of `welkin flux` held against published numbers.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/welkin/command.hpp"
#include "welkin/base/error.hpp"
#include "welkin/trace/validation.hpp"

namespace welkin::app {

namespace {

using Json = nlohmann::ordered_json;

Json describe(const std::vector<ValidationRow>& rows) {
  Json all = Json::array();
  for (const ValidationRow& r : rows) {
    Json row{{"section", r.section}, {"name", r.name},     {"ours", r.ours.mean}, {"se", r.ours.se},
             {"theirs", r.theirs},   {"source", r.source}, {"gate", r.gate},      {"passes", r.passes()}};
    if (r.ours.se > 0.0) row["difference_in_se"] = r.differenceInSe();
    all.push_back(std::move(row));
  }
  return {{"passes", std::ranges::all_of(rows, &ValidationRow::passes)}, {"rows", std::move(all)}};
}

void print(const std::vector<ValidationRow>& rows) {
  std::string section;
  for (const ValidationRow& r : rows) {
    if (r.section != section)
      fmt::print("{}{:<48} {:>11} {:>9} {:>11} {:>6} {:>9}\n", section.empty() ? "" : "\n", r.section, "ours", "+-",
                 "theirs", "in se", "gate");
    section = r.section;
    const bool sampled = r.ours.se > 0.0;
    fmt::print("{:<48} {:>11.7g} {:>9} {:>11.7g} {:>6} {:>9.2g} {}\n", r.name, r.ours.mean,
               sampled ? fmt::format("{:.2g}", r.ours.se) : "", r.theirs,
               sampled ? fmt::format("{:+.1f}", r.differenceInSe()) : "", r.gate, r.passes() ? "" : "  FAILS");
  }
  const auto failing = std::ranges::count_if(rows, [](const ValidationRow& r) { return !r.passes(); });
  fmt::print("\n{} of {} rows pass.\n", rows.size() - static_cast<std::size_t>(failing), rows.size());
}

}  // namespace

void addValidate(CLI::App& app) {
  auto* command = app.add_subcommand("validate", "the solver of `flux` held against published numbers");
  const auto json = addJsonFlag(*command);
  auto quick = std::make_shared<bool>(false);
  command->add_flag("--quick", *quick, "a twentieth of the photons, so wider standard errors");
  command->callback([json, quick] {
    ProgressDisplay display("validating", *json ? ProgressStyle::quiet : ProgressStyle::automatic);
    const std::vector<ValidationRow> rows =
        validate({.effort = *quick ? ValidationEffort::quick : ValidationEffort::full}, display.callback());
    if (*json)
      fmt::print("{}\n", describe(rows).dump(2));
    else
      print(rows);
    if (!std::ranges::all_of(rows, &ValidationRow::passes))
      throw Error(ErrorKind::failed, "", "a row is outside its gate");
  });
}

}  // namespace welkin::app
