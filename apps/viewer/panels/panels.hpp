#pragma once
// One function a panel; each stands in a file of its own.
#include "apps/viewer/panels/workbench.hpp"

namespace welkin::viewer {

void drawMenu(Workbench& bench);
void drawStatus(Workbench& bench);
// Every parameter, from the field tables.
void drawParameters(Workbench& bench);
// The fields of one section, for panels about one thing.
void drawSection(Workbench& bench, const std::string& path);
// The widget of one parameter: slider, choice, text ... with unit, tooltip and a button back to the default.
void drawField(Workbench& bench, const Section& section, const Field& field);

}  // namespace welkin::viewer
