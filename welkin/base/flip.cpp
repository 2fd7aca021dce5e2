#include "welkin/base/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "welkin/base/error.hpp"
#include "welkin/base/law_tone.hpp"
#include "welkin/base/angle.hpp"
#include "welkin/base/parallel.hpp"

namespace welkin {

namespace {

// Exponents and knots of sections 4.1.4 and 4.3.
constexpr float kColourPower = 0.7f, kKneeIn = 0.4f, kKneeOut = 0.95f, kFeaturePower = 0.5f;
constexpr double kFeatureWidth = 0.082;  // degrees: width of the edges that eyes respond to most

// One channel of a picture.
struct Plane {
  int width, height;
  std::vector<float> values;
  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h) {}
};
using Planes = std::array<Plane, 3>;

// Weights at -radius ... radius.
using Kernel = std::vector<float>;

Kernel kernelOf(int radius, const std::function<double(double)>& weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(static_cast<float>(weight(i)));
  return kernel;
}

// A filter that is the product of a row and a column; beyond its border a picture goes on as it ends.
Plane filtered(const Plane& in, const Kernel& row, const Kernel& column) {
  const int w = in.width, h = in.height, rx = static_cast<int>(row.size() / 2),
            ry = static_cast<int>(column.size() / 2);
  Plane across(w, h), out(w, h);
  parallelFor(static_cast<std::size_t>(h), 8, [&](std::size_t begin, std::size_t end) {
    std::vector<float> line(static_cast<std::size_t>(w) + 2 * rx);
    for (std::size_t y = begin; y < end; ++y) {
      const float* from = in.values.data() + y * w;
      for (int x = 0; x < w + 2 * rx; ++x) line[x] = from[std::clamp(x - rx, 0, w - 1)];
      float* to = across.values.data() + y * w;
      for (int k = 0; k <= 2 * rx; ++k)
        for (int x = 0; x < w; ++x) to[x] += row[k] * line[x + k];
    }
  });
  parallelFor(static_cast<std::size_t>(h), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      float* to = out.values.data() + static_cast<std::size_t>(y) * w;
      for (int k = 0; k <= 2 * ry; ++k) {
        const float* from = across.values.data() + static_cast<std::size_t>(std::clamp(y + k - ry, 0, h - 1)) * w;
        for (int x = 0; x < w; ++x) to[x] += column[k] * from[x];
      }
    }
  });
  return out;
}

// Linear Rec.709 relative to its white: X / Xn, Y / Yn, Z / Zn.
glm::vec3 relativeXyz(const glm::vec3& rgb) {
  return {0.4338874f * rgb.x + 0.3762240f * rgb.y + 0.1898887f * rgb.z,
          0.2126390f * rgb.x + 0.7151687f * rgb.y + 0.0721923f * rgb.z,
          0.0177500f * rgb.x + 0.1094476f * rgb.y + 0.8728023f * rgb.z};
}
const glm::mat3& rgbFromRelativeXyz() {
  static const glm::mat3 kInverse = [] {
    glm::mat3 m;
    for (int i = 0; i < 3; ++i) {
      glm::vec3 primary(0.0f);
      primary[i] = 1.0f;
      m[i] = relativeXyz(primary);
    }
    return glm::inverse(m);
  }();
  return kInverse;
}

// The opponent space YCxCz and its inverse (eq. 2).
glm::vec3 opponentFromXyz(const glm::vec3& r) {
  return {116.0f * r.y - 16.0f, 500.0f * (r.x - r.y), 200.0f * (r.y - r.z)};
}
glm::vec3 xyzFromOpponent(const glm::vec3& o) {
  const float y = (o.x + 16.0f) / 116.0f;
  return {y + o.y / 500.0f, y, y - o.z / 200.0f};
}

// CIE L*a*b*, with a* and b* shrunk in the dark as Hunt found: times 0.01 L* (eq. 7).
glm::vec3 huntLab(const glm::vec3& linear) {
  constexpr float kDelta = 6.0f / 29.0f;
  const auto f = [](float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  };
  const glm::vec3 r = relativeXyz(linear);
  const float x = f(r.x), y = f(r.y), z = f(r.z), lightness = 116.0f * y - 16.0f;
  return {lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z)};
}

// City block in lightness, Euclid in chroma (eq. 8), compressed (section 4.1.4).
float colourDistance(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = a - b;
  return std::pow(std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z), kColourPower);
}

// To [0, 1]: the smaller differences take nearly all of it (eq. 9). The largest is that of green and blue.
float remapColour(float distance, float largest) {
  const float knee = kKneeIn * largest;
  return distance < knee ? kKneeOut / knee * distance
                         : kKneeOut + (distance - knee) / (largest - knee) * (1.0f - kKneeOut);
}

Planes opponentPlanes(const Image& image) {
  Planes out{Plane(image.width, image.height), Plane(image.width, image.height), Plane(image.width, image.height)};
  parallelFor(out[0].values.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float* c = image.pixels.data() + i * image.channels;
      glm::vec3 linear;
      for (int k = 0; k < 3; ++k)
        linear[k] = law::linearFromSrgb(std::clamp(c[image.channels < 3 ? 0 : k], 0.0f, 1.0f));
      const glm::vec3 o = opponentFromXyz(relativeXyz(linear));
      for (int k = 0; k < 3; ++k) out[k].values[i] = o[k];
    }
  });
  return out;
}

