#pragma once
// What a pilot reads, drawn over the picture.
#include <imgui.h>

#include "apps/viewer/flight/flight.hpp"

namespace welkin::viewer {

// Into the part of the window between two corners (pixels from the upper left): airspeed, attitude, altitude, turn and
// slip, heading, vertical speed, throttle and flaps; a dashboard behind them in the cockpit. `paused`: says so.
void drawInstruments(const Flight& flight, const ImVec2& low, const ImVec2& high, bool paused);

}  // namespace welkin::viewer
