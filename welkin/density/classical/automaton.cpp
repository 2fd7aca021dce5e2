#include "welkin/density/classical/automaton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "welkin/base/error.hpp"
#include "welkin/base/parallel.hpp"
#include "welkin/density/hero_shape.hpp"

namespace welkin {

namespace {

constexpr int kPlanes = 16;
constexpr std::uint64_t kAll = ~std::uint64_t{0};

// SplitMix64's output (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
  x = (x ^ x >> 27) * 0x94D049BB133111EBu;
  return x ^ x >> 31;
}

// 64 random bits for one plane of a word: wyrand (W. Yi), whose counter is the plane's number.
std::uint64_t randomBits(std::uint64_t stream, std::size_t word, int plane) {
  __extension__ using Wide = unsigned __int128;
  const std::uint64_t x = stream + (word * kPlanes + std::size_t(plane)) * 0xA0761D6478BD642Fu;
  const Wide product = Wide{x} * (x ^ 0xE7037ED1A0B428DBu);
  return std::uint64_t(product >> 64) ^ std::uint64_t(product);
}

std::uint64_t streamOf(std::uint32_t seed, Automaton::Chance chance, int step) {
  return mixed((std::uint64_t{seed} << 32 | std::uint32_t(step)) + 0x632BE59BD9B4E019u * (1 + std::uint64_t(chance)));
}

// Bits of the cells whose random number is less than their limit, the bits of which planeOf(plane) gives, the highest
// first: decided from the highest down until no cell is open.
template <class PlaneOf>
std::uint64_t below(std::uint64_t stream, std::size_t word, const PlaneOf& planeOf) {
  std::uint64_t open = kAll, less = 0;
  for (int first = 0; first < kPlanes && open != 0; first += 4)
    for (int plane = first; plane < first + 4; ++plane) {
      const std::uint64_t r = randomBits(stream, word, plane), t = planeOf(plane);
      less |= open & ~r & t;
      open &= ~(r ^ t);
    }
  return less;
}

// How much a place belongs to a region: 1 in the middle of one, 0 outside all.
struct Region {
  glm::vec3 centre, radii;
};
float belongs(const std::vector<Region>& regions, const glm::vec3& p) {
  if (regions.empty()) return 1.0f;
  float most = 0.0f;
  for (const Region& r : regions) {
    const glm::vec3 d = (p - r.centre) / r.radii;
    most = std::max(most, 1.0f - glm::dot(d, d));
  }
  return most;
}

}  // namespace

Automaton::Automaton(const AutomatonSettings& settings, std::uint32_t seed)
    : settings_(settings), seed_(seed), across_(std::size_t(std::max(settings.width, 0)) / 64) {
  if (settings.width < 64 || settings.width % 64 != 0 || settings.breadth < 1 || settings.height < 1)
    throw Error(ErrorKind::badInput, "",
                fmt::format("an automaton of {} x {} x {} cells cannot be: its width is a multiple of 64, and there is "
                            "at least one row and one layer",
                            settings.width, settings.breadth, settings.height));
  const std::size_t words = across_ * std::size_t(settings.breadth) * std::size_t(settings.height);
  for (Words* w : {&humid_, &cloud_, &active_, &wasActive_}) w->assign(words, 0);
  for (Words& w : chances_) w.assign(words * kPlanes, 0);
  for (auto& n : never_) n.assign(words, 1);
  setChances();
  // The first step's humidity is the same everywhere; it matters only where there is activation.
  const auto humid = std::min(static_cast<std::uint32_t>(std::lround(65536.0f * settings.humidity)), 65535u);
  const std::uint64_t stream = mixed(seed_ ^ 0xA0761D6478BD642Fu), activation = streamOf(seed_, Chance::activation, -1);
  for (std::size_t w = 0; w < words; ++w) {
    humid_[w] = below(stream, w, [&](int plane) { return humid >> (kPlanes - 1 - plane) & 1 ? kAll : 0; });
    active_[w] = drawn(Chance::activation, activation, w);
  }
}

