#pragma once
// The camera over a map: it hangs over a point of the ground, from straight above down to a slant. Pure, as
// navigation.hpp is.
#include "apps/viewer/model/map_picture.hpp"
#include "welkin/scene/scene.hpp"

namespace welkin::viewer {

// From straight above, so high that the map fills a picture of this aspect (width by height) if that is not too high;
// north is up. Lens and the rest stay as they are.
Camera cameraOver(const Camera& camera, const MapPicture& map, double aspect);

// Drags by a share of the picture's width: the ground goes along with the pointer.
void slideMap(Camera& camera, const glm::vec2& drag);
// Turns round the point in the middle and tilts.
void swingMap(Camera& camera, const glm::vec2& drag);
// Nearer to that point by clicks of a wheel.
void zoomMap(Camera& camera, float clicks);

}  // namespace welkin::viewer
