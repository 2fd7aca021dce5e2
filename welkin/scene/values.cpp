// Parameters as text: `--set key=value` and the values of sky files.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "welkin/base/error.hpp"
#include "welkin/scene/sections.hpp"

namespace welkin {

namespace {

[[noreturn]] void refuse(std::string_view assignment, const std::string& what) {
  throw Error(ErrorKind::badInput, std::string(assignment), what);
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view unquoted(std::string_view text) {
  if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
    return text.substr(1, text.size() - 2);
  return text;
}

template <class T>
bool parseNumber(std::string_view text, T& out) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc() && end == text.data() + text.size();
}

bool parseVector(std::string_view text, std::array<double, 3>& out) {
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 2) || !parseNumber(text.substr(0, comma), out[i])) return false;
    text.remove_prefix(i == 2 ? text.size() : comma + 1);
  }
  return true;
}

// The text as a value of the field's kind; what cannot be read stays a text, which checkField refuses.
FieldValue valueFromText(const Field& field, std::string_view text) {
  double real = 0;
  std::int64_t whole = 0;
  std::array<double, 3> vector{};
  switch (field.kind) {
    case FieldKind::real:
      if (parseNumber(text, real)) return real;
      break;
    case FieldKind::integer:
      if (parseNumber(text, whole)) return whole;
      break;
    case FieldKind::boolean:
      if (text == "true" || text == "false") return text == "true";
      break;
    case FieldKind::vector:
      if (parseVector(text, vector)) return vector;
      break;
    default:
      break;
  }
  return std::string(unquoted(text));
}

std::string inQuotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (c == '\n')
      out += "\\n";
    else if (static_cast<unsigned char>(c) < 32 || c == 127)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

// Always a TOML float: with a point or an exponent.
std::string withPoint(std::string digits) {
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits;
}

// The shortest decimal that the field reads as the same bits.
std::string shortest(const Field& field, double value) {
  const auto same = [&](double read) {
    const double a = read * field.unit.factor, b = value * field.unit.factor;
    return field.singlePrecision ? static_cast<float>(a) == static_cast<float>(b) : a == b;
  };
  for (int digits = 1; digits < 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", value, digits);
    double read = 0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    if (same(read)) return withPoint(fmt::format("{}", read));  // 300.0 rather than 3e+02
  }
  return withPoint(fmt::format("{:.17g}", value));
}

}  // namespace

std::string formatValue(const Field& field, const FieldValue& value) {
  if (const double* real = std::get_if<double>(&value)) return shortest(field, *real);
  if (const std::int64_t* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const bool* on = std::get_if<bool>(&value)) return *on ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&value)) return inQuotes(*text);
  const auto& v = std::get<std::array<double, 3>>(value);
  return fmt::format("[{}, {}, {}]", shortest(field, v[0]), shortest(field, v[1]), shortest(field, v[2]));
}

Parameter findParameter(std::span<const Section> sections, std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const std::string_view table = dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
  const std::string_view name = path.substr(dot == std::string_view::npos ? 0 : dot + 1);
  for (const Section& s : sections)
    if (const Field* f = s.path == table ? findField(s, name) : nullptr) return {&s, f};
  return {};
}

std::string withListNumber(std::string_view path) {
  for (const std::string_view list : {"layer.", "sheet.", "grid.", "classical.", "hero."})
    if (path.starts_with(list) && path.size() > list.size() && (path[list.size()] < '0' || path[list.size()] > '9'))
      return fmt::format("{}0.{}", list, path.substr(list.size()));
  return std::string(path);
}

std::string unknownParameter(const Scene& scene, std::span<const Section> sections, std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const std::string_view table = dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
  for (const auto& [list, size] :
       {std::pair("layer", scene.layers.size()), std::pair("sheet", scene.sheets.size()),
        std::pair("grid", scene.grids.size()), std::pair("classical", scene.classical.size()),
        std::pair("hero", scene.heroes.size())})
    if (table.starts_with(fmt::format("{}.", list)) && std::none_of(sections.begin(), sections.end(), [&](auto& s) {
          return table == s.path || table.starts_with(s.path + ".");
        }))
      return fmt::format("the sky has {} [[{}]]; they are counted from 0", size, list);
  std::vector<std::string> known;
  for (const Section& s : sections)
    for (const Field& f : s.fields) known.push_back(s.path.empty() ? f.name : s.path + "." + f.name);
  const std::string near = nearestName(path, known);
  return fmt::format("'{}' is not a parameter{}", path,
                     near.empty() ? "; `welkin fields` lists them" : fmt::format("; did you mean '{}'?", near));
}

std::string setField(Scene& scene, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) refuse(assignment, "write it as key=value, for example sun.elevation=20");
  std::string path = withListNumber(trimmed(assignment.substr(0, equals)));
  const std::string_view text = trimmed(assignment.substr(equals + 1));
  const std::vector<Section> sections = sectionsOf(scene);
  const Parameter p = findParameter(sections, path);
  if (!p.field) refuse(assignment, unknownParameter(scene, sections, path));
  const std::string wrong = assign(scene, *p.section, *p.field, valueFromText(*p.field, text));
  if (!wrong.empty()) refuse(assignment, fmt::format("{} {}", path, wrong));
  return path;
}

}  // namespace welkin
