#pragma once
// From settings to the parameters of the law's texels; for both routes.
#include "welkin/noise/law.hpp"
#include "welkin/noise/settings.hpp"

namespace welkin {

// Throw Error (badInput) for a setting outside its field table's range.
law::BaseShapeParams baseShapeParams(const BaseShapeSettings& settings);
law::DetailParams detailParams(const DetailSettings& settings);
law::CurlParams curlParams(const CurlSettings& settings);
// The next three measure the raw channels at 4096 texels spread evenly over the tile to stretch them.
law::ProfileBaseParams profileBaseParams(const ProfileNoiseSettings& settings, float billowMix);
law::ProfileDetailParams profileDetailParams(const ProfileNoiseSettings& settings);
law::ProfileWarpParams profileWarpParams(const ProfileNoiseSettings& settings);

}  // namespace welkin
