#include "formats/vox_chunks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "scene/vox_graph.h"

namespace voxilux {
namespace {

// Smallest item of each list, in bytes.
constexpr std::size_t kVoxelBytes = 4, kPairBytes = 8, kFrameBytes = 4, kChildBytes = 4, kShapeModelBytes = 8,
                      kNoteBytes = 4;

VoxDict read_dict(VoxBytes& in) {
    const std::uint32_t count = in.count(kPairBytes, "attributes");
    VoxDict dict;
    dict.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string key = in.string();
        std::string value = in.string();
        dict.emplace_back(std::move(key), std::move(value));
    }
    return dict;
}

void read_pack(VoxReading& reading, VoxBytes& in) {
    reading.file.pack = in.u32("number of models");
}

void read_size(VoxReading& reading, VoxBytes& in) {
    const std::size_t start = in.offset();
    if (!reading.size_is_used) reading.warn(start, "the SIZE before has no XYZI");
    glm::ivec3 size{0};
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = in.i32("side");
        if (size[axis] < 1 || size[axis] > kVoxMaxSide) {
            throw VoxRefusal(start, fmt::format("SIZE has a side of {}, which must be from 1 to {}",
                                                size[axis], kVoxMaxSide));
        }
    }
    reading.size = size;
    reading.size_is_used = false;
}

void read_voxels(VoxReading& reading, VoxBytes& in) {
    if (!reading.size) throw VoxRefusal(in.offset(), "XYZI without a SIZE before it");
    reading.size_is_used = true;
    VoxModel model{.size = *reading.size};
    const std::uint32_t count = in.count(kVoxelBytes, "voxels");
    const auto raw = in.bytes(std::size_t{count} * kVoxelBytes, "voxels");
    static_assert(sizeof(VoxVoxel) == kVoxelBytes && std::is_trivially_copyable_v<VoxVoxel>);
    model.voxels.resize(count);
    if (count > 0) std::memcpy(model.voxels.data(), raw.data(), raw.size());
    reading.model_places.push_back({in.offset(), reading.file.warnings.size() + reading.dropped_warnings});
    reading.file.models.push_back(std::move(model));
}

void read_palette(VoxReading& reading, VoxBytes& in) {
    const std::size_t full = 4 * reading.file.palette.size();
    if (in.left() < full)
        reading.warn(in.offset(),
                     fmt::format("RGBA has {} bytes, not {}: the rest is black", in.left(), full));
    reading.file.palette.fill({});
    reading.file.has_palette = true;
    const auto raw = in.bytes(std::min(in.left(), full), "colours");
    for (std::size_t i = 0; i < raw.size(); ++i) {
        VoxColour& colour = reading.file.palette[i / 4];
        std::uint8_t* const channels[4] = {&colour.r, &colour.g, &colour.b, &colour.a};
        *channels[i % 4] = std::to_integer<std::uint8_t>(raw[i]);
    }
}

void read_imap(VoxReading& reading, VoxBytes& in) {
    if (in.left() < 256)
        return reading.warn(in.offset(), fmt::format("IMAP has {} bytes, not 256: ignored", in.left()));
    std::array<std::uint8_t, 256> imap{};
    const auto raw = in.bytes(imap.size(), "indices");
    std::transform(raw.begin(), raw.end(), imap.begin(),
                   [](std::byte b) { return std::to_integer<std::uint8_t>(b); });
    reading.file.imap = imap;
}

void read_transform(VoxReading& reading, VoxBytes& in) {
    VoxTransform node{.id = in.i32("node id")};
    node.attributes = read_dict(in);
    node.child = in.i32("child id");
    node.reserved = in.i32("reserved id");
    node.layer = in.i32("layer id");
    const std::uint32_t frames = in.count(kFrameBytes, "frames");
    node.frames.reserve(frames);
    for (std::uint32_t i = 0; i < frames; ++i) {
        const std::size_t start = in.offset();
        node.frames.push_back(read_dict(in));
        const auto key = parse_key(node.frames.back());
        if (!key) throw VoxRefusal(start, fmt::format("node {}: {}", node.id, key.reason()));
    }
    reading.file.nodes.emplace_back(std::move(node));
}

void read_group(VoxReading& reading, VoxBytes& in) {
    VoxGroup node{.id = in.i32("node id")};
    node.attributes = read_dict(in);
    const std::uint32_t children = in.count(kChildBytes, "children");
    node.children.reserve(children);
    for (std::uint32_t i = 0; i < children; ++i)
        node.children.push_back(in.i32("child id"));
    reading.file.nodes.emplace_back(std::move(node));
}

