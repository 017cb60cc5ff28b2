#pragma once

// Values of Python as those of the engine, and back.

#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include "formats/image.h"
#include "scene/vox_file.h"

namespace voxilux {

// A str or an os.PathLike as text.
[[nodiscard]] std::string path_of(const pybind11::handle& path);
[[nodiscard]] bool is_path(const pybind11::handle& value);

// Keyword arguments as the words of a command line: size=(640, 360) is --size=640x360, D={"sun.on": "false"}
// is -D sun.on=false, True is a flag without a value, None and False are no flag.
[[nodiscard]] std::vector<std::string> words_of(const pybind11::kwargs& flags);

// The planes of an image by the names of their channels, [height][width]. They are moved into the arrays.
[[nodiscard]] pybind11::dict planes_of(Image&& image);

// A file, an array [height][width] or [height][width][3] in linear light, or a dict as planes_of gives it.
// Throws Error: usage, input_refused.
[[nodiscard]] Image image_of(const pybind11::handle& picture);

// {"voxels": palette indices [x][y][z], "palette": [256][4], "low": cell of the first, "materials": {index:
// attributes}} of the visible voxels at frame 0.
[[nodiscard]] pybind11::dict voxels_of(const VoxFile& file);

// The reverse; all but "voxels" may be missing. `name` is that of the model. Throws Error(usage).
[[nodiscard]] VoxFile vox_file_of(const pybind11::dict& voxels, const std::string& name);

[[nodiscard]] pybind11::object object_of(const nlohmann::ordered_json& json);

}  // namespace voxilux