// The eye's contrast sensitivity as filters (eq. 4 to 6, table 1): g(x) = sum of a sqrt(pi / b) exp(-pi^2 x^2 / b), x
// in degrees, its weights summing to 1 over the plane. Each Gaussian is a row times a column.
struct Gaussian {
  double a, b;
};
Plane sensed(const Plane& in, std::initializer_list<Gaussian> terms, double ppd) {
  const double widest = std::sqrt(0.04 / (2.0 * kPi * kPi));  // standard deviation of the widest term of all
  const int radius = static_cast<int>(std::ceil(3.0 * widest * ppd));
  std::vector<Kernel> kernels;
  std::vector<double> shares;
  double whole = 0;
  for (const Gaussian& term : terms) {
    const auto gauss = [&](double x) { return std::exp(-kPi * kPi * x * x / (term.b * ppd * ppd)); };
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += gauss(i);
    kernels.push_back(kernelOf(radius, [&](double x) { return gauss(x) / sum; }));
    shares.push_back(term.a * std::sqrt(kPi / term.b) * sum * sum);
    whole += shares.back();
  }
  Plane out(in.width, in.height);
  for (std::size_t t = 0; t < kernels.size(); ++t) {
    const Plane part = filtered(in, kernels[t], kernels[t]);
    const float share = static_cast<float>(shares[t] / whole);
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += share * part.values[i];
  }
  return out;
}

// What the eye makes of the colours: filtered, back to displayable colours, in Hunt-adjusted L*a*b*.
std::vector<glm::vec3> perceived(const Planes& opponent, double ppd) {
  const Planes f{sensed(opponent[0], {{1.0, 0.0047}}, ppd), sensed(opponent[1], {{1.0, 0.0053}}, ppd),
                 sensed(opponent[2], {{34.1, 0.04}, {13.5, 0.025}}, ppd)};
  std::vector<glm::vec3> out(f[0].values.size());
  parallelFor(out.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3 linear = rgbFromRelativeXyz() * xyzFromOpponent({f[0].values[i], f[1].values[i], f[2].values[i]});
      out[i] = huntLab(glm::clamp(linear, 0.0f, 1.0f));
    }
  });
  return out;
}

// Strength of edges and of points in the achromatic channel (section 4.2): first and second derivatives of a Gaussian
// whose positive and negative weights sum to 1 and -1.
struct Features {
  std::vector<float> edge, point;
};
Features featuresOf(const Plane& achromatic, double ppd) {
  const double sigma = 0.5 * kFeatureWidth * ppd;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const auto gauss = [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
  const auto normalised = [](Kernel kernel) {
    double plus = 0, minus = 0;
    for (const double v : kernel) (v > 0 ? plus : minus) += v;
    for (float& v : kernel) v = static_cast<float>(v > 0 ? v / plus : (minus < 0 ? v / -minus : 0.0));
    return kernel;
  };
  const Kernel smooth = normalised(kernelOf(radius, gauss));
  const Kernel first = normalised(kernelOf(radius, [&](double x) { return -x * gauss(x); }));
  const Kernel second =
      normalised(kernelOf(radius, [&](double x) { return (x * x / (sigma * sigma) - 1.0) * gauss(x); }));

  Plane unit = achromatic;
  for (float& v : unit.values) v = (v + 16.0f) / 116.0f;
  const auto strength = [&](const Kernel& kernel) {
    Plane x = filtered(unit, kernel, smooth);
    const Plane y = filtered(unit, smooth, kernel);
    for (std::size_t i = 0; i < x.values.size(); ++i) x.values[i] = std::hypot(x.values[i], y.values[i]);
    return x.values;
  };
  return {strength(first), strength(second)};
}

}  // namespace

Image flipMap(const Image& a, const Image& b, double pixelsPerDegree) {
  requireSameShape(a, b);
  if (!(pixelsPerDegree >= 1.0 && pixelsPerDegree <= 1000.0))
    throw Error(ErrorKind::badInput, "", "FLIP takes 1 to 1000 pixels per degree");
  const Planes opponentA = opponentPlanes(a), opponentB = opponentPlanes(b);
  const std::vector<glm::vec3> colourA = perceived(opponentA, pixelsPerDegree);
  const std::vector<glm::vec3> colourB = perceived(opponentB, pixelsPerDegree);
  const Features featuresA = featuresOf(opponentA[0], pixelsPerDegree);
  const Features featuresB = featuresOf(opponentB[0], pixelsPerDegree);
  const float largest = colourDistance(huntLab({0.0f, 1.0f, 0.0f}), huntLab({0.0f, 0.0f, 1.0f}));
  Image map(a.width, a.height, 1);
  parallelFor(map.pixels.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float colour = remapColour(colourDistance(colourA[i], colourB[i]), largest);
      const float feature =
          std::max(std::abs(featuresA.edge[i] - featuresB.edge[i]), std::abs(featuresA.point[i] - featuresB.point[i]));
      // A difference of features makes the difference of colours larger (eq. 12, 13).
      const float strength = std::pow(feature * std::numbers::sqrt2_v<float> * 0.5f, kFeaturePower);
      map.pixels[i] = std::clamp(std::pow(colour, 1.0f - strength), 0.0f, 1.0f);
    }
  });
  return map;
}

double meanOf(const Image& map) {
  double sum = 0;
  for (const double v : map.pixels) sum += v;
  return map.pixels.empty() ? 0.0 : sum / static_cast<double>(map.pixels.size());
}

}  // namespace welkin