void read_shape(VoxReading& reading, VoxBytes& in) {
    VoxShape node{.id = in.i32("node id")};
    node.attributes = read_dict(in);
    const std::uint32_t models = in.count(kShapeModelBytes, "models");
    node.models.reserve(models);
    for (std::uint32_t i = 0; i < models; ++i) {
        const std::size_t start = in.offset();
        VoxShapeModel model{.model = in.i32("model id")};
        model.attributes = read_dict(in);
        const auto frame = parse_frame(model.attributes);
        if (!frame) throw VoxRefusal(start, fmt::format("node {}: {}", node.id, frame.reason()));
        node.models.push_back(std::move(model));
    }
    reading.file.nodes.emplace_back(std::move(node));
}

void read_layer(VoxReading& reading, VoxBytes& in) {
    VoxLayer layer{.id = in.i32("layer id")};
    layer.attributes = read_dict(in);
    layer.reserved = in.left() >= 4 ? in.i32("reserved id") : -1;
    reading.file.layers.push_back(std::move(layer));
}

VoxRecord read_record(VoxBytes& in) {
    VoxRecord record{.id = in.i32("id")};
    record.attributes = read_dict(in);
    return record;
}

// A float. One that is not finite would spoil what is computed from it, and becomes 0.
float read_finite(VoxReading& reading, VoxBytes& in, std::string_view name) {
    const std::size_t start = in.offset();
    const float value = in.f32(name);
    if (std::isfinite(value)) return value;
    reading.warn(start, fmt::format("{}: its {} is not finite and is taken as 0", in.what(), name));
    return 0.0f;
}

void read_old_material(VoxReading& reading, VoxBytes& in) {
    constexpr std::uint32_t kValueBits = 0x7F;  // bit 7 has no value
    VoxOldMaterial material{.id = in.i32("id"), .type = in.i32("type")};
    material.weight = read_finite(reading, in, "weight");
    material.present = in.u32("property bits");
    for (std::uint32_t bits = material.present & kValueBits; bits != 0; bits &= bits - 1) {
        if (in.left() < 4) {
            reading.warn(in.offset(),
                         fmt::format("MATT {} has fewer values than property bits", material.id));
            break;
        }
        material.values.push_back(read_finite(reading, in, "property"));
    }
    reading.file.old_materials.push_back(std::move(material));
}

void read_notes(VoxReading& reading, VoxBytes& in) {
    std::vector<std::string> notes;
    const std::uint32_t count = in.count(kNoteBytes, "notes");
    notes.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i)
        notes.push_back(in.string());
    reading.file.notes = std::move(notes);
}

void read_unknown(VoxReading& reading, VoxBytes& in) {
    VoxUnknownChunk chunk;
    std::copy_n(in.what().begin(), chunk.id.size(), chunk.id.begin());
    const auto content = in.bytes(in.left(), "content");
    chunk.content.assign(content.begin(), content.end());
    reading.file.unknown.push_back(std::move(chunk));
}

using ReadChunk = void (*)(VoxReading&, VoxBytes&);

struct ChunkRule {
    std::string_view id;
    ReadChunk read;
};

constexpr ChunkRule kRules[] = {
    {"PACK", read_pack},
    {"SIZE", read_size},
    {"XYZI", read_voxels},
    {"RGBA", read_palette},
    {"IMAP", read_imap},
    {"nTRN", read_transform},
    {"nGRP", read_group},
    {"nSHP", read_shape},
    {"LAYR", read_layer},
    {"MATL", [](VoxReading& r, VoxBytes& in) { r.file.materials.push_back(read_record(in)); }},
    {"MATT", read_old_material},
    {"rCAM", [](VoxReading& r, VoxBytes& in) { r.file.cameras.push_back(read_record(in)); }},
    {"rOBJ", [](VoxReading& r, VoxBytes& in) { r.file.objects.push_back(read_dict(in)); }},
    {"NOTE", read_notes},
    {"META", [](VoxReading& r, VoxBytes& in) { r.file.meta = read_dict(in); }},
};

}  // namespace

void VoxReading::warn(std::size_t offset, std::string_view what) {
    const bool is_kept = file.warnings.size() < kVoxMaxWarnings;
    keep_warning(is_kept ? fmt::format("at byte {}: {}", offset, what) : std::string());
}

void VoxReading::keep_warning(std::string warning) {
    if (file.warnings.size() < kVoxMaxWarnings) {
        file.warnings.push_back(std::move(warning));
    } else {
        ++dropped_warnings;
    }
}

bool read_vox_chunk(VoxReading& reading, VoxBytes& in) {
    const auto rule = std::find_if(std::begin(kRules), std::end(kRules),
                                   [&](const ChunkRule& r) { return r.id == in.what(); });
    const bool is_known = rule != std::end(kRules);
    (is_known ? rule->read : read_unknown)(reading, in);
    return is_known;
}

}  // namespace voxilux
