#include "apps/viewer/flight_view/instruments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "welkin/base/angle.hpp"

namespace welkin::viewer {

namespace {

constexpr double kKnot = 1852.0 / 3600.0, kFoot = 0.3048;
constexpr ImU32 kWhite = IM_COL32(235, 238, 240, 255), kDim = IM_COL32(150, 158, 165, 255),
                kFace = IM_COL32(18, 20, 23, 255), kRim = IM_COL32(70, 76, 82, 255),
                kAmber = IM_COL32(255, 190, 70, 255), kRed = IM_COL32(235, 70, 55, 255),
                kGreen = IM_COL32(80, 190, 90, 255), kSky = IM_COL32(62, 122, 186, 255),
                kSoil = IM_COL32(112, 78, 48, 255);

// A point at an angle clockwise from the top.
ImVec2 on(const ImVec2& centre, float radius, float angle) {
  return {centre.x + radius * std::sin(angle), centre.y - radius * std::cos(angle)};
}

class Gauge {
 public:
  Gauge(ImDrawList* list, const ImVec2& centre, float radius) : list_(list), c_(centre), r_(radius) {
    list_->AddCircleFilled(c_, r_, kFace, 48);
    list_->AddCircle(c_, r_, kRim, 48, std::max(1.0f, 0.05f * r_));
  }
  void tick(float angle, bool large) const {
    list_->AddLine(on(c_, 0.92f * r_, angle), on(c_, (large ? 0.78f : 0.85f) * r_, angle), large ? kWhite : kDim,
                   std::max(1.0f, 0.025f * r_));
  }
  void arc(float from, float to, ImU32 colour) const {
    list_->PathArcTo(c_, 0.95f * r_, from - 0.5f * kPiFloat, to - 0.5f * kPiFloat, 24);
    list_->PathStroke(colour, ImDrawFlags_None, std::max(1.5f, 0.06f * r_));
  }
  void text(const ImVec2& at, const std::string& words, float share, ImU32 colour = kWhite) const {
    const float size = std::max(share * r_, 6.0f);
    const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(size, 1e6f, 0.0f, words.c_str());
    list_->AddText(ImGui::GetFont(), size, {at.x - 0.5f * extent.x, at.y - 0.5f * extent.y}, colour, words.c_str());
  }
  void label(float angle, const std::string& words) const { text(on(c_, 0.6f * r_, angle), words, 0.26f); }
  void name(const std::string& words) const { text({c_.x, c_.y + 0.36f * r_}, words, 0.19f, kDim); }
  void needle(float angle, float length, ImU32 colour = kWhite) const {
    const float w = 0.05f * r_;
    const ImVec2 tip = on(c_, length * r_, angle), left = on(c_, w, angle - 0.5f * kPiFloat),
                 right = on(c_, w, angle + 0.5f * kPiFloat);
    list_->AddTriangleFilled(tip, left, right, colour);
    list_->AddCircleFilled(c_, 0.09f * r_, kRim, 16);
  }
  ImDrawList* list() const { return list_; }
  const ImVec2& centre() const { return c_; }
  float radius() const { return r_; }

