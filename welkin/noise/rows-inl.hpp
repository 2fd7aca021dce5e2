// Noise along whole rows of texels: the law's own functions, with what a row or its lattice points share computed once.
// The numbers are the law's, bit for bit. Include it after hwy/foreach_target.h.
#if defined(WELKIN_NOISE_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef WELKIN_NOISE_ROWS_INL
#undef WELKIN_NOISE_ROWS_INL
#else
#define WELKIN_NOISE_ROWS_INL
#endif
#include <cstdint>
#include <vector>

#include "welkin/noise/law-inl.hpp"
#include "welkin/noise/law.hpp"

HWY_BEFORE_NAMESPACE();
namespace welkin::HWY_NAMESPACE {

namespace one = ::welkin::law;  // the scalar reading: the same operations, so the same bits
using law::Int, law::Real, law::Uint, law::Vec2, law::Vec3;

inline std::size_t paddedToLanes(std::size_t count) {
  const std::size_t lanes = law::laneCount();
  return (count + lanes - 1) / lanes * lanes;
}
HWY_INLINE Real loadReal(const float* p) { return law::hn::LoadU(law::D(), p); }
HWY_INLINE void storeReal(Real x, float* p) { law::hn::StoreU(x.v, law::D(), p); }
HWY_INLINE Int loadInt(const std::int32_t* p) { return law::hn::LoadU(law::DI(), p); }
HWY_INLINE Int iota(std::int32_t first) { return law::hn::Iota(law::DI(), first); }

inline float texelCentre(int i, int size) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(size); }

// Where the texels of an edge stand in a lattice; the same for x, y and z. The last texel is repeated up to whole
// vectors.
struct Places {
  std::vector<float> position, fraction;
  std::vector<std::int32_t> cell;
  explicit Places(std::size_t size) : position(size), fraction(size), cell(size) {}
};

// fBm of a function of Perlin noise.
class PerlinRows {
 public:
  PerlinRows(int size, int cells, int octaves, float gain, std::uint32_t seed) {
    const std::size_t count = paddedToLanes(static_cast<std::size_t>(size));
    float weight = 1.0f;
    for (int o = 0; o < octaves; ++o) {
      octaves_.push_back({cells << o, seed + static_cast<std::uint32_t>(o), weight, Places(count), {}});
      total_ += weight;
      weight *= gain;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float p = texelCentre(std::min(static_cast<int>(i), size - 1), size) * static_cast<float>(cells);
      glm::ivec2 cell(static_cast<int>(std::floor(p)));
      glm::vec2 f(p - std::floor(p));
      for (Octave& octave : octaves_) {
        octave.places.cell[i] = cell.x;
        octave.places.fraction[i] = f.x;
        octave.fade.push_back(one::fadeQuintic(f.x));
        one::refineCell2(cell, f, 2);
      }
    }
    slope_.resize(paddedToLanes(static_cast<std::size_t>(octaves_.back().cells) + 1));
    value_.resize(slope_.size());
  }

  template <class Shape>
  void row(int y, int z, const Shape& shape, float* out) {
    for (const Octave& octave : octaves_) addOctave(octave, y, z, shape, &octave == octaves_.data(), out);
    for (std::size_t i = 0; i < octaves_[0].fade.size(); i += law::laneCount())
      storeReal(loadReal(out + i) / total_, out + i);
  }

 private:
  struct Octave {
    int cells;
    std::uint32_t seed;
    float weight;
    Places places;
    std::vector<float> fade;
  };

  // The noise along a row is a line in x about each of its lattice points, blended.
  void lines(const Octave& octave, int y, int z) {
    const Places& at = octave.places;
    const int n = octave.cells, cy = at.cell[y], cz = at.cell[z];
    const std::uint32_t layer0 = one::hashChain(one::wrapCell(cz, n), one::hashSeed(octave.seed));
    const std::uint32_t layer1 = one::hashChain(one::wrapCell(cz + 1, n), one::hashSeed(octave.seed));
    const std::int32_t y0 = one::wrapCell(cy, n), y1 = one::wrapCell(cy + 1, n);
    const Uint row00 = one::hashChain(y0, layer0), row10 = one::hashChain(y1, layer0);
    const Uint row01 = one::hashChain(y0, layer1), row11 = one::hashChain(y1, layer1);
    for (int x = 0; x <= n; x += static_cast<int>(law::laneCount())) {
      const Vec2 line = law::perlin3Side(law::wrapCell(iota(x), n), row00, row10, row01, row11, at.fraction[y],
                                         at.fraction[z], octave.fade[y], octave.fade[z]);
      storeReal(line.x, slope_.data() + x);
      storeReal(line.y, value_.data() + x);
    }
  }

