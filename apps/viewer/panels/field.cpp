// The widget of one parameter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/panels/panels.hpp"
#include "welkin/scene/animation.hpp"

namespace welkin::viewer {

namespace {

constexpr double kUnbounded = 1e6;  // sliders that span more are dragged instead

// Enough digits to see a slider's thousandth part, with the unit.
std::string formatOf(const Field& field) {
  const double span = field.soft.high - field.soft.low;
  int digits = 3;
  if (std::isfinite(span) && span > 0.0) digits = std::clamp(static_cast<int>(std::ceil(2.5 - std::log10(span))), 0, 6);
  const char* symbol = field.unit.symbol;
  return fmt::format("%.{}f{}{}", digits, *symbol ? " " : "", symbol);
}

bool logarithmic(const Field& field) { return field.soft.low > 0.0 && field.soft.high / field.soft.low >= 50.0; }

bool drawReal(const Field& field, double& value) {
  const std::string format = formatOf(field);
  const double low = field.soft.low, high = field.soft.high;
  if (!std::isfinite(low) || !std::isfinite(high) || high - low > kUnbounded)
    return ImGui::DragScalar("##value", ImGuiDataType_Double, &value, 1.0f, nullptr, nullptr, format.c_str());
  const ImGuiSliderFlags flags = logarithmic(field) ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  return ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &low, &high, format.c_str(), flags);
}

bool drawInteger(const Field& field, std::int64_t& value) {
  const std::string format = fmt::format("%lld{}{}", *field.unit.symbol ? " " : "", field.unit.symbol);
  if (!field.allowed.empty()) {
    bool changed = false;
    if (ImGui::BeginCombo("##value", fmt::format("{}", value).c_str())) {
      for (const std::int64_t allowed : field.allowed)
        if (ImGui::Selectable(fmt::format("{}", allowed).c_str(), allowed == value)) value = allowed, changed = true;
      ImGui::EndCombo();
    }
    return changed;
  }
  const auto low = static_cast<std::int64_t>(field.soft.low), high = static_cast<std::int64_t>(field.soft.high);
  return ImGui::SliderScalar("##value", ImGuiDataType_S64, &value, &low, &high, format.c_str());
}

bool drawChoice(Workbench& bench, const std::string& name, const Field& field, std::string& value) {
  bool changed = false;
  if (ImGui::BeginCombo("##value", value.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const std::string_view choice : field.choices) {
      if (ImGui::Selectable(std::string(choice).c_str(), choice == value)) value = choice, changed = true;
      bench.interface.items.mark(name + "=" + std::string(choice));
    }
    ImGui::EndCombo();
  }
  return changed;
}

bool drawVector(const Field& field, std::array<double, 3>& value) {
  if (field.soft.low == 0.0 && field.soft.high == 1.0) {
    float colour[3] = {static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])};
    if (!ImGui::ColorEdit3("##value", colour, ImGuiColorEditFlags_Float)) return false;
    std::copy_n(colour, 3, value.begin());
    return true;
  }
  const double span = field.soft.high - field.soft.low;
  const float step = std::isfinite(span) ? static_cast<float>(span / 1000.0) : 1.0f;
  return ImGui::DragScalarN("##value", ImGuiDataType_Double, value.data(), 3, step, nullptr, nullptr,
                            formatOf(field).c_str());
}

// Texts are taken when they have been typed, not letter by letter.
bool drawText(std::string& value) {
  ImGui::InputText("##value", &value);
  return ImGui::IsItemDeactivatedAfterEdit();
}

void tooltip(const Section& section, const Field& field, const std::string& name, bool keyed) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0f);
  ImGui::TextUnformatted(field.help);
  ImGui::PopTextWrapPos();
  std::string range;
  if (field.kind == FieldKind::real || field.kind == FieldKind::integer || field.kind == FieldKind::vector)
    if (std::isfinite(field.hard.low) && std::isfinite(field.hard.high))
      range = fmt::format(", {:g} to {:g}{}{}", field.hard.low, field.hard.high, *field.unit.symbol ? " " : "",
                          field.unit.symbol);
  ImGui::TextDisabled("%s%s", name.c_str(), range.c_str());
  if (keyed) ImGui::TextDisabled("set by keyframes");
  ImGui::TextDisabled("default %s; now %s", formatValue(field, field.defaultValue).c_str(),
                      formatValue(field, field.get(section.object)).c_str());
  ImGui::EndTooltip();
}

bool drawWidget(Workbench& bench, const std::string& name, const Field& field, FieldValue& value) {
  switch (field.kind) {
    case FieldKind::real:
      return drawReal(field, std::get<double>(value));
    case FieldKind::integer:
      return drawInteger(field, std::get<std::int64_t>(value));
    case FieldKind::boolean:
      return ImGui::Checkbox("##value", &std::get<bool>(value));
    case FieldKind::choice:
      return drawChoice(bench, name, field, std::get<std::string>(value));
    case FieldKind::text:
    case FieldKind::file:
      return drawText(std::get<std::string>(value));
    case FieldKind::vector:
      return drawVector(field, std::get<std::array<double, 3>>(value));
  }
  return false;
}

std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

void drawField(Workbench& bench, const Section& section, const Field& field) {
  const std::string name = section.path.empty() ? field.name : section.path + "." + field.name;
  ImGui::PushID(name.c_str());
  FieldValue value = field.get(section.object);
  const bool changedFromDefault = value != field.defaultValue;
  const float width = ImGui::GetContentRegionAvail().x, button = ImGui::GetFrameHeight();
  const float label = width * 0.36f;

  ImGui::AlignTextToFramePadding();
  if (changedFromDefault)
    ImGui::TextColored({0.72f, 0.86f, 1.0f, 1.0f}, "%s", spaced(field.name).c_str());
  else
    ImGui::TextUnformatted(spaced(field.name).c_str());
  // What keyframes set is theirs.
  const bool keyed = hasKeyframes(bench.document.scene(), name);
  tooltip(section, field, name, keyed);
  ImGui::SameLine(label);
  ImGui::SetNextItemWidth(width - label - button - ImGui::GetStyle().ItemSpacing.x);
  ImGui::BeginDisabled(keyed);
  const bool edited = drawWidget(bench, name, field, value);
  ImGui::EndDisabled();
  bench.interface.items.mark(name);
  if (!ImGui::IsItemActive()) tooltip(section, field, name, keyed);
  // A drag is one step; so is whatever is typed into a slider.
  if (ImGui::IsItemActivated()) bench.document.beginGesture();
  const bool finished = ImGui::IsItemDeactivated();
  if (edited) {
    std::string wrong = bench.document.set(section.path, field.name, value);
    if (wrong.empty())
      bench.refusals.erase(name);
    else
      bench.refusals[name] = std::move(wrong);
  }
  if (finished) bench.document.endGesture();

  if (changedFromDefault) {
    ImGui::SameLine(width - button);
    if (ImGui::Button("\u21ba", {button, 0.0f})) {
      bench.document.set(section.path, field.name, field.defaultValue);
      bench.refusals.erase(name);
    }
    bench.interface.items.mark(name + ".reset");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("back to %s", formatValue(field, field.defaultValue).c_str());
  }
  if (const auto refusal = bench.refusals.find(name); refusal != bench.refusals.end())
    ImGui::TextColored({1.0f, 0.55f, 0.45f, 1.0f}, "%s", refusal->second.c_str());
  ImGui::PopID();
}

}  // namespace welkin::viewer
