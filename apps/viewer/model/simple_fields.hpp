#pragma once
#include <cstddef>
#include <string_view>

namespace welkin::viewer {

// Whether a parameter is shown to those who do not ask for all of them; `table` as tableName() gives it.
bool isSimple(std::string_view table, std::string_view field);
// How many there are.
std::size_t simpleFieldCount();

}  // namespace welkin::viewer
