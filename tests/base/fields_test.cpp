#include "welkin/base/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace welkin {
enum class Colour { red, green };
template <>
struct ChoiceNames<Colour> {
  static constexpr std::array<std::string_view, 2> names{"red", "green"};
};
struct Sample {
  float angle = 0.5f;
  double length = 3;
  int count = 2;
  bool on = true;
  Colour colour = Colour::green;
  std::string path = "a";
  glm::vec3 albedo{0.1f, 0.2f, 0.3f};
};
template <>
struct FieldTable<Sample> {
  static auto make() {
    return fieldRows(field<&Sample::angle, kDegrees>("angle", {0, 90}, {0, 45}, "an angle"),
                     field<&Sample::length, kMetres>("length", {0, 1e6}, {}, "a length"),
                     field<&Sample::count>("count", {1, 8}, {}, "a count"), field<&Sample::on>("on", "a switch"),
                     field<&Sample::colour>("colour", "a choice"), field<&Sample::path>("path", "a file"),
                     field<&Sample::albedo>("albedo", {0, 1}, {}, "a colour"));
  }
};

namespace {

TEST(Fields, CountsMembersOfEveryKind) { EXPECT_EQ(detail::memberCount<Sample>(), 7u); }

TEST(Fields, UnitsConvertBothWays) {
  const Field& angle = fieldsOf<Sample>()[0];
  Sample s;
  FieldValue v = 30.0;
  EXPECT_EQ(checkField(angle, v), "");
  angle.set(&s, v);
  EXPECT_NEAR(s.angle, M_PI / 6, 1e-6);
  EXPECT_NEAR(std::get<double>(angle.get(&s)), 30.0, 1e-5);
}

TEST(Fields, EveryKindRoundTrips) {
  Sample s;
  for (const Field& f : fieldsOf<Sample>()) {
    FieldValue v = f.get(&s);
    EXPECT_EQ(checkField(f, v), "") << f.name;
    Sample other;
    f.set(&other, v);
    EXPECT_EQ(f.get(&other), v) << f.name;
  }
}

TEST(Fields, RefusesWrongKindRangeAndChoice) {
  const auto fields = fieldsOf<Sample>();
  FieldValue tooLarge = 91.0, notANumber = std::nan(""), text = std::string("x"), fraction = 1.5;
  EXPECT_NE(checkField(fields[0], tooLarge).find("outside 0 to 90 deg"), std::string::npos);
  EXPECT_NE(checkField(fields[0], notANumber), "");
  EXPECT_NE(checkField(fields[0], text), "");
  EXPECT_NE(checkField(fields[2], fraction), "");
  EXPECT_NE(checkField(fields[4], text).find("red"), std::string::npos);
  FieldValue whole = std::int64_t{12};
  EXPECT_EQ(checkField(fields[0], whole), "") << "a whole number may stand for a real one";
}

TEST(Fields, SuggestsTheNearestName) {
  const std::vector<std::string> names{"coverage", "base", "thickness"};
  EXPECT_EQ(nearestName("coverge", names), "coverage");
  EXPECT_EQ(nearestName("zzzzzzzz", names), "");
}

}  // namespace
}  // namespace welkin
