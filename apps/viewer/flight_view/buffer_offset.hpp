#pragma once
#include <cstddef>

namespace welkin::viewer {

// A place in the buffer that is bound, which OpenGL takes as a pointer; bytes.
inline const void* bufferOffset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace welkin::viewer