 private:
  ImDrawList* list_;
  ImVec2 c_;
  float r_;
};

void airspeed(const Gauge& d, const Flight& flight) {
  // 0 at the top, 220 knots after 330 degrees.
  const auto angle = [](double knots) {
    return static_cast<float>(std::clamp(knots, 0.0, 222.0) / 240.0) * 2.0f * kPiFloat;
  };
  d.arc(angle(45), angle(90), kWhite);
  d.arc(angle(90), angle(150), kGreen);
  d.arc(angle(150), angle(195), kAmber);
  d.arc(angle(195), angle(198), kRed);
  for (int k = 0; k <= 220; k += 10) d.tick(angle(k), k % 20 == 0);
  for (int k = 40; k <= 200; k += 40) d.label(angle(k), fmt::format("{}", k));
  d.name("KNOTS");
  d.needle(angle(indicatedAirspeed(flight.aircraft()) / kKnot), 0.82f);
}

// The disc of the sky behind a horizon, which lies `height` below the centre (in radii) and turned by `bank`.
void attitude(const Gauge& d, const Attitude& now) {
  const float r = 0.9f * d.radius(), bank = static_cast<float>(now.bank);
  const float step =
      r / 32.0f * static_cast<float>(180.0 / std::numbers::pi);  // pixels a radian: 32 degrees to the rim
  const float below = std::clamp(static_cast<float>(now.pitch) * step, -0.97f * r, 0.97f * r);
  const ImVec2 c = d.centre();
  // Axes of the horizon on the screen.
  const ImVec2 along(std::cos(bank), -std::sin(bank)), down(std::sin(bank), std::cos(bank));
  const auto at = [&](float x, float y) {
    return ImVec2(c.x + along.x * x + down.x * y, c.y + along.y * x + down.y * y);
  };
  d.list()->AddCircleFilled(c, r, kSoil, 48);
  const float half = std::acos(std::clamp(below / r, -1.0f, 1.0f));
  // From the horizon's right end over the top to its left end; angles from `down`.
  std::vector<ImVec2> sky;
  for (int i = 0; i <= 40; ++i) {
    const float t = half + (2.0f * kPiFloat - 2.0f * half) * static_cast<float>(i) / 40.0f;
    sky.push_back(at(r * std::sin(t), r * std::cos(t)));
  }
  d.list()->AddConvexPolyFilled(sky.data(), static_cast<int>(sky.size()), kSky);
  const float width = std::sqrt(std::max(r * r - below * below, 0.0f));
  d.list()->AddLine(at(-width, below), at(width, below), kWhite, std::max(1.0f, 0.02f * r));
  for (int degrees = -60; degrees <= 60; degrees += 10) {
    if (degrees == 0) continue;
    const float y = static_cast<float>(now.pitch - degrees * std::numbers::pi / 180.0) * step;
    const float x = degrees % 20 == 0 ? 0.3f * r : 0.16f * r;
    if (x * x + y * y < 0.75f * r * r) d.list()->AddLine(at(-x, y), at(x, y), kWhite, 1.0f);
  }
  for (const int degrees : {-60, -45, -30, -20, -10, 10, 20, 30, 45, 60})
    d.tick(static_cast<float>(degrees) * kPiFloat / 180.0f, degrees % 30 == 0);
  const ImVec2 top = on(c, 0.8f * d.radius(), -bank);
  d.list()->AddTriangleFilled(top, on(c, 0.68f * d.radius(), -bank - 0.08f), on(c, 0.68f * d.radius(), -bank + 0.08f),
                              kWhite);
  // The aircraft.
  const float w = std::max(1.5f, 0.045f * r);
  d.list()->AddLine({c.x - 0.55f * r, c.y}, {c.x - 0.18f * r, c.y}, kAmber, w);
  d.list()->AddLine({c.x + 0.18f * r, c.y}, {c.x + 0.55f * r, c.y}, kAmber, w);
  d.list()->AddCircleFilled(c, w, kAmber, 12);
}

void altimeter(const Gauge& d, const Aircraft& aircraft) {
  const double feet = aircraft.position.z / kFoot;
  for (int i = 0; i < 50; ++i) d.tick(2.0f * kPiFloat * static_cast<float>(i) / 50.0f, i % 5 == 0);
  for (int i = 0; i < 10; ++i) d.label(2.0f * kPiFloat * static_cast<float>(i) / 10.0f, fmt::format("{}", i));
  d.text({d.centre().x, d.centre().y + 0.32f * d.radius()}, fmt::format("{:.0f} ft", feet), 0.24f, kAmber);
  d.needle(static_cast<float>(feet / 10000.0) * 2.0f * kPiFloat, 0.5f);
  d.needle(static_cast<float>(std::fmod(feet, 1000.0) / 1000.0) * 2.0f * kPiFloat, 0.84f);
}

void turnAndSlip(const Gauge& d, const Aircraft& aircraft, const Attitude& now) {
  const double rate = (aircraft.rates.y * std::sin(now.bank) + aircraft.rates.z * std::cos(now.bank)) /
                      std::max(std::abs(std::cos(now.pitch)), 0.1);
  // Two minutes for a whole turn stand at 25 degrees.
  const float tilt = static_cast<float>(std::clamp(rate / (std::numbers::pi / 60.0) * 0.44, -0.9, 0.9));
  const ImVec2 c = d.centre();
  const float r = d.radius();
  for (const float side : {-1.0f, 1.0f}) {
    d.tick(side * 0.5f * kPiFloat, true);
    d.tick(side * (0.5f * kPiFloat + 0.44f), true);
    const ImVec2 tip = on(c, 0.72f * r, side * 0.5f * kPiFloat + tilt);
    d.list()->AddLine(c, tip, kWhite, std::max(2.0f, 0.06f * r));
  }
  d.list()->AddCircleFilled(c, 0.11f * r, kWhite, 16);
  d.list()->AddLine(c, on(c, 0.24f * r, tilt), kWhite, std::max(2.0f, 0.05f * r));
  const float ball = static_cast<float>(std::clamp(aircraft.sideslip * 4.0, -1.0, 1.0));
  const ImVec2 low{c.x - 0.4f * r, c.y + 0.42f * r}, high{c.x + 0.4f * r, c.y + 0.62f * r};
  d.list()->AddRectFilled(low, high, IM_COL32(40, 44, 46, 255), 0.1f * r);
  for (const float side : {-0.11f, 0.11f})
    d.list()->AddLine({c.x + side * r, low.y}, {c.x + side * r, high.y}, kDim, 1.0f);
  d.list()->AddCircleFilled({c.x + 0.3f * r * ball, 0.5f * (low.y + high.y)}, 0.085f * r, kWhite, 16);
}

void compass(const Gauge& d, const Attitude& now) {
  const auto heading = static_cast<float>(now.heading);
  for (int i = 0; i < 36; ++i) d.tick(static_cast<float>(i) * kPiFloat / 18.0f - heading, i % 3 == 0);
  const char* const names[] = {"N", "3", "6", "E", "12", "15", "S", "21", "24", "W", "30", "33"};
  for (int i = 0; i < 12; ++i) d.label(static_cast<float>(i) * kPiFloat / 6.0f - heading, names[i]);
  const ImVec2 c = d.centre();
  d.list()->AddTriangleFilled(on(c, 0.36f * d.radius(), 0.0f), on(c, 0.3f * d.radius(), 2.6f),
                              on(c, 0.3f * d.radius(), -2.6f), kAmber);
  d.text({c.x, c.y + 0.4f * d.radius()},
         fmt::format("{:03.0f}", std::fmod(heading * 180.0f / kPiFloat + 0.5f, 360.0f) - 0.5f), 0.24f, kAmber);
}

void verticalSpeed(const Gauge& d, double climb) {
  // Thousands of feet a minute; 0 points left, 3 lies 170 degrees on.
  const auto angle = [](double thousands) {
    return static_cast<float>(-0.5 * std::numbers::pi +
                              std::clamp(thousands, -3.1, 3.1) / 3.0 * 0.94 * std::numbers::pi);
  };
  for (int i = -6; i <= 6; ++i) d.tick(angle(0.5 * i), i % 2 == 0);
  for (int i = -3; i <= 3; ++i) d.label(angle(i), fmt::format("{}", std::abs(i)));
  d.text({d.centre().x + 0.12f * d.radius(), d.centre().y + 0.3f * d.radius()}, "1000 ft/min", 0.17f, kDim);
  d.needle(angle(climb / kFoot * 60.0 / 1000.0), 0.8f);
}

void lever(ImDrawList* list, const ImVec2& low, const ImVec2& high, double share, ImU32 colour, const char* name) {
  const float size = std::max(0.15f * (high.y - low.y), 7.0f);
  const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(size, 1e6f, 0.0f, name);
  const float foot = high.y - 1.2f * size;
  list->AddRectFilled(low, {high.x, foot}, kFace, 2.0f);
  list->AddRectFilled({low.x, foot - static_cast<float>(std::clamp(share, 0.0, 1.0)) * (foot - low.y)}, {high.x, foot},
                      colour, 2.0f);
  list->AddRect(low, {high.x, foot}, kRim, 2.0f);
  const ImVec2 at(0.5f * (low.x + high.x - extent.x), foot + 0.1f * size);
  list->AddText(ImGui::GetFont(), size, {at.x + 1.0f, at.y + 1.0f}, kFace, name);  // it may stand before a cloud
  list->AddText(ImGui::GetFont(), size, at, kWhite, name);
}

void banner(ImDrawList* list, const ImVec2& centre, float size, const std::string& words, ImU32 colour) {
  const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(size, 1e6f, 0.0f, words.c_str());
  const ImVec2 low(centre.x - 0.5f * extent.x, centre.y - 0.5f * extent.y);
  list->AddRectFilled({low.x - 0.5f * size, low.y - 0.25f * size},
                      {low.x + extent.x + 0.5f * size, low.y + extent.y + 0.25f * size}, IM_COL32(10, 12, 14, 190),
                      0.3f * size);
  list->AddText(ImGui::GetFont(), size, low, colour, words.c_str());
}

// The top of the panel, a little higher in the middle, as hoods are.
void dashboard(ImDrawList* list, const ImVec2& low, const ImVec2& high, float top) {
  constexpr int kSteps = 32;
  const float rise = 0.1f * (high.y - top);
  const auto edge = [&](int i) {
    const float t = static_cast<float>(i) / kSteps, s = 2.0f * t - 1.0f;
    return ImVec2(low.x + t * (high.x - low.x), top - rise * (1.0f - s * s));
  };
  for (int i = 0; i < kSteps; ++i) {
    const ImVec2 a = edge(i), b = edge(i + 1);
    list->AddQuadFilled(a, b, {b.x, high.y}, {a.x, high.y}, IM_COL32(34, 36, 40, 255));
    list->AddLine(a, b, IM_COL32(12, 13, 15, 255), std::max(3.0f, 0.03f * (high.y - top)));
  }
}

}  // namespace

void drawInstruments(const Flight& flight, const ImVec2& low, const ImVec2& high, bool paused) {
  const float width = high.x - low.x, height = high.y - low.y;
  if (width < 80.0f || height < 60.0f) return;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->PushClipRect(low, high, true);
  const bool inside = flight.pilot.view() == FlightView::cockpit;
  const Aircraft& aircraft = flight.aircraft();
  const Attitude now = attitudeOf(aircraft);
  // Six dials and two levers in a row.
  const float cell = std::min(width / 7.0f, (inside ? 0.24f : 0.2f) * height), radius = 0.46f * cell;
  const float middle = high.y - (inside ? 0.58f : 0.54f) * cell;
  if (inside) dashboard(list, low, high, middle - 0.66f * cell);
  float x = 0.5f * (low.x + high.x) - 3.5f * cell + 0.5f * cell;
  const auto next = [&] {
    const ImVec2 centre(x, middle);
    x += cell;
    return Gauge(list, centre, radius);
  };
  airspeed(next(), flight);
  attitude(next(), now);
  altimeter(next(), aircraft);
  turnAndSlip(next(), aircraft, now);
  compass(next(), now);
  verticalSpeed(next(), flight.climb());
  const float top = middle - radius, foot = middle + radius, left = x - 0.45f * cell;
  const Controls controls = flight.pilot.controls();
  lever(list, {left, top}, {left + 0.3f * cell, foot}, static_cast<double>(controls.throttle), kGreen, "PWR");
  lever(list, {left + 0.45f * cell, top}, {left + 0.75f * cell, foot}, aircraft.flaps, kSky, "FLAP");

  const float size = std::max(0.05f * height, 11.0f);
  ImVec2 at(0.5f * (low.x + high.x), low.y + 0.12f * height);
  const auto say = [&](const std::string& words, ImU32 colour) {
    banner(list, at, size, words, colour);
    at.y += 1.7f * size;
  };
  if (aircraft.crashed) say("Crashed. Backspace begins again.", kRed);
  if (!aircraft.crashed && !aircraft.onGround && (aircraft.stalled > 0.1 || aircraft.angleOfAttack > 0.24))
    say("STALL", kRed);
  if (paused) say("Paused. Space goes on.", kWhite);
  list->PopClipRect();
}

}  // namespace welkin::viewer
