#pragma once
// Volumes as files, and what the files say of themselves.
#include <string>
#include <vector>

#include "apps/welkin/volume_target.hpp"
#include "welkin/io/vdb.hpp"

namespace welkin::app {

// Throws UsageError unless the name ends in .vdb, .nvdb or .vol, Error (failed) when it cannot be written or this build
// has no such format.
void requireVolumeFile(const std::string& path);

// The metadata of a volume: of which sky it is at which time, and what its values mean.
std::vector<VolumeNote> volumeNotes(const Scene& scene, const std::string& sky, const VolumeConvention& convention,
                                    double time);

// Writes in the format of the name's ending; notes and precision are for .vdb. Throws Error.
void saveVolume(const std::string& path, const VoxelGrid& grid, std::span<const VolumeNote> notes,
                VolumePrecision precision);

}  // namespace welkin::app
