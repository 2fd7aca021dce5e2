// Sun and moon: a sundial, date, time and place.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/model/sun_path.hpp"
#include "apps/viewer/panels/dial.hpp"
#include "apps/viewer/panels/panels.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/base/error.hpp"

namespace welkin::viewer {

namespace {

constexpr double kDeepest = -18.0 * kPi / 180.0;  // where night is complete

// The sky as a disc: the zenith in the middle, the horizon a circle, twilight outside.
float radiusOf(double elevation, float edge) {
  const double share = (0.5 * kPi - elevation) / (0.5 * kPi - kDeepest);
  return edge * static_cast<float>(std::clamp(share, 0.0, 1.0));
}
double elevationOf(float radius, float edge) {
  return 0.5 * kPi - static_cast<double>(std::clamp(radius / edge, 0.0f, 1.0f)) * (0.5 * kPi - kDeepest);
}

// On a map north is above and east to the right.
ImVec2 pointOf(const Dial& dial, const SolarPosition& at) {
  const float r = radiusOf(at.elevation, dial.radius);
  return {dial.centre.x + r * static_cast<float>(std::sin(at.azimuth)),
          dial.centre.y - r * static_cast<float>(std::cos(at.azimuth))};
}

SolarPosition placeUnder(const Dial& dial, const ImVec2& pointer) {
  const float x = pointer.x - dial.centre.x, y = dial.centre.y - pointer.y;
  const double azimuth = std::atan2(x, y);
  return {azimuth < 0.0 ? azimuth + 2.0 * kPi : azimuth, elevationOf(std::hypot(x, y), dial.radius)};
}

void drawPath(const Dial& dial, const Sun& sun) {
  const std::vector<SolarPosition> path = sunPath(sun, 96);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const bool up = path[i].elevation > 0.0;
    if (path[i].elevation < kDeepest && path[i + 1].elevation < kDeepest) continue;
    dial.list->AddLine(pointOf(dial, path[i]), pointOf(dial, path[i + 1]),
                       up ? IM_COL32(255, 205, 110, 220) : IM_COL32(120, 140, 190, 140), up ? 2.0f : 1.0f);
  }
  for (int hour = 0; hour < 24; hour += 3) {
    const SolarPosition at = sunAt(sun, hour);
    if (at.elevation < 0.0) continue;
    const ImVec2 p = pointOf(dial, at);
    dial.list->AddCircleFilled(p, 2.5f, IM_COL32(255, 225, 160, 255));
    dial.list->AddText({p.x + 4.0f, p.y - 6.0f}, IM_COL32(255, 225, 160, 160), fmt::format("{}", hour).c_str());
  }
}

void drawSundial(Workbench& bench) {
  const Sun sun = bench.document.scene().sun;
  const bool byPlace = sun.mode == SunMode::place;
  const Dial dial = beginDial(bench, "sundial", 14.0f);
  // Day inside the horizon, twilight round it.
  dial.list->AddCircleFilled(dial.centre, dial.radius, IM_COL32(24, 30, 52, 255), 64);
  dial.list->AddCircleFilled(dial.centre, radiusOf(0.0, dial.radius), IM_COL32(52, 82, 130, 255), 64);
  for (const double ring : {30.0, 60.0})
    dial.list->AddCircle(dial.centre, radiusOf(ring * kPi / 180.0, dial.radius), IM_COL32(255, 255, 255, 40), 64);
  dial.list->AddCircle(dial.centre, radiusOf(0.0, dial.radius), IM_COL32(255, 255, 255, 110), 64);
  drawCompass(dial);
  if (byPlace) drawPath(dial, sun);
  const glm::dvec3 toSun = sunDirection(sun);
  const SolarPosition at{std::atan2(toSun.x, toSun.y), std::asin(std::clamp(toSun.z, -1.0, 1.0))};
  const ImVec2 p = pointOf(dial, at);
  const bool up = at.elevation > -0.0145;
  dial.list->AddCircleFilled(p, 0.55f * ImGui::GetFontSize(),
                             up ? IM_COL32(255, 214, 90, 255) : IM_COL32(190, 120, 70, 255));
  dial.list->AddCircle(p, 0.55f * ImGui::GetFontSize(), IM_COL32(40, 30, 10, 255));
  // The picture's own direction.
  const float heading = bench.document.scene().camera.heading;
  dial.list->AddLine(dial.centre,
                     {dial.centre.x + 0.35f * dial.radius * std::sin(heading),
                      dial.centre.y - 0.35f * dial.radius * std::cos(heading)},
                     IM_COL32(255, 255, 255, 170), 2.0f);
  if (ImGui::IsItemHovered() && !dial.active)
    ImGui::SetTooltip(byPlace ? "drag: the hour of the day"
                              : "drag: where the sun stands\nline: where the camera looks");

  if (dial.active) {
    const SolarPosition wanted = placeUnder(dial, ImGui::GetIO().MousePos);
    if (byPlace) {
      bench.document.set("sun", "time", textFromHour(hourNearest(sun, wanted)));
    } else {
      bench.document.set("sun", "azimuth", std::clamp(wanted.azimuth * 180.0 / kPi, 0.0, 360.0));
      bench.document.set("sun", "elevation", wanted.elevation * 180.0 / kPi);
    }
  }
  ImGui::Text("%.1f° high, %.0f°", at.elevation * 180.0 / kPi, std::fmod(at.azimuth * 180.0 / kPi + 360.0, 360.0));
}

// Sliders for the day and the hour, which files hold as texts.
void drawDateAndTime(Workbench& bench) {
  const Sun& sun = bench.document.scene().sun;
  const auto slider = [&](const char* label, const char* field, auto draw) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::SameLine(ImGui::GetContentRegionMax().x * 0.36f);
    ImGui::SetNextItemWidth(-1.0f);
    const std::optional<std::string> next = draw();
    bench.interface.items.mark(std::string("sun ") + label);
    if (ImGui::IsItemActivated()) bench.document.beginGesture();
    const bool finished = ImGui::IsItemDeactivated();
    if (next) bench.document.set("sun", field, *next);
    if (finished) bench.document.endGesture();
  };
  slider("day", "date", [&]() -> std::optional<std::string> {
    int day = dayOfYear(sun.date);
    if (!ImGui::SliderInt("##day", &day, 1, daysInYear(sun.date), sun.date.c_str())) return std::nullopt;
    return dateOfDay(sun.date, day);
  });
  slider("hour", "time", [&]() -> std::optional<std::string> {
    float hour = static_cast<float>(hourFromText(sun.time));
    if (!ImGui::SliderFloat("##hour", &hour, 0.0f, 24.0f, sun.time.c_str())) return std::nullopt;
    return textFromHour(hour);
  });
  const SunTimes times = sunTimes(sun);
  const auto hour = [](const std::optional<double>& t) { return t ? textFromHour(*t).substr(0, 5) : std::string("–"); };
  ImGui::TextDisabled("sunrise %s   sunset %s", hour(times.rise).c_str(), hour(times.set).c_str());
}

}  // namespace

void drawSun(Workbench& bench) {
  ImGui::BeginChild("##sun");
  drawSundial(bench);
  if (bench.document.scene().sun.mode == SunMode::place) drawDateAndTime(bench);
  ImGui::Separator();
  drawSection(bench, "sun");
  if (ImGui::CollapsingHeader("moon")) drawSection(bench, "moon");
  bench.interface.items.mark("section moon");
  if (ImGui::CollapsingHeader("night")) drawSection(bench, "night");
  bench.interface.items.mark("section night");
  ImGui::EndChild();
}

}  // namespace welkin::viewer
