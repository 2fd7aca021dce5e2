#pragma once
// The host's own OpenGL: a context without a window and the functions that this program calls, loaded one by one.
// Nothing here is Welkin's.
#include <GL/glcorearb.h>

#include <string>

namespace host {

// clang-format off
#define HOST_GL_FUNCTIONS(F) \
  F(ATTACHSHADER, AttachShader) F(BINDBUFFER, BindBuffer) F(BINDFRAMEBUFFER, BindFramebuffer) \
  F(BINDTEXTURE, BindTexture) F(BINDVERTEXARRAY, BindVertexArray) F(BLENDFUNC, BlendFunc) F(BUFFERDATA, BufferData) \
  F(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus) F(CLEAR, Clear) F(CLEARCOLOR, ClearColor) \
  F(CLEARDEPTH, ClearDepth) F(COMPILESHADER, CompileShader) F(CREATEPROGRAM, CreateProgram) \
  F(CREATESHADER, CreateShader) F(DEPTHFUNC, DepthFunc) F(DEPTHMASK, DepthMask) F(DISABLE, Disable) \
  F(DRAWARRAYS, DrawArrays) F(DRAWELEMENTS, DrawElements) F(ENABLE, Enable) \
  F(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) F(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D) \
  F(GENBUFFERS, GenBuffers) F(GENFRAMEBUFFERS, GenFramebuffers) F(GENTEXTURES, GenTextures) \
  F(GENVERTEXARRAYS, GenVertexArrays) F(GETERROR, GetError) F(GETINTEGERV, GetIntegerv) \
  F(GETPROGRAMINFOLOG, GetProgramInfoLog) F(GETPROGRAMIV, GetProgramiv) F(GETSHADERINFOLOG, GetShaderInfoLog) \
  F(GETSHADERIV, GetShaderiv) F(GETSTRINGI, GetStringi) F(GETUNIFORMLOCATION, GetUniformLocation) \
  F(LINKPROGRAM, LinkProgram) F(READPIXELS, ReadPixels) F(SHADERSOURCE, ShaderSource) F(TEXIMAGE2D, TexImage2D) \
  F(TEXPARAMETERI, TexParameteri) F(UNIFORM1F, Uniform1f) F(UNIFORM3F, Uniform3f) F(UNIFORMMATRIX4FV, UniformMatrix4fv) \
  F(USEPROGRAM, UseProgram) F(VERTEXATTRIBPOINTER, VertexAttribPointer) F(VIEWPORT, Viewport)
// clang-format on

struct Gl {
#define HOST_GL_MEMBER(UPPER, Name) PFNGL##UPPER##PROC Name = nullptr;
  HOST_GL_FUNCTIONS(HOST_GL_MEMBER)
#undef HOST_GL_MEMBER
  PFNGLCLIPCONTROLPROC ClipControl = nullptr;  // null before OpenGL 4.5 without ARB_clip_control
};

void* getProcAddress(const char* name);

// Makes an OpenGL 3.3 core context current, without a window. Throws std::runtime_error.
Gl openContext();

GLuint makeProgram(const Gl& gl, const std::string& vertex, const std::string& fragment);

}  // namespace host
