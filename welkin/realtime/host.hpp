#pragma once
// What the host's own shaders are given: their text, a view's uniform block, textures. Like gl/objects.hpp, for .cpp
// files only.
#include <span>
#include <string>

#include "welkin/atmosphere/tables.hpp"
#include "welkin/gl/objects.hpp"
#include "welkin/realtime/frame_params.hpp"
#include "welkin/realtime/law.hpp"

namespace welkin::realtime {

// shaders/host.glsl with all that it includes. Whatever is declared there gets "welkin_" before its name, but for what
// begins with "welkin" anyway.
const std::string& hostShaderText();

// The members that follow from the frame's march; the view's own (setHostView) are left at 0.
law::HostParams hostParams(const law::AtmosphereParams& air, const law::LightVolumeParams* volume,
                           const law::MarchParams& march, const SkyLight& light);

// What belongs to a view. `exposure`: factor on the light that its history holds (FrameParams::wind.w).
void setHostView(law::HostParams& host, const Frame& frame, const FrameParams& params);

// A sampler of the include; a null texture leaves its unit empty.
struct HostSampler {
  const char* name;
  GLenum target;
  const gl::Texture* texture;
};

// Points `program` at the block and the samplers: see Renderer::bindHost for what this changes.
void bindHost(const gl::Api& gl, unsigned program, unsigned firstUnit, unsigned block, const gl::UniformBuffer& buffer,
              std::span<const HostSampler> samplers);

}  // namespace welkin::realtime
