#include "formats/vox_objects.h"

#include <algorithm>
#include <array>

#include "formats/vox_bytes.h"
#include "scene/vox_graph.h"

namespace voxilux {
namespace {

constexpr std::size_t kTextPairBytes = 8;  // of two empty texts

// The chunk as a dictionary; empty when it is not one.
VoxDict dict_of(const VoxUnknownChunk& chunk) try {
    VoxBytes in(chunk.content, 0, chunk.content.size(), {chunk.id.data(), chunk.id.size()});
    const std::uint32_t count = in.count(kTextPairBytes, "attributes");
    VoxDict dict;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string key = in.string();
        dict.emplace_back(std::move(key), in.string());
    }
    return dict;
} catch (const VoxRefusal&) {
    return {};
}

// The name in rOBJ of an older key, and the type of the object that it belongs to; an empty type means that
// of the chunk itself.
struct OldKey {
    std::string_view chunk;
    std::string_view key;
    std::string_view type;
    std::string_view name;
};

constexpr OldKey kOldKeys[] = {
    {"rLIT", "_I", "", "_i"},
    {"rLIT", "_color", "", "_k"},
    {"rLIT", "_angle", "", "_angle"},
    {"rLIT", "_area", "", "_area"},
    {"rAIR", "_density", "", "_d"},
    {"rAIR", "_color", "", "_k"},
    {"rAIR", "_scatter", "", "_g"},
    {"rLEN", "_fov", "_lens", "_fov"},
    {"rLEN", "_dof", "_lens", "_aperture"},
    {"rLEN", "_exp", "_film", "_stops"},
    {"rLEN", "_vig", "_film", "_vig"},
    {"rLEN", "_gam", "_film", "_gam"},
    {"POST", "_mix", "", "_mix"},
    {"POST", "_scale", "", "_scale"},
    {"POST", "_threshold", "", "_threshold"},
    {"rDIS", "_gd_color", "_ground", "_color"},
    {"rDIS", "_bg_color", "_bg", "_color"},
    {"rDIS", "_edge_color", "_edge", "_color"},
};

// "inf" and "fog" are "_inf" and "_fog_uni" today.
std::string type_today(const VoxDict& dict) {
    const std::string* type = find_value(dict, "_type");
    if (type == nullptr) return {};
    return *type == "fog" ? "_fog_uni" : "_" + *type;
}

void add_old(std::string_view chunk, const VoxDict& dict, std::vector<VoxDict>& objects) {
    const std::size_t first = objects.size();
    for (const OldKey& row : kOldKeys) {
        const std::string* value = row.chunk == chunk ? find_value(dict, row.key) : nullptr;
        if (value == nullptr) continue;
        const std::string type = row.type.empty() ? type_today(dict) : std::string(row.type);
        const auto own = std::find_if(objects.begin() + static_cast<std::ptrdiff_t>(first), objects.end(),
                                      [&](const VoxDict& object) { return object.front().second == type; });
        const std::size_t at = static_cast<std::size_t>(own - objects.begin());
        if (own == objects.end()) objects.push_back({{"_type", type}});
        objects[at].emplace_back(row.name, *value);
    }
}

}  // namespace

std::vector<VoxDict> render_objects(const VoxFile& file) {
    const auto count = static_cast<std::ptrdiff_t>(std::min(file.objects.size(), kVoxMaxObjects));
    std::vector<VoxDict> objects(file.objects.begin(), file.objects.begin() + count);
    for (const VoxUnknownChunk& chunk : file.unknown) {
        if (objects.size() >= kVoxMaxObjects) break;
        add_old({chunk.id.data(), chunk.id.size()}, dict_of(chunk), objects);
    }
    objects.resize(std::min(objects.size(), kVoxMaxObjects));
    return objects;
}

}  // namespace voxilux