void Automaton::setChances() {
  const AutomatonSettings& s = settings_;
  HeroDice dice(seed_);
  std::vector<Region> regions(std::size_t(std::max(s.regions, 0)));
  const glm::vec3 cells(s.width, s.breadth, s.height);
  for (Region& r : regions) {
    // Flat-based: they reach from a little below the box upward. Those in the middle are larger.
    const float x = dice(-1.0f, 1.0f), y = dice(-1.0f, 1.0f), size = dice(0.55f, 1.0f);
    const float rim = std::min(std::sqrt(x * x + y * y), 1.0f);
    r.radii = cells * glm::vec3(0.21f, 0.21f, 0.95f - 0.45f * rim) * size;
    r.centre = cells * glm::vec3(0.5f + 0.29f * x, 0.5f + 0.29f * y, 0.04f);
  }
  const float base[3] = {s.extinction, s.rehumidification, s.activation};
  parallelFor(std::size_t(s.height), 1, [&](std::size_t begin, std::size_t end) {
    for (int z = int(begin); z < int(end); ++z)
      for (int y = 0; y < s.breadth; ++y)
        for (int x = 0; x < s.width; ++x) {
          const float in = belongs(regions, {float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f});
          const std::size_t word = (std::size_t(z) * s.breadth + y) * across_ + x / 64;
          for (int c = 0; c < 3; ++c) {
            // Cloud vanishes surely outside the regions, and forms there never.
            const float share = c == 0 ? (in > 0.0f ? std::pow(base[0], std::sqrt(in)) : 1.0f) : base[c] * in;
            const auto t = std::min(static_cast<std::uint32_t>(std::lround(65536.0f * share)), 65535u);
            if (t != 0) never_[c][word] = 0;
            for (int plane = 0; plane < kPlanes; ++plane)
              chances_[c][word * kPlanes + plane] |= std::uint64_t{t >> (kPlanes - 1 - plane) & 1} << (x % 64);
          }
        }
  });
}

// Bits of the cells for which a chance comes true.
std::uint64_t Automaton::drawn(Chance chance, std::uint64_t stream, std::size_t word) const {
  if (never_[std::size_t(chance)][word]) return 0;
  const std::uint64_t* planes = chances_[std::size_t(chance)].data() + word * kPlanes;
  return below(stream, word, [&](int plane) { return planes[plane]; });
}

std::uint32_t Automaton::chanceAt(Chance chance, int x, int y, int z) const {
  const std::size_t word = (std::size_t(z) * settings_.breadth + y) * across_ + x / 64;
  std::uint32_t t = 0;
  for (int plane = 0; plane < kPlanes; ++plane)
    t = t << 1 | std::uint32_t(chances_[std::size_t(chance)][word * kPlanes + plane] >> (x % 64) & 1);
  return t;
}

std::uint32_t Automaton::numberAt(Chance chance, int step, int x, int y, int z) const {
  const std::size_t word = (std::size_t(z) * settings_.breadth + y) * across_ + x / 64;
  const std::uint64_t stream = streamOf(seed_, chance, step);
  std::uint32_t number = 0;
  for (int plane = 0; plane < kPlanes; ++plane)
    number = number << 1 | std::uint32_t(randomBits(stream, word, plane) >> (x % 64) & 1);
  return number;
}

void Automaton::advance() {
  std::swap(active_, wasActive_);
  const std::size_t rows = std::size_t(settings_.breadth), plane = rows * across_;
  const int breadth = settings_.breadth, height = settings_.height;
  const std::uint64_t extinction = streamOf(seed_, Chance::extinction, steps_),
                      rehumidification = streamOf(seed_, Chance::rehumidification, steps_),
                      activation = streamOf(seed_, Chance::activation, steps_);
  parallelFor(std::size_t(height), 1, [&](std::size_t begin, std::size_t end) {
    for (int z = int(begin); z < int(end); ++z) {
      for (int y = 0; y < breadth; ++y) {
        const std::size_t row = std::size_t(z) * plane + std::size_t(y) * across_;
        const std::uint64_t* act = wasActive_.data();
        for (std::size_t i = 0; i < across_; ++i) {
          const std::size_t w = row + i;
          const std::uint64_t a = act[w];
          const std::uint64_t left = i > 0 ? act[w - 1] : 0, right = i + 1 < across_ ? act[w + 1] : 0;
          // The neighbours of eq. 4: one and two cells away along the plane and below, one above.
          std::uint64_t near = a << 1 | left >> 63 | a >> 1 | right << 63 | a << 2 | left >> 62 | a >> 2 | right << 62;
          if (y > 0) near |= act[w - across_];
          if (y > 1) near |= act[w - 2 * across_];
          if (y + 1 < breadth) near |= act[w + across_];
          if (y + 2 < breadth) near |= act[w + 2 * across_];
          if (z > 0) near |= act[w - plane];
          if (z > 1) near |= act[w - 2 * plane];
          if (z + 1 < height) near |= act[w + plane];
          const std::uint64_t humid = humid_[w];
          active_[w] = (~a & humid & near) | drawn(Chance::activation, activation, w);
          std::uint64_t dry = humid & ~a, cloud = cloud_[w] | a;
          if (dry != kAll) dry |= drawn(Chance::rehumidification, rehumidification, w);
          if (cloud != 0) cloud &= ~drawn(Chance::extinction, extinction, w);
          humid_[w] = dry;
          cloud_[w] = cloud;
        }
      }
    }
  });
  ++steps_;
  if (settings_.shear == 0) return;
  // The wind's profile is linear in height; whole cells of it, so that they add up to it.
  parallelFor(std::size_t(height), 1, [&](std::size_t begin, std::size_t end) {
    for (int z = int(begin); z < int(end); ++z) {
      const auto moved = [&](int step) {
        return static_cast<int>(std::floor(double(step) * settings_.shear * (z + 0.5) / height));
      };
      const int cells = moved(steps_) - moved(steps_ - 1);
      for (Words* words : {&humid_, &cloud_, &active_}) shear(*words, z, cells);
    }
  });
}

