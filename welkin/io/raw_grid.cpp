#include "welkin/io/raw_grid.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"

namespace welkin {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "raw grids are read as they lie in the file");

constexpr std::size_t kMostHeader = 1 << 16;
constexpr double kMostVoxels = 0x1p31;

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw Error(ErrorKind::badInput, where, what);
}

int sizeNamed(const json& header, const char* name, const std::string& where) {
  const auto at = header.find(name);
  if (at == header.end()) refuse(where, fmt::format("has width, height or depth, but no '{}'", name));
  if (!at->is_number_integer() || *at < 1 || *at > 1 << 24)
    refuse(where, fmt::format("'{}' must be a whole number from 1 to 2^24", name));
  return at->get<int>();
}

glm::dvec3 voxelOf(const json& header, const std::string& where) {
  const json& voxel = header["voxel"];
  glm::dvec3 size(0.0);
  if (!voxel.is_array() || voxel.size() != 3) refuse(where, "'voxel' must be an array of three sizes in m");
  for (int k = 0; k < 3; ++k) {
    if (!voxel[std::size_t(k)].is_number()) refuse(where, "'voxel' must be an array of three sizes in m");
    size[k] = voxel[std::size_t(k)].get<double>();
  }
  return size;
}

// The rows of a file whose size is right. Errors do not name it yet.
VoxelGrid readRows(const std::string& path, const glm::ivec3& n, const glm::dvec3& voxel) {
  VoxelGrid grid(n, glm::dvec3(0.0), voxel);
  std::ifstream file(path, std::ios::binary);
  std::vector<float> row(static_cast<std::size_t>(n.x));
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y) {
      if (!file.read(reinterpret_cast<char*>(row.data()), std::streamsize(row.size() * sizeof(float))))
        refuse("", "cannot be read to its end");
      for (int x = 0; x < n.x; ++x) grid.set({x, y, z}, row[std::size_t(x)]);
    }
  return grid;
}

}  // namespace

RawGridLayout parseRawGridHeader(std::string_view text, const std::string& where) {
  const json header = json::parse(text, nullptr, false);
  if (!header.is_object()) refuse(where, "is not a JSON object");
  RawGridLayout layout;
  if (header.contains("width") || header.contains("height") || header.contains("depth"))
    layout.dims = glm::ivec3(sizeNamed(header, "width", where), sizeNamed(header, "height", where),
                             sizeNamed(header, "depth", where));
  if (header.contains("voxel")) layout.voxel = voxelOf(header, where);
  if (header.contains("channels") && header["channels"] != 1) refuse(where, "a grid has one channel");
  if (header.contains("type") && header["type"] != "float32 little-endian")
    refuse(where, "'type' must be \"float32 little-endian\"");
  return layout;
}

VoxelGrid loadRawGrid(const std::string& path, const RawGridLayout& layout) {
  RawGridLayout full = layout;
  std::error_code none;
  if (const std::string header = path + ".json"; std::filesystem::exists(header, none)) {
    const RawGridLayout written = parseRawGridHeader(readFile(header, kMostHeader), header);
    if (!full.dims) full.dims = written.dims;
    if (!full.voxel) full.voxel = written.voxel;
  }
  if (!full.dims) refuse(path, "how many voxels? give the grid's dims, or a header beside it, " + path + ".json");
  if (!full.voxel) refuse(path, "how large are its voxels? give their size in m, or a header beside it that does");
  const glm::ivec3 n = *full.dims;
  if (n.x < 1 || n.y < 1 || n.z < 1 || double(n.x) * n.y * n.z > kMostVoxels)
    refuse(path, fmt::format("{} x {} x {} voxels: from 1 to 2^31 can be read", n.x, n.y, n.z));
  std::error_code failed;
  const std::uintmax_t bytes = std::filesystem::file_size(path, failed), wanted = 4ull * n.x * n.y * n.z;
  if (failed) refuse(path, "cannot be read: " + failed.message());
  if (bytes != wanted)
    refuse(path, fmt::format("has {} bytes, but {} x {} x {} floats are {}", bytes, n.x, n.y, n.z, wanted));
  try {
    return readRows(path, n, *full.voxel);
  } catch (const Error& e) {
    refuse(path, e.what());
  }
}

}  // namespace welkin
