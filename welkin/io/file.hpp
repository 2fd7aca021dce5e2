#pragma once
// Files as bytes: reading whole ones, and replacing them so that a reader never sees half of one.
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>

namespace welkin {

// The whole file. Throws Error (badInput) when it cannot be read or is longer than `most` bytes.
std::string readFile(const std::string& path, std::size_t most);

// Replaces `path`: `write` fills the temporary file that it is handed (in the same folder), which is then renamed. When
// anything fails, nothing is left behind, an old file is untouched, and Error (failed) says why.
void writeFileAtomically(const std::string& path, const std::function<void(const std::string& temporary)>& write);
void writeFileAtomically(const std::string& path, std::string_view bytes);

// The same for libraries that write to streams: what a stream holds back until it is closed is looked after, and
// whatever the library throws becomes an Error (failed): "cannot be written as FORMAT: ...".
void writeStreamAtomically(const std::string& path, const char* format,
                           const std::function<void(std::ostream& stream)>& write);

// Throws the Error (failed) that writing the file would end in, when its folder is missing or may not be written to:
// before hours of work, not after.
void requireWritable(const std::string& path);

// What the system says of an errno.
std::string systemReason(int error);

// Writes bytes to a file and reports what the system reports late (a full disk). Throws Error (failed).
void writeBytes(const std::string& path, std::string_view bytes);

}  // namespace welkin
