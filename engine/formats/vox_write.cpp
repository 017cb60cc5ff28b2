#include "formats/vox_write.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>

#include "base/checked_cast.h"
#include "base/error.h"
#include "base/file.h"

namespace voxilux {
namespace {

class Writer {
  public:
    void u8(std::uint8_t value) { bytes_.push_back(std::byte{value}); }
    void u32(std::uint32_t value) {
        for (unsigned shift = 0; shift < 32; shift += 8)
            u8(static_cast<std::uint8_t>(value >> shift & 0xFF));
    }
    void i32(std::int32_t value) { u32(std::bit_cast<std::uint32_t>(value)); }
    void f32(float value) { u32(std::bit_cast<std::uint32_t>(value)); }
    void size(std::size_t value) { u32(size_field(value)); }
    void id(std::string_view four) {
        for (const char c : four)
            u8(static_cast<std::uint8_t>(c));
    }
    void text(std::string_view value) {
        size(value.size());
        id(value);
    }
    void raw(std::span<const std::byte> value) { bytes_.insert(bytes_.end(), value.begin(), value.end()); }
    void dict(const VoxDict& value) {
        size(value.size());
        for (const auto& [key, entry] : value) {
            text(key);
            text(entry);
        }
    }

    // Begins a chunk without children; returns what end_chunk needs.
    [[nodiscard]] std::size_t begin_chunk(std::string_view four) {
        id(four);
        const std::size_t field = bytes_.size();
        u32(0);
        u32(0);
        return field;
    }
    void end_chunk(std::size_t field) { set_u32(field, bytes_.size() - field - 8); }

    void set_u32(std::size_t at, std::size_t value) {
        const std::uint32_t checked = size_field(value);
        for (std::size_t i = 0; i < 4; ++i)
            bytes_[at + i] = std::byte(checked >> (8 * i) & 0xFF);
    }

    [[nodiscard]] std::size_t length() const { return bytes_.size(); }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    static std::uint32_t size_field(std::size_t value) {
        if (!std::in_range<std::uint32_t>(value))
            throw Error(ExitCode::cannot_write, "the scene is too large for one .vox file: over 4 GiB");
        return static_cast<std::uint32_t>(value);
    }

