#pragma once
// Parameters of the droplets' phase function.
#include "welkin/light/law.hpp"

namespace welkin {

// The fit of Jendersie and d'Eon 2023 for water droplets of this diameter in um, clamped to its range 5 to 50.
law::MiePhase computeMiePhase(double diameter);

// Mean cosine of the fit (Draine's is g (1 + alpha (3 + 2 g^2) / 5) / (1 + alpha (1 + 2 g^2) / 3)).
double meanCosine(const law::MiePhase& mie);

// The droplet diameter in um, from 5 to 50, whose fit has this mean cosine: the nearest end outside that range. The fit
// is more forward than Mie theory, so matching the mean cosine matches multiple scattering.
double diameterFromMeanCosine(double g);

}  // namespace welkin
