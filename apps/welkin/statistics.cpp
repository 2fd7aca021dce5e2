#include "apps/welkin/statistics.hpp"

namespace welkin::app {

std::optional<CloudStatistics> layerStatistics(const Scene&, std::size_t) { return std::nullopt; }
std::optional<CloudStatistics> sheetStatistics(const Scene&, std::size_t) { return std::nullopt; }

}  // namespace welkin::app
