// import welkin: skies, their density as arrays, pictures and volumes. `welkin/__init__.py` is what users see of it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/welkin/picture.hpp"
#include "apps/welkin/presets.hpp"
#include "apps/welkin/statistics.hpp"
#include "apps/welkin/volume_file.hpp"
#include "integrations/python/calls.hpp"
#include "integrations/python/values.hpp"
#include "welkin/base/error.hpp"
#include "welkin/io/grids.hpp"
#include "welkin/io/sky_file.hpp"
#include "welkin/scene/features.hpp"
#include "welkin/trace/denoise.hpp"
#include "welkin/trace/path_tracer.hpp"

namespace welkin::python {

namespace py = pybind11;

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

constexpr int kMostPixels = 16384;   // of a side
constexpr double kMostVoxels = 2e9;  // of an array

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw Error(ErrorKind::badInput, where, what);
}

struct Sky {
  Scene scene;
};

struct Clouds {
  explicit Clouds(const Scene& s) : scene(s), field(app::densityField(s)) {}
  Scene scene;
  DensityField field;
};

SceneList listNamed(Scene& scene, const std::string& name) {
  for (SceneList& list : listsOf(scene))
    if (list.name == name) return std::move(list);
  refuse(name, "is not a list of a sky");
}

// An array of (..., size) numbers as so many tuples; all of them finite.
template <class Tuple>
std::vector<Tuple> tuples(const Doubles& array, int size, const char* what) {
  if (array.ndim() < 1 || array.shape(array.ndim() - 1) != size)
    refuse("", fmt::format("{} are an array of shape (..., {}), in m", what, size));
  std::vector<Tuple> all(static_cast<std::size_t>(array.size() / size));
  const double* from = array.data();
  for (Tuple& tuple : all)
    for (int c = 0; c < size; ++c, ++from) {
      if (!std::isfinite(*from)) refuse("", fmt::format("{} must be finite; there is {} among them", what, *from));
      tuple[c] = *from;
    }
  return all;
}

// Results for tuples of an array, in its shape without the last axis.
template <class T>
py::array_t<float> shaped(const Doubles& like, const std::vector<T>& values) {
  std::vector<py::ssize_t> shape(like.shape(), like.shape() + like.ndim() - 1);
  py::array_t<float> result(shape);
  std::copy(values.begin(), values.end(), result.mutable_data());
  return result;
}

void requireSize(int width, int height) {
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels)
    refuse(fmt::format("{}x{}", width, height), fmt::format("a picture has 1 to {} pixels a side", kMostPixels));
}

py::array_t<float> arrayOf(const Image& image) {
  py::array_t<float> array({image.height, image.width, image.channels});
  std::copy(image.pixels.begin(), image.pixels.end(), array.mutable_data());
  return array;
}

Image imageOf(const py::array_t<float, py::array::c_style | py::array::forcecast>& array) {
  if (array.ndim() != 3 || array.shape(2) < 1 || array.shape(2) > 4 || array.size() == 0)
    refuse("", "a picture is an array of shape (height, width, 1 to 4)");
  Image image(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), static_cast<int>(array.shape(2)));
  std::copy_n(array.data(), image.pixels.size(), image.pixels.begin());
  return image;
}

py::array_t<float> render(const Sky& sky, int width, int height, int frames, py::object progress) {
  requireSize(width, height);
  if (frames < 0) refuse(fmt::format("frames={}", frames), "must not be negative");
  const Scene scene = sky.scene;
  return arrayOf(Watch(std::move(progress)).run([&](const Progress& watch) {
    return app::renderSky(scene, {.width = width, .height = height, .frames = frames, .progress = watch});
  }));
}

