#pragma once
// OpenGL entry points, loaded through a callback of the host. Only .cpp files include this: no GL header reaches a
// public header.
#include <GL/glcorearb.h>

#include <string>

#include "welkin/gl/loader.hpp"

namespace welkin::gl {

// clang-format off
#define WELKIN_GL_FUNCTIONS(F) \
  F(ACTIVETEXTURE, ActiveTexture) F(ATTACHSHADER, AttachShader) F(BINDATTRIBLOCATION, BindAttribLocation) \
  F(BINDBUFFER, BindBuffer) F(BINDBUFFERBASE, BindBufferBase) F(BINDBUFFERRANGE, BindBufferRange) \
  F(BINDFRAMEBUFFER, BindFramebuffer) \
  F(BINDSAMPLER, BindSampler) F(BINDTEXTURE, BindTexture) F(BINDVERTEXARRAY, BindVertexArray) \
  F(BLENDEQUATIONSEPARATE, BlendEquationSeparate) F(BLENDFUNCSEPARATE, BlendFuncSeparate) \
  F(BLITFRAMEBUFFER, BlitFramebuffer) F(BUFFERDATA, BufferData) F(BUFFERSUBDATA, BufferSubData) \
  F(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus) F(CLEAR, Clear) F(CLEARBUFFERFI, ClearBufferfi) F(CLEARBUFFERFV, ClearBufferfv) \
  F(CLEARCOLOR, ClearColor) \
  F(COLORMASK, ColorMask) F(COMPILESHADER, CompileShader) F(COPYTEXSUBIMAGE3D, CopyTexSubImage3D) \
  F(CREATEPROGRAM, CreateProgram) \
  F(CREATESHADER, CreateShader) F(DELETEBUFFERS, DeleteBuffers) F(DELETEFRAMEBUFFERS, DeleteFramebuffers) \
  F(DELETEPROGRAM, DeleteProgram) F(DELETEQUERIES, DeleteQueries) F(DELETESAMPLERS, DeleteSamplers) \
  F(DELETESHADER, DeleteShader) F(DELETETEXTURES, DeleteTextures) F(DELETEVERTEXARRAYS, DeleteVertexArrays) \
  F(DEPTHFUNC, DepthFunc) F(DEPTHMASK, DepthMask) F(DISABLE, Disable) F(DRAWARRAYS, DrawArrays) \
  F(DRAWARRAYSINSTANCED, DrawArraysInstanced) F(DRAWBUFFERS, DrawBuffers) F(DRAWELEMENTS, DrawElements) \
  F(ENABLE, Enable) F(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) F(FINISH, Finish) \
  F(FLUSH, Flush) F(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D) \
  F(FRAMEBUFFERTEXTURELAYER, FramebufferTextureLayer) F(GENBUFFERS, GenBuffers) \
  F(GENFRAMEBUFFERS, GenFramebuffers) F(GENQUERIES, GenQueries) F(GENSAMPLERS, GenSamplers) \
  F(GENTEXTURES, GenTextures) F(GENVERTEXARRAYS, GenVertexArrays) F(GETACTIVEUNIFORM, GetActiveUniform) \
  F(GETACTIVEUNIFORMSIV, GetActiveUniformsiv) F(GETBOOLEANV, GetBooleanv) F(GETERROR, GetError) \
  F(GETFLOATV, GetFloatv) F(GETINTEGERV, GetIntegerv) F(GETINTEGERI_V, GetIntegeri_v) \
  F(GETPROGRAMINFOLOG, GetProgramInfoLog) F(GETPROGRAMIV, GetProgramiv) \
  F(GETQUERYOBJECTUIV, GetQueryObjectuiv) F(GETSHADERINFOLOG, GetShaderInfoLog) F(GETSHADERIV, GetShaderiv) \
  F(GETSTRING, GetString) F(GETSTRINGI, GetStringi) F(GETUNIFORMBLOCKINDEX, GetUniformBlockIndex) \
  F(GETUNIFORMINDICES, GetUniformIndices) F(GETUNIFORMLOCATION, GetUniformLocation) F(ISENABLED, IsEnabled) \
  F(LINKPROGRAM, LinkProgram) F(PIXELSTOREI, PixelStorei) F(READBUFFER, ReadBuffer) F(READPIXELS, ReadPixels) \
  F(SAMPLERPARAMETERI, SamplerParameteri) F(SCISSOR, Scissor) F(SHADERSOURCE, ShaderSource) \
  F(STENCILFUNC, StencilFunc) F(STENCILOP, StencilOp) \
  F(TEXIMAGE2D, TexImage2D) F(TEXIMAGE3D, TexImage3D) F(TEXPARAMETERI, TexParameteri) \
  F(TEXSUBIMAGE2D, TexSubImage2D) F(TEXSUBIMAGE3D, TexSubImage3D) F(UNIFORM1F, Uniform1f) F(UNIFORM1I, Uniform1i) \
  F(UNIFORM1UI, Uniform1ui) F(UNIFORM2F, Uniform2f) F(UNIFORM2I, Uniform2i) F(UNIFORM3F, Uniform3f) \
  F(UNIFORM4F, Uniform4f) F(UNIFORM4I, Uniform4i) F(UNIFORM4FV, Uniform4fv) F(UNIFORMBLOCKBINDING, UniformBlockBinding) \
  F(UNIFORMMATRIX3FV, UniformMatrix3fv) F(UNIFORMMATRIX4FV, UniformMatrix4fv) F(USEPROGRAM, UseProgram) \
  F(VERTEXATTRIBPOINTER, VertexAttribPointer) \
  F(VIEWPORT, Viewport) F(CULLFACE, CullFace)
// Absent from some contexts that we serve; null there.
#define WELKIN_GL_OPTIONAL_FUNCTIONS(F) \
  F(QUERYCOUNTER, QueryCounter) F(GETQUERYOBJECTUI64V, GetQueryObjectui64v) F(GETTEXIMAGE, GetTexImage) \
  F(POLYGONMODE, PolygonMode) F(CLIPCONTROL, ClipControl)
// clang-format on

struct Api {
#define WELKIN_GL_MEMBER(UPPER, Name) PFNGL##UPPER##PROC Name = nullptr;
  WELKIN_GL_FUNCTIONS(WELKIN_GL_MEMBER)
  WELKIN_GL_OPTIONAL_FUNCTIONS(WELKIN_GL_MEMBER)
#undef WELKIN_GL_MEMBER
  bool es = false;           // an OpenGL ES context
  int major = 0, minor = 0;  // its version

  bool hasExtension(const char* name) const;
  // What GL_RENDERER says; "unknown" where it says nothing.
  std::string driver() const;
  // Whether the processor draws: Mesa's drivers for machines without a GPU.
  bool software() const;
  // Throws Error (failed) naming `doing` when OpenGL has recorded an error.
  void check(const char* doing) const;
};

// Loads every entry point of the current context. Throws Error (noOpenGl) when the context is older than OpenGL 3.3 or
// OpenGL ES 3.0, or lacks an entry point or float render targets.
Api loadApi(const Loader& getProcAddress);

}  // namespace welkin::gl
