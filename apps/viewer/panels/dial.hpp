#pragma once
// Round things that are dragged: sundial and wind rose.
#include "apps/viewer/panels/workbench.hpp"

namespace welkin::viewer {

struct Dial {
  ImDrawList* list = nullptr;
  ImVec2 centre{};
  float radius = 0.0f;
  bool active = false;  // the pointer holds it
};

// A square for the dial, `size` letters high; what is changed while it is held is one step. The dial is the last item.
Dial beginDial(Workbench& bench, const char* name, float size);
// N, E, S, W at its rim.
void drawCompass(const Dial& dial);

}  // namespace welkin::viewer
