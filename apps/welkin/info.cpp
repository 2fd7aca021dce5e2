#include "apps/welkin/command.hpp"

namespace welkin::app {
void addInfo(CLI::App&) {}
}  // namespace welkin::app
