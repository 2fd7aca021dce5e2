#pragma once
// Field tables: the one place where a parameter is declared. A struct of plain values specialises fieldTable<T> next to
// its definition; the sky file, --set, the sliders, the docs and the random-scene tests read that table.
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace welkin {

// What stands behind a number in files and on the command line. Value inside = value in the file * factor.
struct Unit {
  const char* symbol = "";
  double factor = 1.0;
};
inline constexpr Unit kNoUnit{};
inline constexpr Unit kMetres{"m"};
inline constexpr Unit kSeconds{"s"};
inline constexpr Unit kMetresPerSecond{"m/s"};
inline constexpr Unit kPerMetre{"1/m"};
inline constexpr Unit kDegrees{"deg", 3.14159265358979323846 / 180.0};
inline constexpr Unit kMicrometres{"um"};
inline constexpr Unit kStops{"EV"};
inline constexpr Unit kPixels{"px"};
inline constexpr Unit kKelvin{"K"};
inline constexpr Unit kCelsius{"C"};
inline constexpr Unit kMillimetresPerHour{"mm/h"};

// A closed interval, in the unit of the file.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// `file` is a text: the path of a file, relative to the sky file that names it; empty for none.
enum class FieldKind { real, integer, boolean, choice, text, file, vector };

// A value as the file writes it (in the file's unit); a choice is its name, a vector three numbers.
using FieldValue = std::variant<double, std::int64_t, bool, std::string, std::array<double, 3>>;

// One parameter, whatever struct it lives in.
struct Field {
  const char* name;  // as files write it: lower_snake
  FieldKind kind;
  Unit unit;
  Range hard;  // what is accepted
  Range soft;  // what a slider spans
  const char* help;
  std::vector<std::string_view> choices;
  FieldValue defaultValue;
  FieldValue (*get)(const void* object);
  // The value has the right alternative and lies in range (see checkField).
  void (*set)(void* object, const FieldValue& value);
  std::vector<std::int64_t> allowed;  // the only values of an integer, when not empty
  bool singlePrecision = false;       // numbers are floats inside
};

// Names of an enumeration's values, in order from 0: specialise `static constexpr std::array names{...}`.
template <class E>
struct ChoiceNames;

// Specialise for every struct of parameters: `static auto make()` returning fieldRows(field<&T::member>(...), ...), one
// row for each member; a member left out fails to compile.
template <class T>
struct FieldTable;

namespace detail {

// Counts the members of an aggregate: the largest number of initialisers that it takes.
template <class Owner>
struct AnyMember {
  template <class T>
  requires(!std::is_same_v<std::remove_cvref_t<T>, Owner>) operator T()
      const;  // never defined: only asked for its type
};
template <class T, class... Any>
consteval std::size_t memberCount() {
  if constexpr (requires { T{Any{}..., AnyMember<T>{}}; })
    return memberCount<T, Any..., AnyMember<T>>();
  else
    return sizeof...(Any);
}

template <class M>
struct MemberOf;
template <class O, class V>
struct MemberOf<V O::*> {
  using Owner = O;
  using Value = V;
};

template <auto Member>
FieldValue getMember(const void* object, const Unit& unit) {
  using Info = MemberOf<decltype(Member)>;
  using V = typename Info::Value;
  const V& v = static_cast<const typename Info::Owner*>(object)->*Member;
  if constexpr (std::is_same_v<V, bool> || std::is_same_v<V, std::string>)
    return v;
  else if constexpr (std::is_enum_v<V>)
    return std::string(ChoiceNames<V>::names[static_cast<std::size_t>(v)]);
  else if constexpr (std::is_integral_v<V>)
    return static_cast<std::int64_t>(v);
  else if constexpr (std::is_floating_point_v<V>)
    return static_cast<double>(v) / unit.factor;
  else
    return std::array<double, 3>{static_cast<double>(v.x) / unit.factor, static_cast<double>(v.y) / unit.factor,
                                 static_cast<double>(v.z) / unit.factor};
}

template <auto Member>
void setMember(void* object, const FieldValue& value, const Unit& unit) {
  using Info = MemberOf<decltype(Member)>;
  using V = typename Info::Value;
  V& v = static_cast<typename Info::Owner*>(object)->*Member;
  if constexpr (std::is_same_v<V, bool>) {
    v = std::get<bool>(value);
  } else if constexpr (std::is_enum_v<V>) {
    const auto& names = ChoiceNames<V>::names;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == std::get<std::string>(value)) v = static_cast<V>(i);
  } else if constexpr (std::is_integral_v<V>) {
    v = static_cast<V>(std::get<std::int64_t>(value));
  } else if constexpr (std::is_floating_point_v<V>) {
    v = static_cast<V>(std::get<double>(value) * unit.factor);
  } else if constexpr (std::is_same_v<V, std::string>) {
    v = std::get<std::string>(value);
  } else {
    const auto& a = std::get<std::array<double, 3>>(value);
    using C = std::remove_cvref_t<decltype(v.x)>;
    v = V(static_cast<C>(a[0] * unit.factor), static_cast<C>(a[1] * unit.factor), static_cast<C>(a[2] * unit.factor));
  }
}

template <class V>
constexpr FieldKind kindOf() {
  if constexpr (std::is_same_v<V, bool>)
    return FieldKind::boolean;
  else if constexpr (std::is_enum_v<V>)
    return FieldKind::choice;
  else if constexpr (std::is_integral_v<V>)
    return FieldKind::integer;
  else if constexpr (std::is_floating_point_v<V>)
    return FieldKind::real;
  else if constexpr (std::is_same_v<V, std::string>)
    return FieldKind::text;
  else
    return FieldKind::vector;
}

}  // namespace detail

