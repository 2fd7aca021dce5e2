// SIMD kernels of the noise textures, once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/noise/bake.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h comes first.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "welkin/base/parallel.hpp"
#include "welkin/noise/bake.hpp"
#include "welkin/noise/rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

// The planes of one row: channels side by side, each padded to whole vectors.
class RowBuffer {
 public:
  RowBuffer(const Volume& volume, std::size_t planes)
      : stride_(paddedToLanes(static_cast<std::size_t>(volume.width))), texels_(planes * stride_) {}
  float* plane(std::size_t p) { return texels_.data() + p * stride_; }
  std::size_t stride() const { return stride_; }

  // Interleaves the first planes into the volume's row.
  void store(Volume& volume, std::size_t row) const {
    const auto width = static_cast<std::size_t>(volume.width), channels = static_cast<std::size_t>(volume.channels);
    float* out = volume.texels.data() + row * width * channels;
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t i = 0; i < width; ++i) out[i * channels + c] = texels_[c * stride_ + i];
  }

 private:
  std::size_t stride_;
  std::vector<float> texels_;
};

// Calls body(row, y, z) for all rows of a volume in `begin` to `end`.
template <class Body>
static void forRows(const Volume& volume, std::size_t begin, std::size_t end, const Body& body) {
  const auto height = static_cast<std::size_t>(volume.height);
  for (std::size_t row = begin; row < end; ++row)
    body(row, static_cast<int>(row % height), static_cast<int>(row / height));
}
static std::size_t rowCount(const Volume& volume) { return static_cast<std::size_t>(volume.height) * volume.depth; }

// Four inverted Worley noises of doubling frequency.
class WorleyLattices {
 public:
  WorleyLattices(int size, int cells, std::uint32_t seed)
      : rows_{{size, cells, 1, seed},
              {size, cells, 2, seed + 1},
              {size, cells, 4, seed + 2},
              {size, cells, 8, seed + 3}} {}
  void row(int y, int z, RowBuffer& buffer) {
    for (std::size_t k = 0; k < 4; ++k) {
      float* out = buffer.plane(k);
      rows_[k].row(y, z, [&](std::size_t i, Real f1) { storeReal(law::worleyInverted(f1), out + i); });
    }
  }
  static law::Vec4 load(RowBuffer& buffer, std::size_t i) {
    return law::Vec4(loadReal(buffer.plane(0) + i), loadReal(buffer.plane(1) + i), loadReal(buffer.plane(2) + i),
                     loadReal(buffer.plane(3) + i));
  }

 private:
  WorleyRows rows_[4];
};

// fBm of billows.
class BillowRows {
 public:
  BillowRows(int size, int cells, int octaves, float gain, std::uint32_t seed) {
    float weight = 1.0f;
    for (int o = 0; o < octaves; ++o) {
      rows_.emplace_back(size, cells, 1 << o, seed + static_cast<std::uint32_t>(o));
      weights_.push_back(weight);
      total_ += weight;
      weight *= gain;
    }
  }
  void row(int y, int z, float* out, std::size_t count) {
    for (std::size_t o = 0; o < rows_.size(); ++o)
      rows_[o].row(y, z, [&](std::size_t i, Real f1) {
        const Real term = weights_[o] * law::billow(f1);
        storeReal(o == 0 ? term : loadReal(out + i) + term, out + i);
      });
    for (std::size_t i = 0; i < count; i += law::laneCount()) storeReal(loadReal(out + i) / total_, out + i);
  }

 private:
  std::vector<WorleyRows> rows_;
  std::vector<float> weights_;
  float total_ = 0;
};

static Real itself(Real n) { return n; }

static void fillBaseShape(const one::BaseShapeParams& params, Volume& volume) {
  parallelFor(rowCount(volume), 64, [&](std::size_t begin, std::size_t end) {
    const auto p = std::bit_cast<law::BaseShapeParams>(params);
    PerlinRows perlin(volume.width, p.perlinCells, p.perlinOctaves, p.perlinGain, p.seed);
    WorleyLattices worley(volume.width, p.worleyCells, p.seed + law::kWorleySeed);
    RowBuffer rows(volume, 5);
    forRows(volume, begin, end, [&](std::size_t row, int y, int z) {
      perlin.row(y, z, itself, rows.plane(4));
      worley.row(y, z, rows);
      for (std::size_t i = 0; i < rows.stride(); i += law::laneCount()) {
        const law::Vec4 v = law::baseShapeOf(loadReal(rows.plane(4) + i), WorleyLattices::load(rows, i), p);
        const Vec2 packed = law::baseShapePacked(v);
        storeReal(v.x, rows.plane(0) + i);
        storeReal(volume.channels == 2 ? packed.y : v.y, rows.plane(1) + i);
        storeReal(v.z, rows.plane(2) + i);
        storeReal(v.w, rows.plane(3) + i);
      }
      rows.store(volume, row);
    });
  });
}

