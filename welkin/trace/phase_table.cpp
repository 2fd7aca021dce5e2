#include "welkin/trace/phase_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "welkin/base/angle.hpp"
#include "welkin/base/error.hpp"

namespace welkin {

namespace {

constexpr double kSteepest = 0.999;         // |g|; beyond it weights would leave the neighbourhood of 1
constexpr std::size_t kMostRows = 1000000;  // a row every 0.2 millidegrees
constexpr float kTiny = 1e-30f;
constexpr double kLeastShare = 1e-9;  // of a cell: less is left out, rather than divided by

double versineFromDegrees(double degrees) {
  const double s = std::sin(degrees * (kPi / 360.0));
  return 2.0 * s * s;
}

// Probability between two versines of a density (1/sr) that is linear from a to b.
double linearMass(double width, double a, double b) { return kPi * (a + b) * width; }

// The fraction x of an interval below which lies the share t of the mass under a line from a to b.
double linearInverse(double t, double a, double b) {
  return t * (a + b) / std::max(a + std::sqrt(a * a + t * (b * b - a * a)), double(kTiny));
}

int bisectionSteps(std::size_t count) { return std::bit_width(std::max<std::size_t>(count, 1) - 1); }

int lastNotAbove(const std::vector<float>& keys, int from, int to, float value) {
  const auto at = std::upper_bound(keys.begin() + from, keys.begin() + to, value);
  return std::max(from, static_cast<int>(at - keys.begin()) - 1);
}

// Versines that crowd toward both ends, where peaks are: 0, then 20,000 steps of 0.15 % from 1e-13 to 1, and mirrored.
std::vector<double> crowdedVersines() {
  constexpr int kSteps = 20000;
  std::vector<double> half{0.0}, all;
  for (int i = 0; i <= kSteps; ++i) half.push_back(std::pow(1e-13, 1.0 - double(i) / kSteps));
  all = half;
  for (std::size_t i = half.size() - 1; i-- > 0;) all.push_back(2.0 - half[i]);
  return all;
}

// The kCells + 1 versines that cut the sphere into cells of equal probability.
std::vector<double> equalProbabilityEdges(const law::MiePhase& mie) {
  const std::vector<double> v = crowdedVersines();
  std::vector<double> density(v.size()), sum(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) density[i] = law::phaseMieOfVersine(static_cast<float>(v[i]), mie);
  for (std::size_t i = 1; i < v.size(); ++i)
    sum[i] = sum[i - 1] + linearMass(v[i] - v[i - 1], density[i - 1], density[i]);
  std::vector<double> edges{0.0};
  std::size_t at = 1;
  for (int cell = 1; cell < PhaseTable::kCells; ++cell) {
    const double wanted = sum.back() * cell / PhaseTable::kCells;
    while (sum[at] < wanted) ++at;
    const double t = (wanted - sum[at - 1]) / (sum[at] - sum[at - 1]);
    edges.push_back(std::lerp(v[at - 1], v[at], linearInverse(t, density[at - 1], density[at])));
  }
  edges.push_back(2.0);
  return edges;
}

void checkRows(std::span<const double> degrees, std::span<const double> values) {
  const auto fail = [](const std::string& what) { throw Error(ErrorKind::badInput, "", "phase function: " + what); };
  if (degrees.size() != values.size() || degrees.size() < 2)
    fail(fmt::format("needs at least two angles with a value each, not {} and {}", degrees.size(), values.size()));
  if (degrees.size() > kMostRows) fail(fmt::format("{} rows; the most is {}", degrees.size(), kMostRows));
  if (degrees.front() != 0.0 || degrees.back() != 180.0)
    fail(fmt::format("angles must begin at 0 and end at 180 degrees, not {} and {}", degrees.front(), degrees.back()));
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= 0.0 && values[i] <= 1e30))
      fail(fmt::format("the value at {} degrees is {}: values are 0 or more, and at most 1e30", degrees[i], values[i]));
    if (i > 0 && !(degrees[i] > degrees[i - 1]))
      fail(fmt::format("angles must ascend: {} comes after {} degrees", degrees[i], degrees[i - 1]));
    most = std::max(most, values[i]);
  }
  if (most < 1e-30) fail("all values are 0: light would go nowhere");
}

