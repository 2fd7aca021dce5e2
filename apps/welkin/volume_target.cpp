#include "apps/welkin/volume_target.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "welkin/scene/scatterers.hpp"

namespace welkin::app {

std::optional<VolumeTarget> volumeTargetNamed(const std::string& name) {
  if (name == "blender") return VolumeTarget::blender;
  if (name == "houdini") return VolumeTarget::houdini;
  if (name == "unreal") return VolumeTarget::unreal;
  if (name == "mitsuba") return VolumeTarget::mitsuba;
  if (name == "pbrt") return VolumeTarget::pbrt;
  return std::nullopt;
}

VolumeConvention conventionFor(VolumeTarget target) {
  VolumeConvention convention;
  if (target == VolumeTarget::houdini) convention.up = VolumeUp::y;
  if (target == VolumeTarget::unreal) convention.unit = VolumeUnit::cm;
  if (target == VolumeTarget::mitsuba || target == VolumeTarget::pbrt) convention.density = VolumeDensity::extinction;
  return convention;
}

std::string suffixFor(VolumeTarget target) {
  return target == VolumeTarget::mitsuba ? ".vol" : target == VolumeTarget::pbrt ? ".nvdb" : ".vdb";
}

VolumeMedium mediumOf(const Scene& scene, VolumeDensity density) {
  const double extinction = extinctionAtOne(scene, density);
  const Scatterers scatterers = *leadingScatterers(scene);
  return {extinction, scatterers.albedo, meanCosine(scatterers.phase)};
}

std::string instructionsFor(std::optional<VolumeTarget> target, const VolumeMedium& medium,
                            const VolumeConvention& convention, const VoxelBox& box, const std::string& path) {
  const double perUnit = medium.extinction / unitsPerMetre(convention.unit);
  const std::string file = std::filesystem::path(path).filename().string();
  const double a = medium.albedo, g = medium.asymmetry;
  if (!target)
    return fmt::format(
        "A value of 1 is an extinction of {:.6g} for each {}; single-scattering albedo {:g}, mean cosine {:.3f}.\n",
        perUnit, convention.unit == VolumeUnit::m ? "metre" : "centimetre", a, g);
  switch (*target) {
    case VolumeTarget::blender:
      return fmt::format(
          "In Blender: Add > Volume > Import OpenVDB {}. Material, Volume: Principled Volume with\n"
          "  Density {:.6g}   Density Attribute density   Color {:g} {:g} {:g}   Anisotropy {:.3f}\n"
          "Camera > Clip End: some {:.0f} m. Cycles > Volumes: Step Rate Render 1, Max Steps 1024; Light Paths > "
          "Volume: 64 or more.\n",
          file, perUnit, a, a, a, g, 10.0 * glm::length(glm::dvec3(box.dims) * box.voxel));
    case VolumeTarget::houdini:
      return fmt::format(
          "In Houdini: File SOP {} (y up, metres). Pyro or volume shader with\n"
          "  Density Scale {:.6g}   Scattering Albedo {:g}   Phase (anisotropy) {:.3f}\n",
          file, perUnit, a, g);
    case VolumeTarget::unreal:
      return fmt::format(
          "In Unreal: import {} as a Sparse Volume Texture (density as 8 or 16 bit) into a Heterogeneous Volume; "
          "material:\n"
          "  Extinction = density x {:.6g} for each centimetre ({:.6g} for each metre)   Albedo {:g}   Phase {:.3f}\n"
          "One voxel is {:g} cm.\n",
          file, perUnit, medium.extinction, a, g, box.voxel.x);
    case VolumeTarget::mitsuba:
      // Mitsuba multiplies the grid by `scale`; z is up as in the file, its scenes are often y up.
      return fmt::format(
          "In Mitsuba 3, on a cube of the medium's size:\n"
          "  <medium type=\"heterogeneous\">\n"
          "    <volume name=\"sigma_t\" type=\"gridvolume\"><string name=\"filename\" value=\"{}\"/>\n"
          "      <boolean name=\"use_grid_bbox\" value=\"true\"/></volume>\n"
          "    <float name=\"scale\" value=\"{:.6g}\"/> <float name=\"albedo\" value=\"{:g}\"/>\n"
          "    <phase type=\"hg\"><float name=\"g\" value=\"{:.3f}\"/></phase>\n"
          "  </medium>\n",
          file, perUnit, a, g);
    case VolumeTarget::pbrt:
      break;
  }
  return fmt::format(
      "In pbrt-v4, inside a box of the medium's size (no transform: the file has its own):\n"
      "  MakeNamedMedium \"cloud\" \"string type\" \"nanovdb\" \"string filename\" \"{}\"\n"
      "    \"rgb sigma_a\" [ {:g} {:g} {:g} ] \"rgb sigma_s\" [ {:g} {:g} {:g} ] \"float scale\" {:.6g} \"float g\" "
      "{:.3f}\n",
      file, 1.0 - a, 1.0 - a, 1.0 - a, a, a, a, perUnit, g);
}

}  // namespace welkin::app
