// A sky of one's own: derive from welkin::SkyModel, and every table, lookup and renderer takes it like a built-in one.
// Here: the CIE standard overcast sky (Moon and Spencer 1942), three times brighter overhead than at the horizon.
#include <cstdio>
#include <numbers>

#include "welkin/atmosphere/sun.hpp"
#include "welkin/atmosphere/tables.hpp"

class OvercastSky : public welkin::SkyModel {
 public:
  // `zenith` is the radiance overhead in linear Rec.709 and kcd/m^2.
  explicit OvercastSky(const glm::vec3& zenith) : zenith_(zenith) {}

  // `direction` is a unit vector (east, north, up).
  glm::vec3 radiance(const glm::vec3& direction) const override {
    return zenith_ * (1.0f + 2.0f * glm::max(direction.z, 0.0f)) / 3.0f;
  }

  // A renderer fills its tables anew when this number changes.
  std::uint64_t revision() const override { return revision_; }
  void setZenith(const glm::vec3& zenith) {
    zenith_ = zenith;
    ++revision_;
  }

 private:
  glm::vec3 zenith_;
  std::uint64_t revision_ = 0;
};

int main() {
  const OvercastSky overcast({6.0f, 6.3f, 6.8f});
  welkin::Sun noon;
  noon.mode = welkin::SunMode::place;
  noon.date = "2026-06-21";
  noon.time = "13:00";
  noon.utcOffset = 2 * 3600.0f;
  const double cameraAltitude = 150.0;  // m

  const welkin::SkyTablesCpu sky = welkin::bakeSky({}, noon, cameraAltitude, welkin::kDefaultGroundAlbedo, &overcast);

  const glm::vec3 sun(sky.params.air.sunDirection);
  std::printf("sun: %.3f east, %.3f north, %.3f up\n", sun.x, sun.y, sun.z);
  for (const double elevation : {0.0, 30.0, 60.0, 90.0}) {
    const glm::vec3 view(welkin::directionFromAngles(0.0, elevation * std::numbers::pi / 180.0));
    const glm::vec3 c = welkin::law::lookupSky(sky.skyView.view(), sky.params.air, view);
    std::printf("%2.0f degrees up: %.3f %.3f %.3f kcd/m^2\n", elevation, c.x, c.y, c.z);
  }
  const double irradiance = welkin::luminance(sky.light.skyIrradiance);
  const double exact = 7.0 * std::numbers::pi / 9.0 * welkin::luminance(overcast.radiance({0, 0, 1}));
  std::printf("the sky gives the ground %.2f klx; exactly %.2f\n", irradiance, exact);
}
