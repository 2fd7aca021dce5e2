#pragma once
// Pictures of a sky, and the files that they go to.
#include <string>
#include <vector>

#include "welkin/base/image.hpp"
#include "welkin/base/progress.hpp"
#include "welkin/noise/volume.hpp"
#include "welkin/realtime/renderer.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::app {

struct RenderOptions {
  int width = 1280, height = 720;
  int frames = 0;  // temporal frames that make the picture; 0 lets the quality decide
  Progress progress;
};

// The authoring map of every layer that names a picture, at the layer's index: RGBA, south row first. Throws Error
// (badInput) for a picture that cannot be read.
std::vector<Volume> weatherMaps(const Scene& scene);

// What the scene names in files, for the real-time renderer. Throws Error (badInput) for what cannot be read.
realtime::CustomTextures texturesOf(const Scene& scene);

// The sky through its camera by the real-time renderer: linear RGB in kcd/m^2. Throws Error (noOpenGl).
Image renderSky(const Scene& scene, const RenderOptions& options);

// Reads .png (values as stored), .exr or .hdr (linear light). Throws Error (badInput), UsageError for another name.
Image loadPicture(const std::string& path);

// Whether the file holds what a display shows (.png) rather than light.
bool isDisplayPicture(const std::string& path);

// Throws UsageError unless the file ends in .png or .exr, and Error (failed) when it cannot be written.
void requirePictureFile(const std::string& path);

// How the film shows light, its exposure given.
ToneSettings toneOf(const Film& film, double ev);

// Writes .png (tone-mapped, 8 bit) or .exr (linear floats).
void savePicture(const std::string& path, const Image& light, const Film& film);

}  // namespace welkin::app