// One row of a table. `hard` is what is accepted, `soft` what a slider spans ({} means: as hard). The default is the
// member's own.
template <auto Member, Unit const& U = kNoUnit>
Field field(const char* name, Range hard, Range soft, const char* help) {
  using Info = detail::MemberOf<decltype(Member)>;
  using V = typename Info::Value;
  Field f{name, detail::kindOf<V>(), U, hard, soft.low == Range{}.low ? hard : soft, help, {}, {}, {}, {}, {}};
  if constexpr (detail::kindOf<V>() == FieldKind::vector)
    f.singlePrecision = std::is_same_v<std::remove_cvref_t<decltype(V{}.x)>, float>;
  else
    f.singlePrecision = std::is_same_v<V, float>;
  if constexpr (std::is_enum_v<V>)
    for (const auto& choice : ChoiceNames<V>::names) f.choices.emplace_back(choice);
  f.get = [](const void* object) { return detail::getMember<Member>(object, U); };
  f.set = [](void* object, const FieldValue& value) { detail::setMember<Member>(object, value, U); };
  const typename Info::Owner defaults{};
  f.defaultValue = f.get(&defaults);
  return f;
}

// For texts, booleans and choices, which have no range.
template <auto Member>
Field field(const char* name, const char* help) {
  return field<Member>(name, Range{}, Range{}, help);
}

// For integers of which only a few values make sense.
template <auto Member>
Field field(const char* name, std::initializer_list<std::int64_t> allowed, const char* help) {
  const Range range{static_cast<double>(std::min(allowed)), static_cast<double>(std::max(allowed))};
  Field f = field<Member>(name, range, range, help);
  f.allowed = allowed;
  return f;
}

// For a text that is the path of a file.
template <auto Member>
Field fileField(const char* name, const char* help) {
  Field f = field<Member>(name, help);
  f.kind = FieldKind::file;
  return f;
}

// The parameters of T, in the order of its members.
template <class T>
std::span<const Field> fieldsOf() {
  static const std::vector<Field> kTable = [] {
    auto rows = FieldTable<T>::make();
    static_assert(std::tuple_size_v<decltype(rows)> == detail::memberCount<T>(),
                  "every member of the struct stands once in its field table");
    return std::vector<Field>(rows.begin(), rows.end());
  }();
  return kTable;
}

// Whether two values agree in every field.
template <class T>
bool sameFields(const T& a, const T& b) {
  for (const Field& f : fieldsOf<T>())
    if (f.get(&a) != f.get(&b)) return false;
  return true;
}

// A FieldTable's make() returns this: the number of rows is part of the type.
template <class... Fields>
std::array<Field, sizeof...(Fields)> fieldRows(Fields... fields) {
  return {std::move(fields)...};
}

// Empty when `value` may be set: right kind (an integer may stand for a real number), finite, in range, known choice.
// Otherwise what is wrong, without the field's name ("is 1.5, outside 0 to 1").
std::string checkField(const Field& field, FieldValue& value);

// The candidate nearest to `word` by edit distance, or empty when none is near.
std::string nearestName(std::string_view word, std::span<const std::string> candidates);

}  // namespace welkin
