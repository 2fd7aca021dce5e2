#include "welkin/io/vdb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "welkin/base/error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/volume_lattice.hpp"

#if WELKIN_HAS_OPENVDB
#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

namespace welkin {

namespace {

constexpr int kBrick = VoxelGrid::kBrick;
constexpr float kLargestHalf = 65504.0f;
constexpr double kFarthest = 0x1p30;  // voxels, half of what OpenVDB's coordinates reach
constexpr std::size_t kMostNotes = 64, kLongestNote = 1024;

using Brick = std::array<float, VoxelGrid::kBrickVoxels>;

// Calls visit(place in OpenVDB's leaf, place in our brick): z is fastest there, x here.
template <class Visit>
void forVoxels(const Visit& visit) {
  for (int x = 0; x < kBrick; ++x)
    for (int y = 0; y < kBrick; ++y)
      for (int z = 0; z < kBrick; ++z)
        visit((static_cast<openvdb::Index>(x) * kBrick + y) * kBrick + z,
              (static_cast<std::size_t>(z) * kBrick + y) * kBrick + x);
}

openvdb::FloatGrid::Ptr gridOf(const std::string& path, const VoxelGrid& voxels) {
  const VolumeLattice lattice = latticeOf(voxels, path);
  auto grid = openvdb::FloatGrid::create(0.0f);
  auto transform = openvdb::math::Transform::createLinearTransform();
  transform->preScale(openvdb::Vec3d(voxels.voxel().x, voxels.voxel().y, voxels.voxel().z));
  transform->postTranslate(openvdb::Vec3d(lattice.translation.x, lattice.translation.y, lattice.translation.z));
  grid->setTransform(transform);
  const openvdb::Coord offset(lattice.offset.x, lattice.offset.y, lattice.offset.z);
  const glm::ivec3 size = voxels.brickDims();
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const std::uint32_t brick = voxels.brickIndex()[(std::size_t(z) * size.y + y) * size.x + x];
        if (brick == 0) continue;
        const float* values = voxels.values().data() + std::size_t(brick) * VoxelGrid::kBrickVoxels;
        if (std::all_of(values, values + VoxelGrid::kBrickVoxels, [](float v) { return v == 0.0f; })) continue;
        auto* leaf = grid->tree().touchLeaf(offset + openvdb::Coord(kBrick * x, kBrick * y, kBrick * z));
        forVoxels([&](openvdb::Index there, std::size_t here) {
          if (values[here] != 0.0f) leaf->setValueOn(there, values[here]);
        });
      }
  return grid;
}

void note(openvdb::MetaMap& map, const VolumeNote& n) {
  if (const double* real = std::get_if<double>(&n.value))
    map.insertMeta(n.name, openvdb::FloatMetadata(static_cast<float>(*real)));
  else if (const std::int64_t* whole = std::get_if<std::int64_t>(&n.value))
    map.insertMeta(n.name, openvdb::Int64Metadata(*whole));
  else
    map.insertMeta(n.name, openvdb::StringMetadata(std::get<std::string>(n.value)));
}

// What the child sends: this, strings, then pieces until one has an edge of 0.
struct Header {
  glm::ivec3 low, dims;
  std::array<double, 16> indexToWorld;  // columns
};
// A cube of voxels: `edge` is 8 and 512 values follow, x fastest, or it is a larger tile of one value.
struct Piece {
  glm::ivec3 low;
  int edge;
};

void sendText(const Sink& send, const std::string& text) {
  const auto size = static_cast<std::uint32_t>(std::min(text.size(), kLongestNote));
  send(&size, sizeof size);
  send(text.data(), size);
}
std::string receiveText(const Source& receive) {
  std::uint32_t size = 0;
  receive(&size, sizeof size);
  std::string text(std::min<std::size_t>(size, kLongestNote), '\0');
  receive(text.data(), text.size());
  return text;
}

// OpenVDB does not notice when a file ends too early; its directory says where every grid does.
struct Directory : openvdb::io::Archive {
  explicit Directory(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
    readHeader(file);
    setFormatVersion(file);
    setLibraryVersion(file);
    if (!inputHasGridOffsets())
      throw Error(ErrorKind::badInput, path, "was written as a stream, without a directory; write it as a file");
    openvdb::MetaMap().readMeta(file);
    for (int left = readGridCount(file); left > 0; --left) {
      openvdb::io::GridDescriptor grid;
      grid.read(file);
      if (!file || grid.getEndPos() > size || grid.getEndPos() < 0)
        throw Error(ErrorKind::badInput, path, "is cut short");
      grid.seekToEnd(file);
    }
  }
};

// OpenVDB's own File does not notice that its last bytes could not be stored; this writes the same to a stream of ours.
struct Writer : openvdb::io::Archive {
  void save(std::ostream& stream, const openvdb::GridBase::ConstPtr& grid) const {
    stream.exceptions(std::ios::badbit);  // ends at the first block that cannot be stored, not after gigabytes
    Archive::write(stream, openvdb::GridCPtrVec{grid}, true);
  }
};

openvdb::FloatGrid::Ptr readGrid(openvdb::io::File& file, const std::string& path, const std::string& name) {
  std::string chosen, others;
  for (auto i = file.beginName(); i != file.endName(); ++i) {
    const std::string found = i.gridName();
    const bool isFloat = file.readGridMetadata(found)->isType<openvdb::FloatGrid>();
    if (isFloat && (name.empty() ? chosen.empty() || found == "density" : found == name)) chosen = found;
    others += fmt::format("{}'{}'{}", others.empty() ? "" : ", ", found, isFloat ? "" : " (not floats)");
  }
  if (chosen.empty())
    throw Error(ErrorKind::badInput, path,
                fmt::format("holds no float grid{}; it has {}", name.empty() ? "" : " called '" + name + "'",
                            others.empty() ? "no grids" : others));
  auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(chosen));
  if (grid->getGridClass() == openvdb::GRID_LEVEL_SET)
    throw Error(ErrorKind::badInput, path,
                fmt::format("'{}' is a level set, distances from a surface; export a fog volume", chosen));
  if (!grid->transform().isLinear())
    throw Error(ErrorKind::badInput, path,
                fmt::format("'{}' has a frustum transform; export it with a linear one", chosen));
  return grid;
}

