#include "apps/viewer/model/simple_fields.hpp"

#include <algorithm>
#include <array>

namespace welkin::viewer {

namespace {

struct SimpleField {
  std::string_view table, field;
};
constexpr std::array kSimple{
    SimpleField{"", "title"},
    SimpleField{"", "time"},
    SimpleField{"", "seed"},
    SimpleField{"sun", "mode"},
    SimpleField{"sun", "elevation"},
    SimpleField{"sun", "azimuth"},
    SimpleField{"moon", "mode"},
    SimpleField{"moon", "phase"},
    SimpleField{"night", "stars"},
    SimpleField{"night", "milky_way"},
    SimpleField{"atmosphere", "model"},
    SimpleField{"atmosphere", "mie"},
    SimpleField{"atmosphere", "haze"},
    SimpleField{"wind", "speed"},
    SimpleField{"wind", "from"},
    SimpleField{"precipitation", "rate"},
    SimpleField{"precipitation", "temperature"},
    SimpleField{"lightning", "rate"},
    SimpleField{"ground", "albedo"},
    SimpleField{"lighting", "model"},
    SimpleField{"camera", "position"},
    SimpleField{"camera", "heading"},
    SimpleField{"camera", "pitch"},
    SimpleField{"camera", "fov"},
    SimpleField{"film", "exposure"},
    SimpleField{"film", "ev"},
    SimpleField{"film", "compensation"},
    SimpleField{"film", "tone"},
    SimpleField{"film", "white_balance"},
    SimpleField{"quality", "preset"},
    SimpleField{"layer", "shape"},
    SimpleField{"layer", "base"},
    SimpleField{"layer", "thickness"},
    SimpleField{"layer", "extinction"},
    SimpleField{"layer.weather", "population"},
    SimpleField{"layer.weather", "coverage"},
    SimpleField{"layer.weather", "precipitation"},
    SimpleField{"layer.weather", "type"},
    SimpleField{"layer.weather", "cell_size"},
    SimpleField{"layer.weather", "anvil"},
    SimpleField{"layer.profile", "erosion"},
    SimpleField{"layer.profile", "detail"},
    SimpleField{"layer.profile", "warp"},
    SimpleField{"layer.nubis", "detail_erosion"},
    SimpleField{"hero", "species"},
    SimpleField{"hero", "position"},
    SimpleField{"hero", "heading"},
    SimpleField{"hero", "scale"},
    SimpleField{"hero", "age"},
    SimpleField{"sheet", "kind"},
    SimpleField{"sheet", "height"},
    SimpleField{"sheet", "optical_depth"},
    SimpleField{"sheet", "coverage"},
    SimpleField{"grid", "file"},
};

}  // namespace

bool isSimple(std::string_view table, std::string_view field) {
  return std::any_of(kSimple.begin(), kSimple.end(),
                     [&](const SimpleField& s) { return s.table == table && s.field == field; });
}

std::size_t simpleFieldCount() { return kSimple.size(); }

}  // namespace welkin::viewer
