#include "welkin/io/mitsuba_volume.hpp"

#include <bit>
#include <cstring>
#include <ostream>

#include "welkin/io/file.hpp"

namespace welkin {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

void saveMitsubaVolume(const std::string& path, const VoxelGrid& grid) {
  struct Header {
    char magic[4] = {'V', 'O', 'L', 3};
    std::int32_t encoding = 1;  // floats
    std::int32_t dims[3];
    std::int32_t channels = 1;
    float low[3], high[3];
  } header{};
  static_assert(sizeof(Header) == 48);
  const glm::dvec3 high = grid.origin() + glm::dvec3(grid.dims()) * grid.voxel();
  for (int c = 0; c < 3; ++c) {
    header.dims[c] = grid.dims()[c];
    header.low[c] = static_cast<float>(grid.origin()[c]);
    header.high[c] = static_cast<float>(high[c]);
  }
  writeStreamAtomically(path, "a Mitsuba volume", [&](std::ostream& file) {
    file.write(reinterpret_cast<const char*>(&header), sizeof header);
    std::vector<float> row(static_cast<std::size_t>(grid.dims().x));
    for (int z = 0; z < grid.dims().z && file; ++z)
      for (int y = 0; y < grid.dims().y; ++y) {
        for (int x = 0; x < grid.dims().x; ++x) row[static_cast<std::size_t>(x)] = grid.at({x, y, z});
        file.write(reinterpret_cast<const char*>(row.data()), static_cast<std::streamsize>(sizeof(float) * row.size()));
      }
  });
}

}  // namespace welkin