void send(const Sink& sink, const std::string& path, const std::string& name, std::size_t most) {
  const Directory whole(path);
  openvdb::io::File file(path);
  file.open(false);  // all at once: no part of the file stays mapped
  const openvdb::FloatGrid::Ptr grid = readGrid(file, path, name);
  const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
  if (box.empty()) throw Error(ErrorKind::badInput, path, fmt::format("'{}' is empty", grid->getName()));
  Header header{};
  for (int c = 0; c < 3; ++c) {
    const double low = box.min()[c], high = box.max()[c];
    if (std::abs(low) > kFarthest || high - low > kFarthest)
      throw Error(ErrorKind::badInput, path,
                  fmt::format("'{}' is {:g} voxels wide; that is too large", grid->getName(), high - low));
    header.low[c] = box.min()[c];
    header.dims[c] = box.max()[c] - box.min()[c] + 1;
  }
  const openvdb::Mat4d map = grid->transform().baseMap()->getAffineMap()->getMat4();
  for (std::size_t row = 0; row < 4; ++row)  // row vectors there, columns here
    for (std::size_t c = 0; c < 4; ++c)
      header.indexToWorld[4 * row + c] = map(static_cast<int>(row), static_cast<int>(c));
  sink(&header, sizeof header);
  sendText(sink, grid->getName());
  const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(grid->metaCount(), kMostNotes));
  sink(&count, sizeof count);
  std::uint32_t sent = 0;
  for (auto i = grid->beginMeta(); i != grid->endMeta() && sent < count; ++i, ++sent) {
    sendText(sink, i->first);
    sendText(sink, i->second->str());
  }
  std::size_t bytes = 0;
  const auto account = [&](std::size_t bricks) {
    bytes += bricks * sizeof(Brick);
    if (bytes > most)
      throw Error(
          ErrorKind::badInput, path,
          fmt::format("'{}' has more than {} MiB of active voxels; it is too large", grid->getName(), most >> 20));
  };
  Brick brick;
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
    account(1);
    const Piece piece{{leaf->origin().x(), leaf->origin().y(), leaf->origin().z()}, kBrick};
    forVoxels([&](openvdb::Index there, std::size_t here) {
      brick[here] = leaf->isValueOn(there) ? leaf->getValue(there) : 0.0f;
    });
    sink(&piece, sizeof piece);
    sink(brick.data(), sizeof brick);
  }
  auto tile = grid->tree().cbeginValueOn();
  tile.setMaxDepth(tile.getLeafDepth() - 1);
  for (; tile; ++tile) {
    openvdb::CoordBBox extent;
    tile.getBoundingBox(extent);
    const int edge = extent.dim().x();
    account(std::size_t(edge / kBrick) * (edge / kBrick) * (edge / kBrick));
    const Piece piece{{extent.min().x(), extent.min().y(), extent.min().z()}, edge};
    sink(&piece, sizeof piece);
    brick.fill(*tile);
    sink(brick.data(), edge == kBrick ? sizeof brick : sizeof(float));
  }
  const Piece end{};
  sink(&end, sizeof end);
}

