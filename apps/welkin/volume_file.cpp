#include "apps/welkin/volume_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "apps/welkin/usage_error.hpp"
#include "welkin/io/file.hpp"
#include "welkin/io/mitsuba_volume.hpp"
#include "welkin/io/nanovdb.hpp"

namespace welkin::app {

void requireVolumeFile(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension().string();
  if (suffix != ".vdb" && suffix != ".nvdb" && suffix != ".vol")
    throw UsageError(fmt::format("'{}': a volume's name ends in .vdb, .nvdb (NanoVDB) or .vol (Mitsuba)", path));
  const bool missing = (suffix == ".vdb" && !hasOpenVdb()) || (suffix == ".nvdb" && !hasNanoVdb());
  if (missing) saveVolume(path, VoxelGrid({1, 1, 1}, {}, glm::dvec3(1.0)), {}, VolumePrecision::half);  // says why not
  requireWritable(path);
}

std::vector<VolumeNote> volumeNotes(const Scene& scene, const std::string& sky, const VolumeConvention& convention,
                                    double time) {
  const VolumeMedium medium = mediumOf(scene, convention.density);
  static constexpr const char* kMeaning[] = {"normalized extinction", "extinction in 1/m", "liquid water in g/m^3"};
  std::vector<VolumeNote> notes{{"sky", sky},
                                {"seed", std::int64_t{scene.seed}},
                                {"time", time},
                                {"up_axis", std::string(convention.up == VolumeUp::z ? "z" : "y")},
                                {"units", std::string(convention.unit == VolumeUnit::m ? "m" : "cm")},
                                {"density_semantics", std::string(kMeaning[static_cast<int>(convention.density)])},
                                {"extinction_per_metre_at_1", medium.extinction},
                                {"scattering_albedo", medium.albedo},
                                {"asymmetry_g", medium.asymmetry}};
  if (!scene.title.empty()) notes.push_back({"title", scene.title});
  return notes;
}

void saveVolume(const std::string& path, const VoxelGrid& grid, std::span<const VolumeNote> notes,
                VolumePrecision precision) {
  if (path.ends_with(".vdb")) return saveVdb(path, grid, notes, precision);
  if (path.ends_with(".nvdb")) return saveNanoVdb(path, grid);
  saveMitsubaVolume(path, grid);
}

}  // namespace welkin::app
