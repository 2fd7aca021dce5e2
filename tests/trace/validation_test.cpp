// The suite of published numbers passes, and sees a wrong phase function. The numbers: welkin/trace/published.hpp.
#include "welkin/trace/validation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

TEST(Validation, EveryRowPasses) {
  const std::vector<ValidationRow> rows = validate({.effort = ValidationEffort::quick});
  EXPECT_GE(rows.size(), 116u);
  for (const ValidationRow& r : rows)
    EXPECT_TRUE(r.passes()) << r.section << ", " << r.name << ": " << r.ours.mean << " +- " << r.ours.se << ", not "
                            << r.theirs;
}

// Negative control: 3 % less asymmetry.
TEST(Validation, SeesAWrongPhaseFunction) {
  const auto wrong = [](double g) { return PhaseTable::henyeyGreenstein(0.97 * g); };
  const std::vector<ValidationRow> rows = validate({.effort = ValidationEffort::quick, .henyeyGreenstein = wrong});
  for (const char* section : {"phase functions", "slabs", "I3RC case 1"})
    EXPECT_TRUE(std::ranges::any_of(rows, [&](const ValidationRow& r) { return r.section == section && !r.passes(); }))
        << section;
}

TEST(Validation, AValueThatIsNoNumberFails) {
  ValidationRow row{.section = "", .name = "", .source = "", .ours = {std::nan(""), 1.0}, .theirs = 1.0, .gate = 1.0};
  EXPECT_FALSE(row.passes());
}

}  // namespace
}  // namespace welkin