// The number at the front of `line`, which is then taken off with what separates it from the next; false without one.
bool takeNumber(std::string_view& line, double& number) {
  const auto result = std::from_chars(line.data(), line.data() + line.size(), number);
  if (result.ec != std::errc()) return false;
  line.remove_prefix(static_cast<std::size_t>(result.ptr - line.data()));
  const std::size_t next = line.find_first_not_of(" \t\r,");
  if (next == 0 && !line.empty()) return false;  // glued to something else
  line.remove_prefix(std::min(next, line.size()));
  return true;
}

}  // namespace

void PhaseTable::addSegment(double fraction, double mass, double from, double to, double low, double high) {
  fraction_.push_back(static_cast<float>(fraction));
  mass_.push_back(static_cast<float>(mass));
  versine_.push_back(static_cast<float>(from));
  width_.push_back(static_cast<float>(to - from));
  low_.push_back(static_cast<float>(low));
  high_.push_back(static_cast<float>(high));
}

PhaseTable PhaseTable::henyeyGreenstein(double g) {
  if (!(std::abs(g) <= kSteepest))
    throw Error(ErrorKind::badInput, "",
                fmt::format("asymmetry {} of Henyey-Greenstein: use a value from -{} to {}", g, kSteepest, kSteepest));
  return mie({static_cast<float>(g), 0.0f, 0.0f, 0.0f});
}

PhaseTable PhaseTable::mie(const law::MiePhase& mie) {
  PhaseTable table;
  table.mie_ = mie;
  table.meanCosine_ = welkin::meanCosine(mie);
  const std::vector<double> edges = equalProbabilityEdges(mie);
  for (int cell = 0; cell < kCells; ++cell) {
    const double from = edges[std::size_t(cell)], to = edges[std::size_t(cell) + 1];
    const double a = law::phaseMieOfVersine(static_cast<float>(from), mie);
    const double b = law::phaseMieOfVersine(static_cast<float>(to), mie);
    const double scale = 1.0 / (kCells * linearMass(to - from, a, b));
    table.firstSegment_.push_back(cell);
    table.addSegment(0.0, 1.0, from, to, a * scale, b * scale);
  }
  table.firstSegment_.push_back(kCells);
  return table;
}

PhaseTable PhaseTable::tabulated(std::span<const double> degrees, std::span<const double> values) {
  checkRows(degrees, values);
  const std::size_t count = degrees.size();
  std::vector<double> v(count), p(values.begin(), values.end());
  double total = 0.0;
  for (std::size_t i = 0; i < count; ++i) v[i] = versineFromDegrees(degrees[i]);
  for (std::size_t i = 1; i < count; ++i) total += linearMass(v[i] - v[i - 1], p[i - 1], p[i]);
  for (double& value : p) value /= total;

  PhaseTable table;
  table.firstSegment_.push_back(0);
  int cell = 0;
  double fraction = 0.0;  // of the cell's probability, up to `from`
  for (std::size_t i = 1; i < count; ++i) {
    const double c0 = 1.0 - v[i - 1], c1 = 1.0 - v[i], pm = 0.5 * (p[i - 1] + p[i]);
    table.meanCosine_ += 2.0 * kPi * (v[i] - v[i - 1]) * (p[i - 1] * c0 + 4.0 * pm * 0.5 * (c0 + c1) + p[i] * c1) / 6.0;
    // Cut the interval where cells end.
    const double width = v[i] - v[i - 1], mass = linearMass(width, p[i - 1], p[i]) * kCells;
    double used = 0.0, x = 0.0;
    while (used < mass) {
      const bool cellEnds = cell + 1 < kCells && mass - used >= 1.0 - fraction;
      const double share = cellEnds ? 1.0 - fraction : mass - used;
      used = cellEnds ? used + share : mass;
      const double end = cellEnds ? std::min(linearInverse(used / mass, p[i - 1], p[i]), 1.0) : 1.0;
      if (share > kLeastShare)
        table.addSegment(fraction, share, v[i - 1] + width * x, v[i - 1] + width * end, std::lerp(p[i - 1], p[i], x),
                         std::lerp(p[i - 1], p[i], end));
      x = end;
      fraction += share;
      if (cellEnds) {
        fraction = 0.0;
        ++cell;
        table.firstSegment_.push_back(static_cast<std::int32_t>(table.fraction_.size()));
      }
    }
  }
  table.firstSegment_.resize(kCells + 1, static_cast<std::int32_t>(table.fraction_.size()));
  table.rowVersine_.assign(v.begin(), v.end());
  table.rowValue_.assign(p.begin(), p.end());
  for (std::size_t i = 0; i < kCells; ++i)
    table.cellSteps_ =
        std::max(table.cellSteps_,
                 bisectionSteps(static_cast<std::size_t>(table.firstSegment_[i + 1] - table.firstSegment_[i])));
  table.cellSteps_ = std::max(table.cellSteps_, 1);
  return table;
}

