#pragma once
// The noise textures on the GPU, as half floats: the same texels as noise/textures.hpp, to one unit of the last place.
// For .cpp files only, as gl/objects.hpp. The functions leave their own framebuffer, program, vertex array, viewport
// and bindings behind and expect blending, depth test, scissor and colour mask to be off. All repeat and filter
// linearly.
#include "welkin/gl/objects.hpp"
#include "welkin/noise/settings.hpp"
#include "welkin/noise/volume.hpp"

namespace welkin::realtime {

gl::Texture generateBaseShape(const gl::Api& gl, const BaseShapeSettings& settings);        // RGBA16F
gl::Texture generateBaseShapePacked(const gl::Api& gl, const BaseShapeSettings& settings);  // RG16F
gl::Texture generateDetail(const gl::Api& gl, const DetailSettings& settings);              // RGBA16F, alpha 1
gl::Texture generateDetailPacked(const gl::Api& gl, const DetailSettings& settings);        // R16F
gl::Texture generateCurl(const gl::Api& gl, const CurlSettings& settings);                  // RG16F, a plane
gl::Texture generateProfileBase(const gl::Api& gl, const ProfileNoiseSettings& settings);   // RG16F
gl::Texture generateProfileBasePacked(const gl::Api& gl, const ProfileNoiseSettings& settings,
                                      float billowMix);                                      // R16F
gl::Texture generateProfileDetail(const gl::Api& gl, const ProfileNoiseSettings& settings);  // RG16F
gl::Texture generateProfileWarp(const gl::Api& gl, const ProfileNoiseSettings& settings);    // RG16F

// A volume of any origin as a half float texture with as many channels, or four for three. Texels are rounded here, to
// nearest even, because drivers differ (Mesa cuts).
gl::Texture textureFromVolume(const gl::Api& gl, Volume volume);

// The first `channels` channels of a float texture, waiting for the driver to finish it.
Volume volumeFromTexture(const gl::Api& gl, const gl::Texture& texture, int channels);

}  // namespace welkin::realtime
