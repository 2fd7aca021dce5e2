#include "welkin/noise/textures.hpp"

#include "welkin/base/error.hpp"
#include "welkin/noise/bake.hpp"
#include "welkin/noise/params.hpp"

namespace welkin {

namespace {
Volume cube(int size, int channels) { return Volume(size, size, size, channels); }
}  // namespace

Volume bakeBaseShape(const BaseShapeSettings& settings) {
  const auto params = baseShapeParams(settings);
  Volume volume = cube(settings.size, 4);
  bake::fillBaseShape(params, volume);
  return volume;
}

Volume bakeBaseShapePacked(const BaseShapeSettings& settings) {
  const auto params = baseShapeParams(settings);
  Volume volume = cube(settings.size, 2);
  bake::fillBaseShape(params, volume);
  return volume;
}

Volume bakeDetail(const DetailSettings& settings) {
  const auto params = detailParams(settings);
  Volume volume = cube(settings.size, 3);
  bake::fillDetail(params, volume);
  return volume;
}

Volume bakeDetailPacked(const DetailSettings& settings) {
  const auto params = detailParams(settings);
  Volume volume = cube(settings.size, 1);
  bake::fillDetail(params, volume);
  return volume;
}

Volume bakeCurl(const CurlSettings& settings) {
  const auto params = curlParams(settings);
  Volume volume(settings.size, settings.size, 1, 2);
  bake::fillCurl(params, volume);
  return volume;
}

Volume bakeProfileBase(const ProfileNoiseSettings& settings) {
  const auto params = profileBaseParams(settings, 0.0f);
  Volume volume = cube(settings.baseSize, 2);
  bake::fillProfileBase(params, volume);
  return volume;
}

Volume bakeProfileBasePacked(const ProfileNoiseSettings& settings, float billowMix) {
  const auto params = profileBaseParams(settings, billowMix);
  Volume volume = cube(settings.baseSize, 1);
  bake::fillProfileBase(params, volume);
  return volume;
}

Volume bakeProfileDetail(const ProfileNoiseSettings& settings) {
  const auto params = profileDetailParams(settings);
  Volume volume = cube(settings.detailSize, 2);
  bake::fillProfileDetail(params, volume);
  return volume;
}

Volume bakeProfileWarp(const ProfileNoiseSettings& settings) {
  const auto params = profileWarpParams(settings);
  Volume volume = cube(settings.warpSize, 2);
  bake::fillProfileWarp(params, volume);
  return volume;
}

Volume bakeBillows(int size, int cells, std::uint32_t seed) {
  if (size < 1 || cells < 1) throw Error(ErrorKind::badInput, "", "billows need a size and cells of at least 1");
  Volume volume = cube(size, 1);
  bake::fillBillows(cells, seed, volume);
  return volume;
}

}  // namespace welkin
