#include "python/numpy_values.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/json.h"
#include "formats/image_file.h"
#include "parse_values.h"
#include "voxelizer/index_grid.h"

namespace py = pybind11;

namespace voxilux {
namespace {

template <class T>
using Dense = py::array_t<T, py::array::c_style | py::array::forcecast>;  // copied only where it must be

// The array takes the values without a copy and frees them.
template <class T>
py::array_t<T> array_of(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
    auto kept = std::make_unique<std::vector<T>>(std::move(values));
    const T* const first = kept->data();
    const py::capsule owner(kept.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    return py::array_t<T>(std::move(shape), first, owner);
}

template <class T>
void add_planes(py::dict& planes, T&& channels, const Image& image) {
    for (auto& [name, plane] : channels) {
        if constexpr (requires { plane.pixels; })
            planes[py::str(name)] = array_of(std::move(plane.pixels), {image.height, image.width});
        else
            planes[py::str(name)] = array_of(std::move(plane), {image.height, image.width});
    }
}

Dense<float> float_array(const py::handle& value) {
    const py::array array = py::array::ensure(value);
    if (!array || array.dtype().kind() != 'f')
        refuse("a picture is a path, an array of floats in linear light, or a dict of such arrays");
    return Dense<float>(array);
}

// Adds an array as channels, which are strided in it.
void add_channels(Image& image, const Dense<float>& array, const std::vector<std::string>& names) {
    if (image.channels.empty()) {
        image.height = static_cast<int>(array.shape(0));
        image.width = static_cast<int>(array.shape(1));
    }
    if (array.shape(0) != image.height || array.shape(1) != image.width)
        refuse("the arrays of a picture are not of one size");
    for (std::size_t c = 0; c < names.size(); ++c) {
        std::vector<float>& pixels = image.channels[names[c]].pixels;
        pixels.resize(pixel_count(image));
        for (std::size_t i = 0; i < pixels.size(); ++i)
            pixels[i] = array.data()[i * names.size() + c];
    }
}

Image image_of_array(const py::handle& value) {
    const Dense<float> array = float_array(value);
    Image image;
    if (array.ndim() == 2)
        add_channels(image, array, {"Y"});
    else if (array.ndim() == 3 && array.shape(2) == 3)
        add_channels(image, array, {"R", "G", "B"});
    else
        refuse("an array of a picture has the shape (height, width) or (height, width, 3)");
    return image;
}

Image image_of_planes(const py::dict& planes) {
    Image image;
    for (const auto& [name, plane] : planes) {
        const py::array given = py::array::ensure(plane);
        if (given && given.dtype().kind() == 'u') continue;  // counts
        const Dense<float> array = float_array(plane);
        if (array.ndim() != 2) refuse("a channel of a picture has the shape (height, width)");
        add_channels(image, array, {py::cast<std::string>(name)});
    }
    return image;
}

py::array_t<std::uint8_t> palette_array(const VoxFile& file) {
    std::vector<std::uint8_t> rows(4);  // of index 0, which is empty
    for (std::size_t i = 0; i + 1 < file.palette.size(); ++i) {
        const VoxColour& colour = file.palette[i];
        rows.insert(rows.end(), {colour.r, colour.g, colour.b, colour.a});
    }
    return array_of(std::move(rows), {256, 4});
}

void take_palette(const py::handle& value, VoxFile& file) {
    const Dense<std::uint8_t> rows(py::cast<py::array>(value));
    if (rows.ndim() != 2 || rows.shape(0) > 256 || (rows.shape(1) != 3 && rows.shape(1) != 4))
        refuse("palette: an array of at most 256 rows of red, green, blue and perhaps alpha");
    file.has_palette = true;
    file.palette.fill({});
    const auto at = rows.unchecked<2>();
    for (py::ssize_t i = 1; i < rows.shape(0); ++i)
        file.palette[static_cast<std::size_t>(i - 1)] = {at(i, 0), at(i, 1), at(i, 2),
                                                         rows.shape(1) == 4 ? at(i, 3) : std::uint8_t{255}};
}

void take_materials(const py::handle& value, VoxFile& file) {
    for (const auto& [index, attributes] :
         py::cast<std::map<int, std::map<std::string, std::string>>>(value)) {
        if (index < 1 || index > 255) refuse(fmt::format("materials: {} is not from 1 to 255", index));
        file.materials.push_back({.id = index, .attributes = {attributes.begin(), attributes.end()}});
    }
}

// Numbers that are not whole, or do not fit, would lose their meaning.
Dense<std::uint8_t> index_array(const py::handle& value) {
    const py::array array = py::array::ensure(value);
    if (!array || array.ndim() != 3 || array.dtype().kind() != 'u' || array.dtype().itemsize() != 1)
        refuse("voxels: an array [x][y][z] of palette indices as uint8, 0 is empty");
    return Dense<std::uint8_t>(array);
}

std::string text_of(const py::handle& value) {
    return py::cast<std::string>(py::str(value));
}

std::string value_of(const std::string& flag, const py::handle& value) {
    if (!py::isinstance<py::tuple>(value)) return text_of(value);
    std::vector<std::string> parts;
    for (const py::handle& part : value)
        parts.push_back(text_of(part));
    return fmt::format("{}", fmt::join(parts, flag.ends_with("size") ? "x" : ","));
}

void add_words(const std::string& flag, const py::handle& value, std::vector<std::string>& words) {
    const bool is_short = flag.size() == 2;
    if (value.is_none() || value.ptr() == Py_False) return;
    if (value.ptr() == Py_True) {
        words.push_back(flag);
    } else if (py::isinstance<py::dict>(value)) {
        for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value))
            add_words(flag, py::str("{}={}").format(key, item), words);
    } else if (py::isinstance<py::list>(value)) {
        for (const py::handle& item : value)
            add_words(flag, item, words);
    } else if (is_short) {
        words.insert(words.end(), {flag, value_of(flag, value)});
    } else {
        words.push_back(flag + "=" + value_of(flag, value));
    }
}

}  // namespace