    std::vector<std::byte> bytes_;
};

template <class Body>
void write_chunk(Writer& out, std::string_view id, const Body& body) {
    const std::size_t chunk = out.begin_chunk(id);
    body();
    out.end_chunk(chunk);
}

void write_model(Writer& out, const VoxModel& model) {
    write_chunk(out, "SIZE", [&] {
        for (int axis = 0; axis < 3; ++axis)
            out.i32(model.size[axis]);
    });
    write_chunk(out, "XYZI", [&] {
        out.size(model.voxels.size());
        for (const VoxVoxel& v : model.voxels) {
            for (const std::uint8_t byte : {v.x, v.y, v.z, v.index})
                out.u8(byte);
        }
    });
}

void write_node(Writer& out, const VoxTransform& node) {
    write_chunk(out, "nTRN", [&] {
        out.i32(node.id);
        out.dict(node.attributes);
        out.i32(node.child);
        out.i32(node.reserved);
        out.i32(node.layer);
        out.size(node.frames.size());
        for (const VoxDict& frame : node.frames)
            out.dict(frame);
    });
}

void write_node(Writer& out, const VoxGroup& node) {
    write_chunk(out, "nGRP", [&] {
        out.i32(node.id);
        out.dict(node.attributes);
        out.size(node.children.size());
        for (const std::int32_t child : node.children)
            out.i32(child);
    });
}

void write_node(Writer& out, const VoxShape& node) {
    write_chunk(out, "nSHP", [&] {
        out.i32(node.id);
        out.dict(node.attributes);
        out.size(node.models.size());
        for (const VoxShapeModel& model : node.models) {
            out.i32(model.model);
            out.dict(model.attributes);
        }
    });
}

void write_palette(Writer& out, const VoxFile& file) {
    if (file.has_palette || file.palette != default_vox_palette()) {
        write_chunk(out, "RGBA", [&] {
            for (const VoxColour& c : file.palette) {
                for (const std::uint8_t byte : {c.r, c.g, c.b, c.a})
                    out.u8(byte);
            }
        });
    }
    if (file.imap) {
        write_chunk(out, "IMAP", [&] {
            for (const std::uint8_t index : *file.imap)
                out.u8(index);
        });
    }
}

void write_records(Writer& out, std::string_view id, const std::vector<VoxRecord>& records) {
    for (const VoxRecord& record : records) {
        write_chunk(out, id, [&] {
            out.i32(record.id);
            out.dict(record.attributes);
        });
    }
}

void write_old_materials(Writer& out, const VoxFile& file) {
    for (const VoxOldMaterial& material : file.old_materials) {
        write_chunk(out, "MATT", [&] {
            out.i32(material.id);
            out.i32(material.type);
            out.f32(material.weight);
            out.u32(material.present);
            for (const float value : material.values)
                out.f32(value);
        });
    }
}

void write_rest(Writer& out, const VoxFile& file) {
    for (const VoxDict& object : file.objects)
        write_chunk(out, "rOBJ", [&] { out.dict(object); });
    write_records(out, "rCAM", file.cameras);
    if (file.notes) {
        write_chunk(out, "NOTE", [&] {
            out.size(file.notes->size());
            for (const std::string& note : *file.notes)
                out.text(note);
        });
    }
    if (file.meta) write_chunk(out, "META", [&] { out.dict(*file.meta); });
    for (const VoxUnknownChunk& chunk : file.unknown) {
        out.id({chunk.id.data(), chunk.id.size()});
        out.size(chunk.content.size());
        out.size(chunk.children.size());
        out.raw(chunk.content);
        out.raw(chunk.children);
    }
}

// All chunks that follow the models.
void write_after_models(Writer& out, const VoxFile& file) {
    for (const VoxNode& node : file.nodes)
        std::visit([&](const auto& n) { write_node(out, n); }, node);
    for (const VoxLayer& layer : file.layers) {
        write_chunk(out, "LAYR", [&] {
            out.i32(layer.id);
            out.dict(layer.attributes);
            out.i32(layer.reserved);
        });
    }
    write_palette(out, file);
    write_records(out, "MATL", file.materials);
    write_old_materials(out, file);
    write_rest(out, file);
}

// SIZE, and XYZI up to its voxels.
void write_model_head(Writer& out, const VoxModelHead& model) {
    write_chunk(out, "SIZE", [&] {
        for (int axis = 0; axis < 3; ++axis)
            out.i32(model.size[axis]);
    });
    out.id("XYZI");
    out.size(4 + 4 * model.voxels);
    out.u32(0);
    out.size(model.voxels);
}

void put(std::ofstream& stream, std::span<const std::byte> bytes) {
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream) throw std::runtime_error(std::strerror(errno != 0 ? errno : EIO));
}

std::vector<std::byte> bytes_of(const VoxModelHead& model) {
    Writer out;
    write_model_head(out, model);
    return out.take();
}

void put_model(std::ofstream& stream, const VoxModelHead& head, const std::vector<VoxVoxel>& voxels) {
    static_assert(sizeof(VoxVoxel) == 4, "stored as the file has it");
    VX_ASSERT_EQ(voxels.size(), head.voxels);
    put(stream, bytes_of(head));
    put(stream, std::as_bytes(std::span(voxels)));
}

}  // namespace

std::uint64_t write_vox_models(const std::filesystem::path& path, std::span<const VoxModelHead> models,
                               const std::function<std::vector<VoxVoxel>(std::size_t)>& voxels_of,
                               const VoxFile& rest) {
    Writer tail;
    write_after_models(tail, rest);
    std::size_t children = tail.length();
    for (const VoxModelHead& model : models)
        children += bytes_of(model).size() + 4 * model.voxels;
    Writer head;
    head.id("VOX ");
    head.i32(rest.version);
    head.id("MAIN");
    head.u32(0);
    head.size(children);
    const std::uint64_t total = head.length() + children;
    write_file_atomically(path, [&](const std::filesystem::path& temporary) {
        errno = 0;
        std::ofstream stream(temporary, std::ios::binary);
        put(stream, head.take());
        for (std::size_t i = 0; i < models.size(); ++i)
            put_model(stream, models[i], voxels_of(i));
        put(stream, tail.take());
        stream.close();
        if (!stream) throw std::runtime_error(std::strerror(errno != 0 ? errno : EIO));
    });
    return total;
}

std::vector<std::byte> write_vox(const VoxFile& file) {
    Writer out;
    out.id("VOX ");
    out.i32(file.version);
    const std::size_t main = out.begin_chunk("MAIN");
    const std::size_t begin = out.length();
    if (file.pack) write_chunk(out, "PACK", [&] { out.u32(*file.pack); });
    for (const VoxModel& model : file.models)
        write_model(out, model);
    write_after_models(out, file);
    constexpr std::size_t kChildrenField = 4;  // after the field of the content's size
    out.set_u32(main + kChildrenField, out.length() - begin);
    return out.take();
}

}  // namespace voxilux
