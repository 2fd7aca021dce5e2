#pragma once
// What clouds are made of, as far as light sees it.
#include "welkin/base/fields.hpp"

namespace welkin {

// droplets: the fit to Mie scattering for their diameter (Jendersie and d'Eon 2023). henyey_greenstein: that of one
// mean cosine, which other renderers have too.
enum class ScatteringPhase { droplets, henyey_greenstein };
template <>
struct ChoiceNames<ScatteringPhase> {
  static constexpr std::array<std::string_view, 2> names{"droplets", "henyey_greenstein"};
};

}  // namespace welkin
