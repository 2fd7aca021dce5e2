#include "welkin/realtime/surroundings.hpp"

#include <algorithm>
#include <glm/common.hpp>

namespace welkin::realtime {

namespace {

constexpr double kTogether = 900.0;  // m: less than the leash of any level that is kept round the eye

// How many other eyes use it, or -1 when one of them is too far away.
int company(Surroundings& s, const std::shared_ptr<Eye>& eye) {
  std::erase_if(s.eyes, [](const std::weak_ptr<const Eye>& e) { return e.expired(); });
  int others = 0;
  for (const std::weak_ptr<const Eye>& e : s.eyes) {
    const std::shared_ptr<const Eye> other = e.lock();
    if (other == eye) continue;
    const glm::dvec2 apart = glm::abs(other->place - eye->place);
    if (std::max(apart.x, apart.y) > kTogether) return -1;
    ++others;
  }
  return others;
}

}  // namespace

std::shared_ptr<Surroundings> SurroundingsPool::of(const std::shared_ptr<Eye>& eye,
                                                   const std::shared_ptr<Surroundings>& current,
                                                   const glm::dvec2& place) {
  eye->place = place;
  if (current && company(*current, eye) >= 0) return current;
  if (current) std::erase_if(current->eyes, [&](const std::weak_ptr<const Eye>& e) { return e.lock() == eye; });
  // Those of a neighbour, else some that nobody uses, else new ones.
  std::erase_if(known_, [](const std::weak_ptr<Surroundings>& s) { return s.expired(); });
  std::shared_ptr<Surroundings> best;
  int most = -1;
  for (const std::weak_ptr<Surroundings>& s : known_) {
    const std::shared_ptr<Surroundings> candidate = s.lock();
    const int others = company(*candidate, eye);
    if (others <= most) continue;
    best = candidate;
    most = others;
  }
  if (!best) {
    best = std::make_shared<Surroundings>();
    known_.push_back(best);
  }
  best->eyes.push_back(eye);
  return best;
}

}  // namespace welkin::realtime