  template <class Shape>
  void addOctave(const Octave& octave, int y, int z, const Shape& shape, bool first, float* out) {
    lines(octave, y, z);
    const std::size_t lanes = law::laneCount();
    const std::int32_t* cell = octave.places.cell.data();
    for (std::size_t i = 0; i < octave.fade.size(); i += lanes) {
      Vec2 left, right;
      if (cell[i] == cell[i + lanes - 1]) {
        left = Vec2(slope_[cell[i]], value_[cell[i]]);
        right = Vec2(slope_[cell[i] + 1], value_[cell[i] + 1]);
      } else {
        const Int c = loadInt(cell + i);
        left = Vec2(law::gather(slope_.data(), c), law::gather(value_.data(), c));
        right = Vec2(law::gather(slope_.data() + 1, c), law::gather(value_.data() + 1, c));
      }
      const Real n =
          law::perlinBlend(left, right, loadReal(octave.places.fraction.data() + i), loadReal(&octave.fade[i]));
      const Real term = octave.weight * shape(n);
      storeReal(first ? term : loadReal(out + i) + term, out + i);
    }
  }

  std::vector<Octave> octaves_;
  float total_ = 0;
  std::vector<float> slope_, value_;
};

// F1 of Euclidean Worley noise. Feature points stay as long as the rows come from the same cells of y and z.
class WorleyRows {
 public:
  // Of an octave `scale` times finer than `cells`.
  WorleyRows(int size, int cells, int scale, std::uint32_t seed)
      : cells_(cells * scale), seed_(seed), places_(paddedToLanes(static_cast<std::size_t>(size))) {
    for (std::size_t i = 0; i < places_.position.size(); ++i) {
      const float p = texelCentre(std::min(static_cast<int>(i), size - 1), size) * static_cast<float>(cells) *
                      static_cast<float>(scale);
      places_.position[i] = p;
      places_.cell[i] = static_cast<int>(std::floor(p));
      places_.fraction[i] = p - std::floor(p);
    }
    stride_ = paddedToLanes(static_cast<std::size_t>(cells_) + 2);
    x_.resize(9 * stride_);
    y_.resize(9 * stride_);
    z_.resize(9 * stride_);
    across_.resize(9 * stride_);
  }

  // Answers shape(F1) to add(i, value) for every vector of texels.
  template <class Use>
  void row(int y, int z, const Use& use) {
    if (places_.cell[y] != cellY_ || places_.cell[z] != cellZ_) scatter(places_.cell[y], places_.cell[z]);
    const Real fy = places_.fraction[y], fz = places_.fraction[z];
    for (std::size_t i = 0; i < x_.size(); i += law::laneCount()) {
      const Real dy = loadReal(&y_[i]) - fy, dz = loadReal(&z_[i]) - fz;
      storeReal(dy * dy + dz * dz, &across_[i]);
    }
    const std::size_t lanes = law::laneCount();
    for (std::size_t i = 0; i < places_.cell.size(); i += lanes) {
      const Real p = loadReal(&places_.position[i]);
      Real nearest[3] = {1.0f, 1.0f, 1.0f};
      const std::size_t last = static_cast<std::size_t>(places_.cell[i + lanes - 1]) + 2;
      for (std::size_t c = static_cast<std::size_t>(places_.cell[i]); c <= last; ++c)
        for (std::size_t k = 0; k < 9; ++k) {
          const Real dx = Real(x_[k * stride_ + c]) - p;
          nearest[k % 3] = law::min(nearest[k % 3], dx * dx + across_[k * stride_ + c]);
        }
      use(i, law::sqrt(law::min(law::min(nearest[0], nearest[1]), nearest[2])));
    }
  }

 private:
  // Feature points of the nine rows of cells about (cy, cz), from cell -1 to `cells`: x from the origin, y and z from
  // the cell. Points are multiples of 2^-11, so sums with whole cells are exact.
  void scatter(int cy, int cz) {
    cellY_ = cy;
    cellZ_ = cz;
    std::size_t at = 0;
    for (int dz = -1; dz <= 1; ++dz) {
      const std::uint32_t layer = one::hashChain(one::wrapCell(cz + dz, cells_), one::hashSeed(seed_));
      for (int dy = -1; dy <= 1; ++dy, at += stride_) {
        const Uint row = one::hashChain(one::wrapCell(cy + dy, cells_), layer);
        for (std::size_t c = 0; c < stride_; c += law::laneCount()) {
          const Int x = iota(static_cast<int>(c) - 1);
          const Vec3 point = law::worleyPoint3(law::hashChain(law::wrapCell(x, cells_), row));
          storeReal(law::toReal(x) + point.x, &x_[at + c]);
          storeReal(static_cast<float>(dy) + point.y, &y_[at + c]);
          storeReal(static_cast<float>(dz) + point.z, &z_[at + c]);
        }
      }
    }
  }

  int cells_;
  std::uint32_t seed_;
  Places places_;
  int cellY_ = -1, cellZ_ = -1;
  std::size_t stride_ = 0;
  std::vector<float> x_, y_, z_, across_;
};

}  // namespace welkin::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