static void fillDetail(const one::DetailParams& params, Volume& volume) {
  parallelFor(rowCount(volume), 64, [&](std::size_t begin, std::size_t end) {
    const auto p = std::bit_cast<law::DetailParams>(params);
    WorleyLattices worley(volume.width, p.worleyCells, p.seed + law::kWorleySeed);
    RowBuffer rows(volume, 4);
    forRows(volume, begin, end, [&](std::size_t row, int y, int z) {
      worley.row(y, z, rows);
      for (std::size_t i = 0; i < rows.stride(); i += law::laneCount()) {
        const Vec3 v = law::detailOf(WorleyLattices::load(rows, i), p);
        storeReal(volume.channels == 1 ? law::detailPacked(v) : v.x, rows.plane(0) + i);
        storeReal(v.y, rows.plane(1) + i);
        storeReal(v.z, rows.plane(2) + i);
      }
      rows.store(volume, row);
    });
  });
}

static void fillProfileBase(const one::ProfileBaseParams& params, Volume& volume) {
  parallelFor(rowCount(volume), 64, [&](std::size_t begin, std::size_t end) {
    const auto p = std::bit_cast<law::ProfileBaseParams>(params);
    PerlinRows perlin(volume.width, p.perlinCells, p.perlinOctaves, p.perlinGain, p.seed);
    BillowRows billows(volume.width, p.billowCells, p.billowOctaves, p.billowGain, p.seed + law::kWorleySeed);
    RowBuffer rows(volume, 2);
    forRows(volume, begin, end, [&](std::size_t row, int y, int z) {
      perlin.row(y, z, itself, rows.plane(0));
      billows.row(y, z, rows.plane(1), rows.stride());
      for (std::size_t i = 0; i < rows.stride(); i += law::laneCount()) {
        const Vec2 raw = law::profileBaseRawOf(loadReal(rows.plane(0) + i), loadReal(rows.plane(1) + i));
        const Vec2 v = law::profileBaseStretched(raw, p);
        storeReal(volume.channels == 1 ? law::profileBasePacked(v, p) : v.x, rows.plane(0) + i);
        storeReal(v.y, rows.plane(1) + i);
      }
      rows.store(volume, row);
    });
  });
}

static void fillProfileDetail(const one::ProfileDetailParams& params, Volume& volume) {
  parallelFor(rowCount(volume), 64, [&](std::size_t begin, std::size_t end) {
    const auto p = std::bit_cast<law::ProfileDetailParams>(params);
    BillowRows billows(volume.width, p.cells, p.octaves, p.gain, p.seed + law::kWorleySeed);
    PerlinRows perlin(volume.width, p.cells, p.octaves, p.gain, p.seed);
    const auto ridge = [&](Real n) { return law::max(0.0f, 1.0f - p.ridgeSlope * law::abs(n)); };
    RowBuffer rows(volume, 2);
    forRows(volume, begin, end, [&](std::size_t row, int y, int z) {
      billows.row(y, z, rows.plane(0), rows.stride());
      perlin.row(y, z, ridge, rows.plane(1));
      for (std::size_t i = 0; i < rows.stride(); i += law::laneCount()) {
        const Vec2 raw(loadReal(rows.plane(0) + i), loadReal(rows.plane(1) + i));
        const Vec2 v = law::profileDetailStretched(raw, p);
        storeReal(v.x, rows.plane(0) + i);
        storeReal(v.y, rows.plane(1) + i);
      }
      rows.store(volume, row);
    });
  });
}

static void fillBillows(int cells, std::uint32_t seed, Volume& volume) {
  parallelFor(rowCount(volume), 64, [&](std::size_t begin, std::size_t end) {
    BillowRows billows(volume.width, cells, 1, 1.0f, seed);
    RowBuffer rows(volume, 1);
    forRows(volume, begin, end, [&](std::size_t row, int y, int z) {
      billows.row(y, z, rows.plane(0), rows.stride());
      rows.store(volume, row);
    });
  });
}

// Two channels straight from the law, for small textures.
template <class Texel>
static void fillDirectly(Volume& volume, const Texel& texel) {
  parallelFor(rowCount(volume), 16, [&](std::size_t begin, std::size_t end) {
    RowBuffer rows(volume, 2);
    forRows(volume, begin, end, [&](std::size_t row, int y, int z) {
      for (std::size_t i = 0; i < rows.stride(); i += law::laneCount()) {
        const Real u = (law::toReal(iota(static_cast<int>(i))) + 0.5f) / static_cast<float>(volume.width);
        const Vec2 v = texel(Vec3(u, texelCentre(y, volume.height), texelCentre(z, volume.depth)));
        storeReal(v.x, rows.plane(0) + i);
        storeReal(v.y, rows.plane(1) + i);
      }
      rows.store(volume, row);
    });
  });
}
static void fillCurl(const one::CurlParams& params, Volume& volume) {
  const auto p = std::bit_cast<law::CurlParams>(params);
  fillDirectly(volume, [&](const Vec3& uvw) { return law::curlTexel(law::xy(uvw), p); });
}
static void fillProfileWarp(const one::ProfileWarpParams& params, Volume& volume) {
  const auto p = std::bit_cast<law::ProfileWarpParams>(params);
  fillDirectly(volume, [&](const Vec3& uvw) { return law::profileWarpTexel(uvw, p); });
}