// Moves a layer along x; what enters is empty.
void Automaton::shear(Words& words, int layer, int cells) const {
  for (int y = 0; y < settings_.breadth; ++y) {
    std::uint64_t* row = words.data() + (std::size_t(layer) * settings_.breadth + y) * across_;
    if (cells > 0)
      for (std::size_t i = across_; i-- > 0;) row[i] = row[i] << cells | (i > 0 ? row[i - 1] >> (64 - cells) : 0);
    if (cells < 0)
      for (std::size_t i = 0; i < across_; ++i)
        row[i] = row[i] >> -cells | (i + 1 < across_ ? row[i + 1] << (64 + cells) : 0);
  }
}

std::vector<float> smoothCloud(const AutomatonSettings& s, std::span<const std::vector<std::uint64_t>> clouds) {
  std::vector<float> sum(clouds.front().size() * 64);
  const float each = 1.0f / static_cast<float>(clouds.size());
  parallelFor(clouds.front().size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (const auto& words : clouds)
      for (std::size_t w = begin; w < end; ++w)
        for (std::size_t b = 0; words[w] != 0 && b < 64; ++b) sum[w * 64 + b] += (words[w] >> b & 1) != 0 ? each : 0.0f;
  });
  const int r = s.smoothing;
  const std::size_t width = std::size_t(s.width), rows = std::size_t(s.breadth) * std::size_t(s.height);
  const float share = 1.0f / static_cast<float>(2 * r + 1);
  std::vector<float> mean(sum.size());
  // Along one axis: each row becomes the mean of the rows round it, `at` of `count` on that axis.
  const auto along = [&](std::size_t stride, int count, const auto& at) {
    parallelFor(rows, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        float* out = mean.data() + row * width;
        std::fill_n(out, width, 0.0f);
        const int here = at(row);
        for (int m = std::max(-r, -here); m <= std::min(r, count - 1 - here); ++m) {
          const float* in =
              sum.data() + static_cast<std::ptrdiff_t>(row * width) + m * static_cast<std::ptrdiff_t>(stride);
          for (std::size_t x = 0; x < width; ++x) out[x] += share * in[x];
        }
      }
    });
    sum.swap(mean);
  };
  along(width, s.breadth, [&](std::size_t row) { return static_cast<int>(row % std::size_t(s.breadth)); });
  along(width * std::size_t(s.breadth), s.height,
        [&](std::size_t row) { return static_cast<int>(row / std::size_t(s.breadth)); });
  parallelFor(rows, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int m = -r; m <= r; ++m) {
        const auto first = static_cast<std::size_t>(std::max(-m, 0)),
                   last = width - static_cast<std::size_t>(std::max(m, 0));
        float* out = mean.data() + row * width;
        if (m == -r) std::fill_n(out, width, 0.0f);
        const float* in = sum.data() + static_cast<std::ptrdiff_t>(row * width) + m;
        for (std::size_t x = first; x < last; ++x) out[x] += share * in[x];
      }
  });
  return mean;
}

}  // namespace welkin
