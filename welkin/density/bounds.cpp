#include "welkin/density/bounds.hpp"

#include <algorithm>
#include <cmath>

#include "welkin/base/parallel.hpp"

namespace welkin {

namespace {
constexpr int kMostRead = 4;  // read along an axis; larger boxes take a coarser mip

Interval joined(const Interval& a, const Interval& b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }
}  // namespace

TexelBounds::TexelBounds(const TextureView& t, int channel, Kind kind) : kind_(kind) {
  mips_.push_back({t.width, t.height, t.depth, {}});
  const std::size_t count = static_cast<std::size_t>(t.width) * t.height * t.depth;
  mips_[0].cells.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float v = t.texels[i * static_cast<std::size_t>(t.channels) + static_cast<std::size_t>(channel)];
    mips_[0].cells[i] = {v, v};
  }
  // A texture that repeats can be halved only while its edges are even.
  const auto halves = [&](const Mip& m) {
    if (kind == Kind::volume) return m.width % 2 == 0 && m.height % 2 == 0 && m.depth % 2 == 0;
    return std::max({m.width, m.height, kind == Kind::box ? m.depth : 1}) > 1;
  };
  const bool deep = kind != Kind::planes;
  while (halves(mips_.back())) {
    const Mip& fine = mips_.back();
    const auto half = [](int n) { return (n + 1) / 2; };
    Mip coarse{half(fine.width), half(fine.height), deep ? half(fine.depth) : fine.depth, {}};
    coarse.cells.resize(static_cast<std::size_t>(coarse.width) * coarse.height * coarse.depth);
    parallelFor(static_cast<std::size_t>(coarse.depth), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t z = begin; z < end; ++z)
        for (int y = 0; y < coarse.height; ++y)
          for (int x = 0; x < coarse.width; ++x) {
            const int z0 = deep ? 2 * static_cast<int>(z) : static_cast<int>(z);
            const int z1 = deep ? std::min(z0 + 1, fine.depth - 1) : z0;
            Interval r{INFINITY, -INFINITY};
            for (int k = z0; k <= z1; ++k)
              for (int j = 2 * y; j <= std::min(2 * y + 1, fine.height - 1); ++j)
                for (int i = 2 * x; i <= std::min(2 * x + 1, fine.width - 1); ++i)
                  r = joined(r, fine.cells[(static_cast<std::size_t>(k) * fine.height + j) * fine.width + i]);
            coarse
                .cells[(z * coarse.height + static_cast<std::size_t>(y)) * coarse.width + static_cast<std::size_t>(x)] =
                r;
          }
    });
    mips_.push_back(std::move(coarse));
  }
}

Interval TexelBounds::between(const glm::vec3& low, const glm::vec3& high) const {
  // Filtering reaches half a texel further, and rounding a little more.
  const glm::vec3 from = low - 0.51f, to = high + 0.51f;
  const glm::vec3 size = to - from;
  const float widest = std::max({size.x, size.y, kind_ != Kind::planes ? size.z : 0.0f});
  const int wanted = std::max(0, static_cast<int>(std::ceil(std::log2(std::max(widest, 1.0f) / (kMostRead - 1)))));
  const std::size_t level = std::min(static_cast<std::size_t>(wanted), mips_.size() - 1);
  const Mip& mip = mips_[level];
  const float scale = std::exp2(-static_cast<float>(level));
  const auto first = [&](float x) { return static_cast<int>(std::floor(x * scale)); };
  const auto each = [&](int a, int b, int n, bool repeats, const auto& visit) {
    if (repeats && b - a + 1 >= n) a = 0, b = n - 1;
    if (!repeats) a = std::clamp(a, 0, n - 1), b = std::clamp(b, 0, n - 1);
    for (int i = a; i <= b; ++i) visit(((i % n) + n) % n);
  };
  const bool volume = kind_ == Kind::volume;
  Interval range{INFINITY, -INFINITY};
  const auto plane = [&](int z) {
    each(first(from.y), first(to.y), mip.height, volume, [&](int y) {
      each(first(from.x), first(to.x), mip.width, volume, [&](int x) {
        range = joined(range, mip.cells[(static_cast<std::size_t>(z) * mip.height + y) * mip.width + x]);
      });
    });
  };
  if (kind_ != Kind::planes)
    each(first(from.z), first(to.z), mip.depth, volume, plane);
  else
    plane(static_cast<int>(low.z));
  return range;
}

}  // namespace welkin