template <class Raw>
static std::vector<glm::vec2> measure(std::span<const glm::vec3> points, const Raw& raw) {
  const std::size_t count = paddedToLanes(points.size()), lanes = law::laneCount();
  std::vector<float> in(3 * count), out(2 * count);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 3; ++c) in[static_cast<std::size_t>(c) * count + i] = points[i][c];
  parallelFor(count / lanes, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * lanes; i < end * lanes; i += lanes) {
      const Vec2 v = raw(Vec3(loadReal(&in[i]), loadReal(&in[count + i]), loadReal(&in[2 * count + i])));
      storeReal(v.x, &out[i]);
      storeReal(v.y, &out[count + i]);
    }
  });
  std::vector<glm::vec2> values(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) values[i] = {out[i], out[count + i]};
  return values;
}
static std::vector<glm::vec2> measureProfileBase(const one::ProfileBaseParams& params,
                                                 std::span<const glm::vec3> points) {
  const auto p = std::bit_cast<law::ProfileBaseParams>(params);
  return measure(points, [&](const Vec3& uvw) { return law::profileBaseRaw(uvw, p); });
}
static std::vector<glm::vec2> measureProfileDetail(const one::ProfileDetailParams& params,
                                                   std::span<const glm::vec3> points) {
  const auto p = std::bit_cast<law::ProfileDetailParams>(params);
  return measure(points, [&](const Vec3& uvw) { return law::profileDetailRaw(uvw, p); });
}
static std::vector<glm::vec2> measureProfileWarp(const one::ProfileWarpParams& params,
                                                 std::span<const glm::vec3> points) {
  const auto p = std::bit_cast<law::ProfileWarpParams>(params);
  return measure(points, [&](const Vec3& uvw) { return law::profileWarpRaw(uvw, p); });
}

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
HWY_EXPORT(fillBaseShape);
HWY_EXPORT(fillDetail);
HWY_EXPORT(fillCurl);
HWY_EXPORT(fillProfileBase);
HWY_EXPORT(fillProfileDetail);
HWY_EXPORT(fillProfileWarp);
HWY_EXPORT(fillBillows);
HWY_EXPORT(measureProfileBase);
HWY_EXPORT(measureProfileDetail);
HWY_EXPORT(measureProfileWarp);

namespace bake {
void fillBaseShape(const law::BaseShapeParams& p, Volume& v) { HWY_DYNAMIC_DISPATCH(fillBaseShape)(p, v); }
void fillDetail(const law::DetailParams& p, Volume& v) { HWY_DYNAMIC_DISPATCH(fillDetail)(p, v); }
void fillCurl(const law::CurlParams& p, Volume& v) { HWY_DYNAMIC_DISPATCH(fillCurl)(p, v); }
void fillProfileBase(const law::ProfileBaseParams& p, Volume& v) { HWY_DYNAMIC_DISPATCH(fillProfileBase)(p, v); }
void fillProfileDetail(const law::ProfileDetailParams& p, Volume& v) { HWY_DYNAMIC_DISPATCH(fillProfileDetail)(p, v); }
void fillProfileWarp(const law::ProfileWarpParams& p, Volume& v) { HWY_DYNAMIC_DISPATCH(fillProfileWarp)(p, v); }
void fillBillows(int cells, std::uint32_t seed, Volume& v) { HWY_DYNAMIC_DISPATCH(fillBillows)(cells, seed, v); }
std::vector<glm::vec2> measureProfileBase(const law::ProfileBaseParams& p, std::span<const glm::vec3> points) {
  return HWY_DYNAMIC_DISPATCH(measureProfileBase)(p, points);
}
std::vector<glm::vec2> measureProfileDetail(const law::ProfileDetailParams& p, std::span<const glm::vec3> points) {
  return HWY_DYNAMIC_DISPATCH(measureProfileDetail)(p, points);
}
std::vector<glm::vec2> measureProfileWarp(const law::ProfileWarpParams& p, std::span<const glm::vec3> points) {
  return HWY_DYNAMIC_DISPATCH(measureProfileWarp)(p, points);
}
}  // namespace bake
}  // namespace welkin
#endif
