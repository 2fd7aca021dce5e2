#pragma once
// The laws of density: scalar C++ reading.
#include "welkin/noise/law.hpp"

namespace welkin::law {
#include "welkin/base/law_begin.inc"
#include "welkin/base/law_end.inc"
}  // namespace welkin::law