PhaseTable PhaseTable::parse(std::string_view text, const std::string& where) {
  std::vector<double> degrees, values;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view row = text.substr(0, std::min(text.substr(0, end).find('#'), end));
    text.remove_prefix(std::min(end + 1, text.size()));
    row.remove_prefix(std::min(row.find_first_not_of(" \t\r"), row.size()));
    if (row.empty()) continue;
    double angle = 0.0, value = 0.0;
    if (!takeNumber(row, angle) || !takeNumber(row, value) || !row.empty())
      throw Error(ErrorKind::badInput, fmt::format("{}:{}", where, line),
                  "a row of a phase function is an angle in degrees and a value, two numbers");
    degrees.push_back(angle);
    values.push_back(value);
    if (degrees.size() > kMostRows) break;
  }
  try {
    return tabulated(degrees, values);
  } catch (const Error& e) {
    throw Error(ErrorKind::badInput, where, e.what());
  }
}

PhaseTable::Sample PhaseTable::sample(float u) const {
  const float scaled = u * float(kCells), cell = std::floor(scaled);
  const float r = scaled - cell + float(kCells) * 0x1p-25f;  // middle of the step of 24 bits
  auto segment = static_cast<std::size_t>(cell);
  float x = r;
  if (cellSteps_ > 0) {
    segment = static_cast<std::size_t>(lastNotAbove(fraction_, firstSegment_[segment], firstSegment_[segment + 1], r));
    x = std::min((r - fraction_[segment]) / mass_[segment], 1.0f);
  }
  const float a = low_[segment], b = high_[segment];
  const float density = std::sqrt(a * a * (1.0f - x) + b * b * x);
  const float along = x * (a + b) / std::max(a + density, kTiny);
  return {std::min(versine_[segment] + width_[segment] * along, 2.0f), density};
}

float PhaseTable::pdf(float versine) const {
  const auto i = static_cast<std::size_t>(lastNotAbove(versine_, 0, static_cast<int>(versine_.size()), versine));
  const float x = std::clamp((versine - versine_[i]) / std::max(width_[i], kTiny), 0.0f, 1.0f);
  return low_[i] * (1.0f - x) + high_[i] * x;
}

float PhaseTable::evaluate(float versine) const {
  if (rowVersine_.empty()) return law::phaseMieOfVersine(versine, mie_);
  const int last = static_cast<int>(rowVersine_.size()) - 1;
  const auto i = static_cast<std::size_t>(lastNotAbove(rowVersine_, 0, last, versine));
  const float v0 = rowVersine_[i], v1 = rowVersine_[i + 1];
  const float x = std::clamp((versine - v0) / std::max(v1 - v0, kTiny), 0.0f, 1.0f);
  return rowValue_[i] * (1.0f - x) + rowValue_[i + 1] * x;
}

PhaseTableView PhaseTable::view() const {
  return {.mie = mie_,
          .rows = static_cast<int>(rowVersine_.size()),
          .rowVersine = rowVersine_.data(),
          .rowValue = rowValue_.data(),
          .segments = static_cast<int>(versine_.size()),
          .segmentSteps = bisectionSteps(versine_.size()),
          .rowSteps = rowVersine_.empty() ? 0 : bisectionSteps(rowVersine_.size() - 1),
          .cellSteps = cellSteps_,
          .firstSegment = firstSegment_.data(),
          .fraction = fraction_.data(),
          .mass = mass_.data(),
          .versine = versine_.data(),
          .width = width_.data(),
          .low = low_.data(),
          .high = high_.data()};
}

}  // namespace welkin
