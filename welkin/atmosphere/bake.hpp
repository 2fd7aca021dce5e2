#pragma once
// The rows of the tables in the SIMD reading: one texel a lane. For tables.cpp.
#include "welkin/atmosphere/tables.hpp"

namespace welkin::bake {

// Each fills row `y` of its table; widths are multiples of 16.
void transmittanceRow(const law::AtmosphereParams& air, int y, Table& out);
void multiScatteringRow(const law::AtmosphereParams& air, const TextureView& transmittance, int y, Table& out);
void skyViewRow(const SkyParams& params, const AirTables& air, int y, Table& out);
void aerialRow(const SkyParams& params, const AirTables& air, int y, Table& inscatter, Table& transmittance);

// Radiance (three floats each) above the horizon from `count` directions, a multiple of 16.
void radiances(const SkyParams& params, const AirTables& air, int steps, const float* elevations, const float* cosSuns,
               std::size_t count, float* out);

}  // namespace welkin::bake