// Index space scaled to voxels of their true size, and what remains of the transform.
std::pair<VoxelGrid, glm::dmat4> spaceOf(const std::string& path, const Header& header) {
  glm::dmat4 map;
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t r = 0; r < 4; ++r) map[static_cast<int>(c)][static_cast<int>(r)] = header.indexToWorld[4 * c + r];
  const glm::dvec3 voxel(glm::length(glm::dvec3(map[0])), glm::length(glm::dvec3(map[1])),
                         glm::length(glm::dvec3(map[2])));
  const double volume = std::abs(glm::determinant(glm::dmat3(map)));
  if (!(volume > 1e-6 * voxel.x * voxel.y * voxel.z && std::isfinite(volume)))
    throw Error(ErrorKind::badInput, path, "its transform flattens space or is not finite");
  for (int c = 0; c < 3; ++c) map[c] /= voxel[c];
  glm::dvec3 origin = (glm::dvec3(header.low) - 0.5) * voxel;
  if (glm::dmat3(map) == glm::dmat3(1.0)) {
    origin += glm::dvec3(map[3]);
    map = glm::dmat4(1.0);
  }
  return {VoxelGrid(header.dims, origin, voxel), map};
}

void fill(VoxelGrid& grid, const Header& header, const Piece& piece, const Brick& values) {
  const glm::ivec3 corner = piece.low - header.low;
  const glm::ivec3 low = glm::max(corner, glm::ivec3(0)), high = glm::min(corner + piece.edge, header.dims);
  for (int z = low.z; z < high.z; ++z)
    for (int y = low.y; y < high.y; ++y)
      for (int x = low.x; x < high.x; ++x) {
        const glm::ivec3 in = glm::ivec3(x, y, z) - corner;
        const float v = piece.edge > kBrick ? values[0] : values[(std::size_t(in.z) * kBrick + in.y) * kBrick + in.x];
        grid.set({x, y, z}, v < 0.0f ? 0.0f : v);
      }
}

VdbGrid receiveGrid(const Source& receive, const std::string& path, int margin) {
  Header header{};
  receive(&header, sizeof header);
  header.low -= margin;
  header.dims += 2 * margin;
  auto [voxels, placement] = spaceOf(path, header);
  VdbGrid grid{std::move(voxels), placement, receiveText(receive), {}};
  std::uint32_t count = 0;
  receive(&count, sizeof count);
  for (std::uint32_t i = 0; i < std::min<std::size_t>(count, kMostNotes); ++i) {
    std::string name = receiveText(receive);
    grid.notes[std::move(name)] = receiveText(receive);
  }
  Brick values{};
  for (Piece piece{};;) {
    receive(&piece, sizeof piece);
    if (piece.edge == 0) return grid;
    receive(values.data(), piece.edge == kBrick ? sizeof values : sizeof(float));
    fill(grid.voxels, header, piece, values);
  }
}

}  // namespace

bool hasOpenVdb() { return true; }
std::string openVdbVersion() { return OPENVDB_LIBRARY_VERSION_STRING; }

void saveVdb(const std::string& path, const VoxelGrid& voxels, std::span<const VolumeNote> notes,
             VolumePrecision precision, const std::string& name) {
  if (precision == VolumePrecision::half && voxels.maximum() > kLargestHalf)
    throw Error(ErrorKind::badInput, path,
                fmt::format("the value {} does not fit half precision; write full floats", voxels.maximum()));
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr grid = gridOf(path, voxels);
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setSaveFloatAsHalf(precision == VolumePrecision::half);
  grid->setCreator("Welkin");
  for (const VolumeNote& n : notes) note(*grid, n);
  writeStreamAtomically(path, "OpenVDB", [&](std::ostream& stream) { Writer().save(stream, grid); });
}

VdbGrid loadVdb(const std::string& path, const std::string& name, const IsolationLimits& limits, int margin) {
  std::error_code wrong;
  if (!std::filesystem::is_regular_file(path, wrong))
    throw Error(ErrorKind::badInput, path, "cannot be read: there is no such file");
  openvdb::initialize();
  std::vector<VdbGrid> read;
  runIsolated(
      path, limits, [&](const Sink& sink) { send(sink, path, name, limits.bytes); },
      [&](const Source& source) {
        try {
          read.push_back(receiveGrid(source, path, margin));
        } catch (const Error& e) {
          if (!e.where().empty()) throw;
          throw Error(e.kind(), path, e.what());
        }
      });
  return std::move(read.front());
}

}  // namespace welkin

#else

namespace welkin {

namespace {
[[noreturn]] void absent(const std::string& path) {
  throw Error(ErrorKind::failed, path,
              "needs OpenVDB, which this build of Welkin is without: install libopenvdb-dev and build it again");
}
}  // namespace

bool hasOpenVdb() { return false; }
std::string openVdbVersion() { return ""; }
void saveVdb(const std::string& path, const VoxelGrid&, std::span<const VolumeNote>, VolumePrecision,
             const std::string&) {
  absent(path);
}
VdbGrid loadVdb(const std::string& path, const std::string&, const IsolationLimits&, int) { absent(path); }

}  // namespace welkin

#endif
