#pragma once
// One function a panel; each stands in a file of its own.
#include "apps/viewer/panels/workbench.hpp"

namespace welkin::viewer {

void drawMenu(Workbench& bench);
void drawStatus(Workbench& bench);
// Dialogs that ask for files, and whether to leave unsaved changes.
void drawFiles(Workbench& bench);
// Opens the dialog of open, saveAs or savePicture.
void askForFile(Workbench& bench, Action action);

// The panel that an action opens, if it opens one.
std::optional<Tab> tabOf(Action action);

void drawGallery(Workbench& bench);
void drawSun(Workbench& bench);
void drawWind(Workbench& bench);
// The weather of a layer from above, painted with a brush.
void drawWeather(Workbench& bench);
void drawCamera(Workbench& bench);
void drawFilm(Workbench& bench);
void drawPace(Workbench& bench);
// Cuts through the clouds, and the noise textures.
void drawInspect(Workbench& bench);
void drawReference(Workbench& bench);
// Every parameter, from the field tables.
void drawParameters(Workbench& bench);
// The fields of one section, for panels about one thing.
void drawSection(Workbench& bench, const std::string& path);
// The widget of one parameter: slider, choice, text ... with unit, tooltip and a button back to the default.
void drawField(Workbench& bench, const Section& section, const Field& field);

}  // namespace welkin::viewer
