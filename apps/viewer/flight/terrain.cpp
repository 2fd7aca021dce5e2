#include "apps/viewer/flight/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "welkin/noise/law.hpp"

namespace welkin::viewer {

namespace {

constexpr double kFarthest = 4e6;  // m

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Terrain::Terrain(unsigned seed, const Runway& runway) : seed_(seed), runway_(runway) {}

// Perlin noise of cells of `size` m; -1 to 1.
double Terrain::noise(double east, double north, double size, unsigned salt) const {
  const double x = east / size + 0.37 * salt, y = north / size - 0.53 * salt;
  const double cx = std::floor(x), cy = std::floor(y);
  return static_cast<double>(law::perlin2At(glm::ivec2(static_cast<int>(cx), static_cast<int>(cy)),
                                            glm::vec2(static_cast<float>(x - cx), static_cast<float>(y - cy)), 0,
                                            seed_ * 131u + salt));
}

glm::dvec2 Terrain::runwayPlace(double along, double right) const {
  const double s = std::sin(runway_.heading), c = std::cos(runway_.heading);
  return {along * s + right * c, along * c - right * s};
}

glm::dvec2 Terrain::alongAndRight(double east, double north) const {
  const double s = std::sin(runway_.heading), c = std::cos(runway_.heading);
  return {east * s + north * c, east * c - north * s};
}

double Terrain::height(double east, double north) const {
  if (!std::isfinite(east) || !std::isfinite(north)) return 0.0;
  const double x = std::clamp(east, -kFarthest, kFarthest), y = std::clamp(north, -kFarthest, kFarthest);
  const glm::dvec2 place = alongAndRight(x, y);
  const double away = std::hypot(x, y);

  // How far inland: the sea lies to the left of the take-off, some kilometres off, and ahead; beyond, noise decides.
  const double wide = 0.75 * noise(x, y, 61000.0, 1) + 0.35 * noise(x, y, 23000.0, 2) + 0.16 * noise(x, y, 7300.0, 3) +
                      0.06 * noise(x, y, 2100.0, 4) + 0.02 * noise(x, y, 560.0, 5);
  const double home = 0.28 + place.y / 16000.0 - 0.25 * smooth(5000.0, 13000.0, place.x);
  const double nearHome = 1.0 - smooth(6000.0, 42000.0, away);
  const double inland = wide * (1.0 - 0.8 * nearHome) + 0.12 + (std::clamp(home, -0.6, 0.9) - 0.12) * nearHome;
  if (inland < -0.3) return -60.0;

  const double plain = 900.0 * inland * std::abs(inland) + 60.0 * inland;
  double hills = 0.0, weight = 1.0;
  unsigned salt = 10;
  for (double size = 3700.0; size > 60.0; size *= 0.49, weight *= 0.5) hills += weight * noise(x, y, size, salt++);
  const double rough = smooth(0.0, 0.5, inland) * (0.35 + 0.65 * smooth(-0.3, 0.5, noise(x, y, 9000.0, 6)));
  // Sharp crests, whose slopes are rougher the higher they stand.
  const double uplands = smooth(0.38, 0.95, inland);
  double crests = 0.0, carried = 1.0;
  if (uplands > 0.0) {
    weight = 0.5;
    for (double size = 11000.0; size > 90.0; size *= 0.485, weight *= 0.52) {
      double ridge = 1.0 - std::abs(1.35 * noise(x, y, size, salt++));
      ridge *= ridge;
      crests += weight * ridge * carried;
      carried = std::clamp(1.4 * ridge, 0.0, 1.0);
    }
  }
  double h = plain + 85.0 * rough * (hills + 0.35) + 2600.0 * uplands * std::max(crests - 0.22, 0.0);
  if (h < 0.0) h *= 0.6;

  // Level ground for the runway, a gentle corridor before and behind it.
  const double beside = std::abs(place.y), beyond = std::abs(place.x) - 0.5 * runway_.length;
  const double level = (1.0 - smooth(90.0, 700.0, beside)) * (1.0 - smooth(120.0, 1100.0, beyond));
  const double corridor = (1.0 - smooth(400.0, 2200.0, beside)) * (1.0 - smooth(600.0, 5200.0, beyond));
  h += (std::clamp(h, -3.0, runway_.elevation + 6.0) - h) * corridor;
  return h + (runway_.elevation - h) * level;
}

double Terrain::woods(double east, double north) const {
  return noise(east, north, 2600.0, 60) + 0.6 * noise(east, north, 900.0, 61) + 0.35 * noise(east, north, 310.0, 62);
}

Surface Terrain::surface(double east, double north) const {
  Surface s;
  s.height = height(east, north);
  const glm::dvec2 place = alongAndRight(east, north);
  s.paved = std::abs(place.x) <= 0.5 * runway_.length && std::abs(place.y) <= 0.5 * runway_.width;
  if (s.height <= 0.0) {
    s.height = 0.0;
    s.water = true;
    return s;
  }
  constexpr double kStep = 4.0;
  s.normal = glm::normalize(glm::dvec3(height(east - kStep, north) - height(east + kStep, north),
                                       height(east, north - kStep) - height(east, north + kStep), 2.0 * kStep));
  return s;
}

}  // namespace welkin::viewer
