#include "apps/welkin/command.hpp"

namespace welkin::app {
void addRender(CLI::App&) {}
}  // namespace welkin::app
