#pragma once
#include <cstddef>
#include <functional>

namespace welkin {

// Calls body(begin, end) for disjoint ranges that cover [0, count), on all cores; `grain` is the least size of a range.
// An exception of a body ends the loop and is thrown here. Ranges depend on the number of cores: results must not.
void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace welkin