bool is_path(const py::handle& value) {
    return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__");
}

std::string path_of(const py::handle& path) {
    return py::cast<std::string>(py::module_::import("os").attr("fspath")(path));
}

std::vector<std::string> words_of(const py::kwargs& flags) {
    std::vector<std::string> words;
    for (const auto& [key, value] : flags) {
        std::string name = py::cast<std::string>(key);
        std::ranges::replace(name, '_', '-');
        add_words((name.size() == 1 ? "-" : "--") + name, value, words);
    }
    return words;
}

py::dict planes_of(Image&& image) {
    py::dict planes;
    add_planes(planes, image.channels, image);
    add_planes(planes, image.words, image);
    return planes;
}

Image image_of(const py::handle& picture) {
    if (is_path(picture)) return read_image(path_of(picture));
    if (py::isinstance<py::dict>(picture)) return image_of_planes(py::reinterpret_borrow<py::dict>(picture));
    return image_of_array(picture);
}

py::dict voxels_of(const VoxFile& file) {
    IndexGrid grid = index_grid_of(file);
    py::dict materials;
    for (const VoxRecord& record : file.materials)
        materials[py::int_(record.id)] =
            std::map<std::string, std::string>(record.attributes.begin(), record.attributes.end());
    py::dict voxels;
    voxels["voxels"] = array_of(std::move(grid.indices), {grid.size.x, grid.size.y, grid.size.z});
    voxels["palette"] = palette_array(file);
    voxels["low"] = py::make_tuple(grid.low.x, grid.low.y, grid.low.z);
    voxels["materials"] = materials;
    return voxels;
}

VoxFile vox_file_of(const py::dict& voxels, const std::string& name) {
    constexpr std::string_view kKeys[] = {"voxels", "palette", "low", "materials"};
    for (const auto& [key, value] : voxels) {
        if (std::ranges::find(kKeys, text_of(key)) == std::end(kKeys))
            refuse(fmt::format("voxels have no '{}': known are {}", text_of(key), fmt::join(kKeys, ", ")));
    }
    if (!voxels.contains("voxels")) refuse("a dict of voxels has an array 'voxels'");
    VoxFile file{.version = 200};
    if (voxels.contains("palette")) take_palette(voxels["palette"], file);
    if (voxels.contains("materials")) take_materials(voxels["materials"], file);
    std::array<int, 3> low{};
    if (voxels.contains("low")) low = py::cast<std::array<int, 3>>(voxels["low"]);
    const Dense<std::uint8_t> indices = index_array(voxels["voxels"]);
    const glm::i64vec3 size(indices.shape(0), indices.shape(1), indices.shape(2));
    if (std::max({size.x, size.y, size.z}) > kVoxMaxTranslation) refuse("voxels: an axis is too long");
    add_grid(file, {low[0], low[1], low[2]}, glm::ivec3(size),
             {indices.data(), static_cast<std::size_t>(indices.size())}, name);
    return file;
}

py::object object_of(const nlohmann::ordered_json& json) {
    return py::module_::import("json").attr("loads")(json_text(json));
}

}  // namespace voxilux
