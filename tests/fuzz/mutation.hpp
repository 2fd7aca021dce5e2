#pragma once
// What every fuzz test does to a file; each adds what its format is prone to.
#include <algorithm>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace welkin::test {

using Random = std::mt19937;
using Mutation = std::function<void(std::string& bytes, std::size_t at, Random& random)>;

inline std::size_t below(Random& random, std::size_t n) { return n == 0 ? 0 : random() % n; }

inline void anotherDigit(std::string& text, std::size_t at, Random& random) {
  const std::size_t digit = text.find_first_of("0123456789", at);
  if (digit != std::string::npos) text[digit] = static_cast<char>('0' + random() % 10);
}

// Inserts one of the pieces.
inline Mutation piece(std::span<const std::string_view> pieces) {
  return [pieces](std::string& text, std::size_t at, Random& random) {
    text.insert(at, pieces[below(random, pieces.size())]);
  };
}

// A flipped bit, another byte, an early end, some bytes less, a stretch said twice, or one of `own`, at a place of the
// first `reach` bytes.
inline void mutate(std::string& bytes, Random& random, std::span<const Mutation> own,
                   std::size_t reach = std::string::npos) {
  const std::size_t at = below(random, std::min(reach, bytes.size()));
  const std::size_t choice = random() % (5 + own.size());
  switch (choice) {
    case 0:
      if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    case 1:
      if (!bytes.empty()) bytes[at] = static_cast<char>(random());
      break;
    case 2:
      bytes.resize(at);
      break;
    case 3:
      bytes.erase(at, 1 + random() % 16);
      break;
    case 4:
      bytes.insert(at, bytes.substr(at, 1 + random() % 64));
      break;
    default:
      own[choice - 5](bytes, at, random);
  }
}

}  // namespace welkin::test
