// tinygltf is compiled here instead of using the system's library, without its file access and its image
// decoder, neither of which has limits.
#include <fstream>  // needed by its file writer, which is not used

#define TINYGLTF_IMPLEMENTATION
#include "voxelizer/gltf_model.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "base/json.h"
#include "base/printable.h"
#include "voxelizer/load_mesh.h"

namespace voxilux {
namespace {

using nlohmann::json;

std::size_t size_of(const json& form, const char* key) {
    const auto found = form.find(key);
    return found == form.end() ? 0 : found->size();
}

bool is_there(const std::string&, void*) {
    return true;
}

std::string as_it_is(const std::string& path, void*) {
    return path;
}

bool read_numbered(std::vector<unsigned char>* bytes, std::string*, const std::string& path, void* reader) {
    std::size_t index = 0;
    const std::size_t slash = path.rfind('/');
    const std::string number = slash == std::string::npos ? path : path.substr(slash + 1);
    const auto end = std::from_chars(number.data(), number.data() + number.size(), index);
    if (end.ec != std::errc()) return false;
    *bytes = (*static_cast<const BufferReader*>(reader))(index);
    return true;
}

// The bytes stay in their buffer until they are decoded.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char*,
                int, void*) {
    image->as_is = true;
    return true;
}

// Lists that grow would take up to three times the memory of their items.
void reserve_lists(const json& form, tinygltf::Model& model) {
    model.scenes.reserve(size_of(form, "scenes"));
    model.nodes.reserve(size_of(form, "nodes"));
    model.cameras.reserve(size_of(form, "cameras"));
    model.meshes.reserve(size_of(form, "meshes"));
    model.accessors.reserve(size_of(form, "accessors"));
    model.bufferViews.reserve(size_of(form, "bufferViews"));
    model.buffers.reserve(size_of(form, "buffers"));
    model.materials.reserve(size_of(form, "materials"));
    model.textures.reserve(size_of(form, "textures"));
    model.images.reserve(size_of(form, "images"));
    model.samplers.reserve(size_of(form, "samplers"));
}

}  // namespace

tinygltf::Model parse_model(json form, const BufferReader& read_buffer) {
    const std::string text = json_text(form);
    if (text.size() > std::numeric_limits<unsigned>::max()) throw MeshFault("over 4 GiB of JSON");
    tinygltf::Model model;
    reserve_lists(form, model);
    form = nullptr;  // tinygltf makes its own from the text
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(
        {&is_there, &as_it_is, &read_numbered, nullptr, const_cast<BufferReader*>(&read_buffer)});
    parser.SetImageLoader(&keep_image, nullptr);
    std::string error, warning;
    const bool is_read = parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                    static_cast<unsigned>(text.size()), "");
    if (!is_read) throw MeshFault(fmt::format("not valid glTF: {}", printable(error)));
    return model;
}

std::optional<std::size_t> checked_index(int index, std::size_t size, const std::string& owner,
                                         const char* list) {
    if (index == -1) return std::nullopt;
    if (index < 0 || static_cast<std::size_t>(index) >= size)
        throw MeshFault(fmt::format("{} names {}[{}], but there are {}", owner, list, index, size));
    return static_cast<std::size_t>(index);
}

}  // namespace voxilux