py::array_t<float> trace(const Sky& sky, int width, int height, int samples, double noise, double seconds, bool denoise,
                         py::object progress) {
  requireSize(width, height);
  if (samples < 1 || !(noise >= 0.0) || !(seconds >= 0.0))
    refuse("", "samples must be positive, noise and seconds not negative");
  const Scene scene = sky.scene;
  return arrayOf(Watch(std::move(progress)).run([&](const Progress& watch) {
    const std::vector<Volume> maps = app::weatherMaps(scene);
    const std::vector<PlacedGrid> grids = loadGrids(scene);
    trace::PathTracer tracer(
        scene, {.weatherMaps = maps, .grids = grids},
        {.width = width, .height = height, .samples = samples, .noise = noise, .seconds = seconds});
    if (!tracer.run(watch)) throw Cancelled();
    const trace::TraceLayers layers = tracer.layers();
    return denoise ? trace::denoise(layers) : layers.radiance;
  }));
}

double exposureOf(const Film& film, const Image& light) {
  return film.exposure == ExposureMode::automatic ? automaticEv(light) : film.ev;
}

py::array_t<std::uint8_t> display(const Sky& sky, const py::array_t<float>& light) {
  const Image image = imageOf(light);
  const Film& film = sky.scene.film;
  const std::vector<std::uint8_t> bytes = displayBytes(image, app::toneOf(film, exposureOf(film, image)));
  py::array_t<std::uint8_t> array({image.height, image.width, image.channels});
  std::copy(bytes.begin(), bytes.end(), array.mutable_data());
  return array;
}

void savePicture(const Sky& sky, const std::filesystem::path& file, const py::array_t<float>& light) {
  const std::string path = file.string();
  app::requirePictureFile(path);
  Image image = imageOf(light);
  image.features = featuresOf(sky.scene);
  app::savePicture(path, image, sky.scene.film);
}

template <class E>
E choice(const char* what, const std::string& text, std::initializer_list<std::pair<const char*, E>> names) {
  std::string known;
  for (const auto& [name, meaning] : names) {
    if (text == name) return meaning;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
  }
  refuse(fmt::format("{}={}", what, text), "must be one of " + known);
}

app::Region regionOf(const std::vector<double>& numbers, const Scene& scene, double voxel) {
  if (!(voxel >= 0.05 && voxel <= 10000.0)) refuse(fmt::format("voxel={}", voxel), "must be 0.05 to 10000 m");
  return app::regionOf(fmt::format("{}", fmt::join(numbers, ",")), scene, voxel);
}

py::dict bake(const Sky& sky, const std::filesystem::path& file, double voxel, const std::vector<double>& box,
              const std::string& target, const std::string& density, const std::string& precision,
              py::object progress) {
  const std::string path = file.string();
  app::requireVolumeFile(path);
  app::VolumeConvention convention;
  if (!target.empty()) {
    const auto known = app::volumeTargetNamed(target);
    if (!known) refuse("target=" + target, "must be one of blender, houdini, unreal, mitsuba, pbrt");
    convention = app::conventionFor(*known);
  }
  if (!density.empty())
    convention.density = choice<app::VolumeDensity>("density", density,
                                                    {{"normalized", app::VolumeDensity::normalized},
                                                     {"extinction", app::VolumeDensity::extinction},
                                                     {"lwc", app::VolumeDensity::lwc}});
  const auto bits = choice<VolumePrecision>("precision", precision,
                                            {{"half", VolumePrecision::half}, {"float", VolumePrecision::full}});
  const Scene scene = sky.scene;
  const double one = app::extinctionAtOne(scene, convention.density);
  const app::VolumeMedium medium = app::mediumOf(scene, convention.density);
  const VoxelBox where = app::boxOf(regionOf(box, scene, voxel), voxel, convention);
  const float most = Watch(std::move(progress)).run([&](const Progress& watch) {
    const VoxelGrid grid = bakeVoxels(app::densityField(scene), where, app::bakingOf(convention, one), watch);
    app::saveVolume(path, grid, app::volumeNotes(scene, scene.title, convention, scene.time), bits);
    return grid.maximum();
  });
  py::dict made;
  made["density"] = medium.extinction / app::unitsPerMetre(convention.unit);
  made["albedo"] = medium.albedo;
  made["asymmetry"] = medium.asymmetry;
  made["origin"] = py::make_tuple(where.origin.x, where.origin.y, where.origin.z);
  made["shape"] = py::make_tuple(where.dims.x, where.dims.y, where.dims.z);
  made["voxel"] = where.voxel.x;
  made["maximum"] = most;
  return made;
}

