#include "scene/vox_file.h"

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "scene/vox_bytes.h"
#include "scene/vox_cells.h"
#include "scene/vox_graph.h"

// The reader: one pass over the chunks, each parsed inside its own byte range. Nothing is allocated for a
// number that the file merely claims: a count is first compared with the bytes that are left.
namespace voxilux {
namespace {

constexpr std::size_t kHeaderBytes = 12;  // of a chunk: id, bytes of content, bytes of children
// Smallest item of each list, in bytes.
constexpr std::size_t kVoxelBytes = 4, kPairBytes = 8, kFrameBytes = 4, kChildBytes = 4, kShapeModelBytes = 8,
                      kNoteBytes = 4;

struct Reading {
    VoxFile file;
    std::optional<glm::ivec3> size;         // of the SIZE chunk before
    bool size_is_used = true;               // an XYZI chunk has followed it
    std::vector<std::size_t> node_offsets;  // parallel to file.nodes
    std::size_t dropped_warnings = 0;
    VoxCells cells;

    void warn(std::size_t offset, std::string_view what) {
        if (file.warnings.size() < kVoxMaxWarnings) {
            file.warnings.push_back(fmt::format("at byte {}: {}", offset, what));
        } else {
            ++dropped_warnings;
        }
    }
};

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

void read_pack(Reading& reading, VoxBytes& in) {
    reading.file.pack = in.u32("number of models");
}

void read_size(Reading& reading, VoxBytes& in) {
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

void read_voxels(Reading& reading, VoxBytes& in) {
    if (!reading.size) throw VoxRefusal(in.offset(), "XYZI without a SIZE before it");
    reading.size_is_used = true;
    VoxModel model{.size = *reading.size};
    const std::uint32_t count = in.count(kVoxelBytes, "voxels");
    const auto raw = in.bytes(std::size_t{count} * kVoxelBytes, "voxels");
    model.voxels.reserve(count);
    for (std::size_t i = 0; i < raw.size(); i += kVoxelBytes) {
        const auto byte = [&](std::size_t k) { return std::to_integer<std::uint8_t>(raw[i + k]); };
        model.voxels.push_back({byte(0), byte(1), byte(2), byte(3)});
    }
    count_oddities(model, reading.cells);
    const std::size_t id = reading.file.models.size();
    if (model.out_of_size > 0)
        reading.warn(in.offset(),
                     fmt::format("model {}: {} voxels outside its size are ignored", id, model.out_of_size));
    if (model.duplicates > 0)
        reading.warn(in.offset(),
                     fmt::format("model {}: {} voxels replace earlier ones", id, model.duplicates));
    if (model.index0 > 0)
        reading.warn(in.offset(),
                     fmt::format("model {}: {} voxels have the empty index 0", id, model.index0));
    reading.file.models.push_back(std::move(model));
}

void read_palette(Reading& reading, VoxBytes& in) {
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

void read_imap(Reading& reading, VoxBytes& in) {
    if (in.left() < 256)
        return reading.warn(in.offset(), fmt::format("IMAP has {} bytes, not 256: ignored", in.left()));
    std::array<std::uint8_t, 256> imap{};
    const auto raw = in.bytes(imap.size(), "indices");
    std::transform(raw.begin(), raw.end(), imap.begin(),
                   [](std::byte b) { return std::to_integer<std::uint8_t>(b); });
    reading.file.imap = imap;
}

void read_transform(Reading& reading, VoxBytes& in) {
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

void read_group(Reading& reading, VoxBytes& in) {
    VoxGroup node{.id = in.i32("node id")};
    node.attributes = read_dict(in);
    const std::uint32_t children = in.count(kChildBytes, "children");
    node.children.reserve(children);
    for (std::uint32_t i = 0; i < children; ++i)
        node.children.push_back(in.i32("child id"));
    reading.file.nodes.emplace_back(std::move(node));
}

void read_shape(Reading& reading, VoxBytes& in) {
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

void read_layer(Reading& reading, VoxBytes& in) {
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

// A float that must not poison what is computed from it.
float read_finite(Reading& reading, VoxBytes& in, std::string_view name) {
    const std::size_t start = in.offset();
    const float value = in.f32(name);
    if (std::isfinite(value)) return value;
    reading.warn(start, fmt::format("{}: its {} is not finite and is taken as 0", in.what(), name));
    return 0.0f;
}

void read_old_material(Reading& reading, VoxBytes& in) {
    constexpr std::uint32_t kValueBits = 0x7F;  // bit 7 has no value
    VoxOldMaterial material{.id = in.i32("id"), .type = in.i32("type")};
    material.weight = read_finite(reading, in, "weight");
    material.present = in.u32("property bits");
    for (std::uint32_t bits = material.present & kValueBits; bits != 0; bits &= bits - 1)
        material.values.push_back(read_finite(reading, in, "property"));
    reading.file.old_materials.push_back(std::move(material));
}

void read_notes(Reading& reading, VoxBytes& in) {
    std::vector<std::string> notes;
    const std::uint32_t count = in.count(kNoteBytes, "notes");
    notes.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i)
        notes.push_back(in.string());
    reading.file.notes = std::move(notes);
}

void read_unknown(Reading& reading, VoxBytes& in) {
    VoxUnknownChunk chunk;
    std::copy_n(in.what().begin(), chunk.id.size(), chunk.id.begin());
    const auto content = in.bytes(in.left(), "content");
    chunk.content.assign(content.begin(), content.end());
    reading.file.unknown.push_back(std::move(chunk));
}

using ReadChunk = void (*)(Reading&, VoxBytes&);

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
    {"MATL", [](Reading& r, VoxBytes& in) { r.file.materials.push_back(read_record(in)); }},
    {"MATT", read_old_material},
    {"rCAM", [](Reading& r, VoxBytes& in) { r.file.cameras.push_back(read_record(in)); }},
    {"rOBJ", [](Reading& r, VoxBytes& in) { r.file.objects.push_back(read_dict(in)); }},
    {"NOTE", read_notes},
    {"META", [](Reading& r, VoxBytes& in) { r.file.meta = read_dict(in); }},
};

std::string read_id(VoxBytes& in) {
    const auto raw = in.bytes(4, "id");
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

void read_chunk(Reading& reading, std::span<const std::byte> bytes, VoxBytes& in) {
    const std::size_t start = in.offset();
    const std::string id = read_id(in);
    const std::uint32_t content = in.u32("content size");
    const std::uint32_t children = in.u32("children size");
    if (content > in.left() || children > in.left() - content) {
        throw VoxRefusal(start, fmt::format("{} has {} + {} bytes where MAIN has {} left", excerpt(id),
                                            content, children, in.left()));
    }
    VoxBytes chunk(bytes, in.offset(), in.offset() + content, id);
    const auto rule =
        std::find_if(std::begin(kRules), std::end(kRules), [&](const ChunkRule& r) { return r.id == id; });
    const bool is_known = rule != std::end(kRules);
    const std::size_t nodes = reading.file.nodes.size();
    (is_known ? rule->read : read_unknown)(reading, chunk);
    if (reading.file.nodes.size() > nodes) reading.node_offsets.push_back(start);
    if (chunk.left() > 0)
        reading.warn(chunk.offset(), fmt::format("{} has {} spare bytes", excerpt(id), chunk.left()));
    [[maybe_unused]] const auto skipped = in.bytes(content, "content");
    const auto below = in.bytes(children, "children");
    if (!is_known) {
        reading.file.unknown.back().children.assign(below.begin(), below.end());
    } else if (children > 0) {
        reading.warn(start,
                     fmt::format("{} has {} bytes of children, which are ignored", excerpt(id), children));
    }
}

// Faults of the graph as a whole, at the offset of the node that shows them.
void check_graph(Reading& reading) {
    const VoxFile& file = reading.file;
    if (!has_graph(file)) return;
    auto built = build_graph(file);
    if (const auto* fault = std::get_if<VoxGraphFault>(&built))
        throw VoxRefusal(reading.node_offsets[fault->node], fault->rule);
    const auto& graph = std::get<VoxGraph>(built);
    if (graph.order.empty()) reading.warn(reading.node_offsets.front(), "no node 0: nothing is placed");
    for (const std::uint32_t position : graph.order) {
        const VoxNode& node = file.nodes[position];
        const std::size_t offset = reading.node_offsets[position];
        for (const std::int32_t child : children_of(node)) {
            if (graph.position_of(child) == kVoxNoNode)
                reading.warn(offset,
                             fmt::format("node {} names node {}, which is absent", id_of(node), child));
        }
        const auto* shape = std::get_if<VoxShape>(&node);
        if (shape == nullptr) continue;
        for (const VoxShapeModel& m : shape->models) {
            if (m.model < 0 || static_cast<std::size_t>(m.model) >= file.models.size())
                reading.warn(offset, fmt::format("node {} shows model {} of {}: skipped", shape->id, m.model,
                                                 file.models.size()));
        }
    }
}

void read_all(Reading& reading, std::span<const std::byte> bytes) {
    VoxBytes header(bytes, 0, bytes.size(), "the file");
    if (read_id(header) != "VOX ") throw VoxRefusal(0, "not a .vox file: it does not begin with 'VOX '");
    reading.file.version = header.i32("version");
    if (reading.file.version != 150 && reading.file.version != 200)
        reading.warn(4, fmt::format("version {} is not 150 or 200", reading.file.version));
    const std::size_t main = header.offset();
    if (read_id(header) != "MAIN") throw VoxRefusal(main, "the first chunk is not MAIN");
    const std::uint32_t content = header.u32("content size");
    const std::uint32_t children = header.u32("children size");
    if (content > header.left() || children > header.left() - content) {
        throw VoxRefusal(main, fmt::format("MAIN says {} + {} bytes but the file has {}: it is cut off",
                                           content, children, header.left()));
    }
    [[maybe_unused]] const auto skipped = header.bytes(content, "content");
    VoxBytes in(bytes, header.offset(), header.offset() + children, "MAIN");
    while (in.left() > 0)
        read_chunk(reading, bytes, in);
    if (in.offset() < bytes.size())
        reading.warn(in.offset(), fmt::format("{} bytes after MAIN are ignored", bytes.size() - in.offset()));
    if (reading.file.models.empty()) reading.warn(in.offset(), "no models");
    if (!reading.size_is_used) reading.warn(in.offset(), "the last SIZE has no XYZI");
    if (reading.file.pack && *reading.file.pack != reading.file.models.size()) {
        reading.warn(in.offset(), fmt::format("PACK says {} models, the file has {}", *reading.file.pack,
                                              reading.file.models.size()));
    }
    check_graph(reading);
}

}  // namespace

const std::string* find_value(const VoxDict& dict, std::string_view key) {
    const auto found =
        std::find_if(dict.rbegin(), dict.rend(), [&](const auto& pair) { return pair.first == key; });
    return found == dict.rend() ? nullptr : &found->second;
}

Result<VoxFile> read_vox(std::span<const std::byte> bytes) {
    Reading reading;
    try {
        read_all(reading, bytes);
    } catch (const VoxRefusal& refusal) {
        return Failure{refusal.what()};
    }
    if (reading.dropped_warnings > 0)
        reading.file.warnings.push_back(fmt::format("and {} more warnings", reading.dropped_warnings));
    return std::move(reading.file);
}

VoxFile load_vox(const std::filesystem::path& path) {
    auto file = read_vox(read_file(path));
    if (!file) throw Error(ExitCode::input_refused, fmt::format("{}: {}", path.string(), file.reason()));
    return std::move(file).value();
}

}  // namespace voxilux
