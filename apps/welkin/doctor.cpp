#include "apps/welkin/command.hpp"

namespace welkin::app {
void addDoctor(CLI::App&) {}
}  // namespace welkin::app
