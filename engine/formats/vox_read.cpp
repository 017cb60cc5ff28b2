#include "formats/vox_read.h"

#include <algorithm>

#include "base/file.h"
#include "base/printable.h"
#include "formats/vox_bytes.h"
#include "formats/vox_chunks.h"
#include "formats/vox_oddities.h"
#include "scene/vox_graph.h"

// The reader: one pass over the chunks, each parsed inside its own byte range. Nothing is allocated for a
// number that the file merely claims: a count is first compared with the bytes that are left.
namespace voxilux {
namespace {

std::string read_id(VoxBytes& in) {
    const auto raw = in.bytes(4, "id");
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

void read_chunk(VoxReading& reading, std::span<const std::byte> bytes, VoxBytes& in) {
    const std::size_t start = in.offset();
    const std::string id = read_id(in);
    const std::uint32_t content = in.u32("content size");
    const std::uint32_t children = in.u32("children size");
    if (content > in.left() || children > in.left() - content) {
        throw VoxRefusal(start, fmt::format("{} has {} + {} bytes where MAIN has {} left", quoted_name(id),
                                            content, children, in.left()));
    }
    VoxBytes chunk(bytes, in.offset(), in.offset() + content, id);
    const std::size_t nodes = reading.file.nodes.size();
    const bool is_known = read_vox_chunk(reading, chunk);
    if (reading.file.nodes.size() > nodes) reading.node_offsets.push_back(start);
    if (chunk.left() > 0)
        reading.warn(chunk.offset(), fmt::format("{} has {} spare bytes", quoted_name(id), chunk.left()));
    [[maybe_unused]] const auto skipped = in.bytes(content, "content");
    const auto below = in.bytes(children, "children");
    if (!is_known) {
        reading.file.unknown.back().children.assign(below.begin(), below.end());
    } else if (children > 0) {
        reading.warn(
            start, fmt::format("{} has {} bytes of children, which are ignored", quoted_name(id), children));
    }
}

// Faults of the graph as a whole, at the offset of the node that shows them.
void check_graph(VoxReading& reading) {
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

void read_all(VoxReading& reading, std::span<const std::byte> bytes) {
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
    note_oddities(reading);
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

Result<VoxFile> read_vox(std::span<const std::byte> bytes) {
    VoxReading reading;
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