py::array_t<float> extinction(const Clouds& clouds, const Doubles& points, float footprint) {
  if (!(footprint >= 0.0f) || !std::isfinite(footprint))
    refuse(fmt::format("footprint={}", footprint), "must be a length in m, 0 for all detail");
  const std::vector<glm::dvec3> places = tuples<glm::dvec3>(points, 3, "points");
  std::vector<float> found;
  {
    const py::gil_scoped_release others;
    found = clouds.field.extinction(places, footprint);
  }
  return shaped(points, found);
}

py::array_t<float> opticalDepth(const Clouds& clouds, const Doubles& places, double low, double high, double step) {
  if (!(low < high && step > 0.0 && (high - low) / step <= 1e6))
    refuse(fmt::format("low={}, high={}, step={}", low, high, step),
           "low is below high, and a step at least a "
           "millionth of the way");
  const std::vector<glm::dvec2> all = tuples<glm::dvec2>(places, 2, "places");
  std::vector<double> found;
  {
    const py::gil_scoped_release others;
    for (const glm::dvec2& place : all) found.push_back(clouds.field.opticalDepth(place, low, high, step));
  }
  return shaped(places, found);
}

// Extinction at the centres of the voxels of a box, [east, north, up], and its lower corner.
py::tuple voxels(const Clouds& clouds, double voxel, const std::vector<double>& box, py::object progress) {
  const app::Region region = regionOf(box, clouds.scene, voxel);
  const VoxelBox where = app::boxOf(region, voxel, {});
  const double count = static_cast<double>(where.dims.x) * where.dims.y * where.dims.z;
  if (count > kMostVoxels)
    refuse(fmt::format("voxel={}", voxel),
           fmt::format("would make {:.2g} voxels; an array holds at most {:.2g}: choose "
                       "larger voxels or a smaller region",
                       count, kMostVoxels));
  py::array_t<float> array({where.dims.x, where.dims.y, where.dims.z});
  float* to = array.mutable_data();
  Watch(std::move(progress)).run([&](const Progress& watch) {
    const VoxelGrid grid = bakeVoxels(clouds.field, where, {}, watch);
    for (int x = 0; x < where.dims.x; ++x)
      for (int y = 0; y < where.dims.y; ++y)
        for (int z = 0; z < where.dims.z; ++z) *to++ = grid.at({x, y, z});
  });
  return py::make_tuple(array, py::make_tuple(where.origin.x, where.origin.y, where.origin.z));
}

py::list pathsOf(Sky& sky) {
  py::list paths;
  for (const Section& section : sectionsOf(sky.scene))
    for (const Field& f : section.fields) paths.append(section.path.empty() ? f.name : section.path + "." + f.name);
  return paths;
}

py::list presets(const std::string& folder) {
  py::list all;
  for (const app::Preset& p : app::presetsIn(folder)) {
    py::dict row;
    row["name"] = p.name;
    row["genus"] = p.genus;
    row["sentence"] = p.sentence;
    row["file"] = p.file;
    all.append(row);
  }
  return all;
}

}  // namespace

