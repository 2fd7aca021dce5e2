#include "welkin/base/fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace welkin {

namespace {

std::string checkNumber(const Field& field, double value) {
  if (!std::isfinite(value)) return "is not a finite number";
  if (value < field.hard.low || value > field.hard.high) {
    const std::string unit = *field.unit.symbol ? fmt::format(" {}", field.unit.symbol) : "";
    if (std::isinf(field.hard.high))
      return fmt::format("is {:g}, but must be at least {:g}{}", value, field.hard.low, unit);
    if (std::isinf(field.hard.low))
      return fmt::format("is {:g}, but must be at most {:g}{}", value, field.hard.high, unit);
    return fmt::format("is {:g}, outside {:g} to {:g}{}", value, field.hard.low, field.hard.high, unit);
  }
  return "";
}

}  // namespace

std::string checkField(const Field& field, FieldValue& value) {
  if (field.kind == FieldKind::real && std::holds_alternative<std::int64_t>(value))
    value = static_cast<double>(std::get<std::int64_t>(value));
  switch (field.kind) {
    case FieldKind::real:
      if (!std::holds_alternative<double>(value)) return "must be a number";
      return checkNumber(field, std::get<double>(value));
    case FieldKind::integer:
      if (!std::holds_alternative<std::int64_t>(value)) return "must be a whole number";
      if (!field.allowed.empty() &&
          std::find(field.allowed.begin(), field.allowed.end(), std::get<std::int64_t>(value)) == field.allowed.end())
        return fmt::format("is {}, but must be one of {}", std::get<std::int64_t>(value),
                           fmt::join(field.allowed, ", "));
      return checkNumber(field, static_cast<double>(std::get<std::int64_t>(value)));
    case FieldKind::boolean:
      return std::holds_alternative<bool>(value) ? "" : "must be true or false";
    case FieldKind::text:
    case FieldKind::file:
      return std::holds_alternative<std::string>(value) ? "" : "must be a text in quotes";
    case FieldKind::vector: {
      if (!std::holds_alternative<std::array<double, 3>>(value)) return "must be three numbers, [x, y, z]";
      for (const double v : std::get<std::array<double, 3>>(value))
        if (std::string wrong = checkNumber(field, v); !wrong.empty()) return wrong;
      return "";
    }
    case FieldKind::choice: {
      if (!std::holds_alternative<std::string>(value))
        return fmt::format("must be one of \"{}\"", fmt::join(field.choices, "\", \""));
      const std::string& word = std::get<std::string>(value);
      if (std::find(field.choices.begin(), field.choices.end(), word) != field.choices.end()) return "";
      return fmt::format("is \"{}\", but must be one of \"{}\"", word, fmt::join(field.choices, "\", \""));
    }
  }
  return "";
}

std::string nearestName(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  std::size_t bestDistance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        const std::size_t replaced = diagonal + (word[i] == candidate[j] ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
      }
    }
    if (row.back() < bestDistance) {
      bestDistance = row.back();
      best = candidate;
    }
  }
  return best;
}

}  // namespace welkin