PYBIND11_MODULE(_welkin, module) {
  defineErrors(module);
  module.attr("__version__") = WELKIN_VERSION;
  module.def("fields", &fields, "Every parameter of a sky: path, kind, unit, default, range, slider, choices, help.");
  module.def("presets", &presets);
  py::class_<Sky>(module, "Sky")
      .def(py::init<>())
      .def("_load",
           [](Sky& s, const std::string& sky, const std::string& folder) { s.scene = app::loadSkyNamed(sky, folder); })
      .def("_parse", [](Sky& s, const std::string& text, const std::string& name) { s.scene = parseSky(text, name); })
      .def("_copy", [](Sky& s, const Sky& other) { s.scene = other.scene; })
      .def("_same", [](const Sky& a, const Sky& b) { return sameScene(a.scene, b.scene); })
      .def("_get", [](Sky& s, const std::string& path) { return get(s.scene, path); })
      .def("_set", [](Sky& s, const std::string& path, const py::handle& value) { set(s.scene, path, value); })
      .def("_lists",
           [](Sky& s) {
             py::dict sizes;
             for (const SceneList& list : listsOf(s.scene)) sizes[py::str(list.name)] = list.size;
             return sizes;
           })
      .def("_append",
           [](Sky& s, const std::string& name) {
             const SceneList list = listNamed(s.scene, name);
             if (list.size >= list.most) refuse(name, fmt::format("a sky has at most {} [[{}]]", list.most, name));
             list.append();
           })
      .def("_remove",
           [](Sky& s, const std::string& name, std::size_t i) {
             const SceneList list = listNamed(s.scene, name);
             if (i >= list.size) throw py::index_error();
             list.remove(i);
           })
      .def("_paths", &pathsOf)
      .def(
          "text", [](const Sky& s) { return writeSky(s.scene); }, "The sky as a sky file writes it.")
      .def(
          "save", [](const Sky& s, const std::filesystem::path& path) { saveSky(s.scene, path.string()); },
          py::arg("path"), "Writes a sky file.")
      .def(
          "render", &render, py::arg("width") = 640, py::arg("height") = 360, py::arg("frames") = 0,
          py::arg("progress") = py::none(),
          "The real-time renderer's picture: float32 (height, width, 3), top row first, linear Rec.709 in kcd/m^2. "
          "`frames` temporal frames make it; 0 takes four marches a pixel. `progress(share)` may return False to stop.")
      .def("trace", &trace, py::arg("width") = 320, py::arg("height") = 180, py::arg("samples") = 64,
           py::arg("noise") = 0.0, py::arg("seconds") = 0.0, py::arg("denoise") = false,
           py::arg("progress") = py::none(),
           "The path tracer's picture, in the form of render(). `samples` paths a pixel, with `noise` at most; "
           "`seconds` > 0 ends it then.")
      .def("display", &display, py::arg("light"),
           "What a display shows of linear light (height, width, channels): uint8 sRGB through the sky's film.")
      .def("save_picture", &savePicture, py::arg("path"), py::arg("light"),
           "Writes .png (through the sky's film) or .exr (as it is).")
      .def(
          "bake", &bake, py::arg("path"), py::arg("voxel") = 10.0, py::arg("region") = std::vector<double>(),
          py::arg("target") = "", py::arg("density") = "", py::arg("precision") = "half",
          py::arg("progress") = py::none(),
          "Writes the clouds as .vdb, .nvdb or .vol: voxels of so many m in (west, south, east, north[, bottom, top]), "
          "as `welkin vdb` takes them. Returns the medium that the values stand for and the box.")
      .def(
          "clouds",
          [](const Sky& s) {
            const Scene scene = s.scene;
            const py::gil_scoped_release others;
            return std::make_unique<Clouds>(scene);
          },
          "The sky's clouds as they are now, to be asked for their density.");
  py::class_<Clouds>(module, "Clouds")
      .def("extinction", &extinction, py::arg("points"), py::arg("footprint") = 0.0f,
           "Extinction in 1/m at points (..., 3): east, north, altitude above the ground in m. Detail finer than "
           "`footprint` m is replaced by its mean.")
      .def("optical_depth", &opticalDepth, py::arg("places"), py::arg("low"), py::arg("high"), py::arg("step") = 10.0,
           "Vertical optical depth between two altitudes over places (..., 2), without sheets.")
      .def("voxels", &voxels, py::arg("voxel") = 50.0, py::arg("region") = std::vector<double>(),
           py::arg("progress") = py::none(),
           "Extinction in 1/m at the centres of voxels, float32 [east, north, up], and the lower corner of the box, "
           "which is rounded outward to bricks of 8 voxels.");
}

}  // namespace welkin::python
