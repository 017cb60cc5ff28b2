#include "formats/nbt_reader.h"

#include <algorithm>
#include <new>
#include <utility>

#include <zlib.h>

#include "formats/vox_bytes.h"

namespace voxilux {
namespace {

constexpr std::size_t kKeptText = 256;
constexpr int kGzipWindow = 16 + MAX_WBITS;
constexpr std::size_t kUnpackedAtOnce = 2048;

// Bytes of a payload of one length; 0 for others.
std::uint64_t fixed_bytes(NbtType type) {
    switch (type) {
        case NbtType::int8:
            return 1;
        case NbtType::int16:
            return 2;
        case NbtType::int32:
        case NbtType::float32:
            return 4;
        case NbtType::int64:
        case NbtType::float64:
            return 8;
        default:
            return 0;
    }
}

// Bytes of an element of an array; 0 for what is none.
std::uint64_t element_bytes(NbtType type) {
    switch (type) {
        case NbtType::bytes:
            return 1;
        case NbtType::ints:
            return 4;
        case NbtType::longs:
            return 8;
        default:
            return 0;
    }
}

}  // namespace

struct NbtReader::Unpacker {
    z_stream stream{};
    std::array<std::byte, kUnpackedAtOnce> buffer;
    bool is_at_end = false;

    explicit Unpacker(std::span<const std::byte> file) {
        if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw std::bad_alloc();
        stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(file.data()));
        // The length is a 32-bit number. What is beyond it exceeds kMaxNbtBytes in every case but stored
        // blocks.
        stream.avail_in = static_cast<uInt>(std::min<std::size_t>(file.size(), UINT32_MAX));
    }
    ~Unpacker() { inflateEnd(&stream); }
    Unpacker(const Unpacker&) = delete;
    Unpacker& operator=(const Unpacker&) = delete;

    // The next bytes; none at the end.
    std::span<const std::byte> unpack(std::size_t offset) {
        if (is_at_end) return {};
        stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        stream.avail_out = static_cast<uInt>(buffer.size());
        const int status = inflate(&stream, Z_NO_FLUSH);
        if (status != Z_OK && status != Z_STREAM_END)
            throw VoxRefusal(offset, status == Z_BUF_ERROR ? "the gzip stream ends too early"
                                                           : "the gzip stream is damaged");
        is_at_end = status == Z_STREAM_END;
        return std::span(buffer).first(buffer.size() - stream.avail_out);
    }
};

NbtReader::NbtReader(std::span<const std::byte> file) {
    const bool is_gzip = file.size() > 2 && file[0] == std::byte{0x1F} && file[1] == std::byte{0x8B};
    if (is_gzip)
        unpacker_ = std::make_unique<Unpacker>(file);
    else
        ready_ = file;
}

NbtReader::~NbtReader() = default;

bool NbtReader::refill() {
    while (ready_.empty() && unpacker_ != nullptr && !unpacker_->is_at_end)
        ready_ = unpacker_->unpack(offset());
    return !ready_.empty();
}

std::uint8_t NbtReader::u8() {
    if (ready_.empty() && !refill()) throw VoxRefusal(offset(), "the file ends too early");
    if (offset_ == kMaxNbtBytes)
        throw VoxRefusal(offset(), fmt::format("over {} MiB once it is unpacked", kMaxNbtBytes >> 20));
    ++offset_;
    const auto byte = std::to_integer<std::uint8_t>(ready_.front());
    ready_ = ready_.subspan(1);
    return byte;
}

std::uint64_t NbtReader::number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i)
        value = value << 8 | u8();
    return value;
}

void NbtReader::drop(std::uint64_t bytes) {
    while (bytes > 0) {
        (void)u8();
        const std::uint64_t more = std::min<std::uint64_t>(bytes - 1, ready_.size());
        const std::uint64_t allowed = std::min(more, kMaxNbtBytes - offset_);
        ready_ = ready_.subspan(static_cast<std::size_t>(allowed));
        offset_ += allowed;
        bytes -= 1 + allowed;
    }
}

NbtType NbtReader::type() {
    const std::size_t start = offset();
    const std::uint8_t number = u8();
    if (number > static_cast<std::uint8_t>(NbtType::longs))
        throw VoxRefusal(start, fmt::format("there is no tag of type {}", number));
    return static_cast<NbtType>(number);
}

std::string NbtReader::text() {
    const std::size_t length = u16(), kept = std::min(length, kKeptText);
    std::string text;
    for (std::size_t i = 0; i < kept; ++i)
        text += static_cast<char>(u8());
    drop(length - kept);
    return text;
}

NbtTag NbtReader::next_tag() {
    NbtTag tag{.type = type()};
    if (tag.type != NbtType::end) tag.name = text();
    return tag;
}

void NbtReader::open_root() {
    if (next_tag().type != NbtType::compound)
        throw VoxRefusal(0, "not a file of Minecraft: it does not begin with a compound tag");
}

std::uint32_t NbtReader::count() {
    const std::size_t start = offset();
    const std::int32_t count = i32();
    if (count < 0) throw VoxRefusal(start, fmt::format("an array has {} elements", count));
    return static_cast<std::uint32_t>(count);
}

std::pair<NbtType, std::uint32_t> NbtReader::list() {
    const NbtType element = type();
    return {element, static_cast<std::uint32_t>(std::max(i32(), 0))};
}

void NbtReader::expect(const NbtTag& tag, NbtType type) const {
    if (tag.type != type)
        throw VoxRefusal(offset(), fmt::format("the tag {} is of type {}, not {}", quoted_name(tag.name),
                                               static_cast<int>(tag.type), static_cast<int>(type)));
}

void NbtReader::skip(NbtType type, int depth) {
    if (depth > kMaxNbtDepth)
        throw VoxRefusal(offset(), fmt::format("tags are nested over {} deep", kMaxNbtDepth));
    if (type == NbtType::text) {
        drop(u16());
    } else if (type == NbtType::compound) {
        for (NbtTag tag = next_tag(); tag.type != NbtType::end; tag = next_tag())
            skip(tag.type, depth + 1);
    } else if (type == NbtType::list) {
        const auto [element, count] = list();
        if (fixed_bytes(element) > 0 || element == NbtType::end) {
            drop(count * fixed_bytes(element));
        } else {
            for (std::uint32_t i = 0; i < count; ++i)
                skip(element, depth + 1);
        }
    } else {
        drop(element_bytes(type) > 0 ? count() * element_bytes(type) : fixed_bytes(type));
    }
}

std::uint64_t NbtReader::finish() {
    std::uint64_t rest = 0;
    while (refill()) {
        rest += ready_.size();
        if (rest > kMaxNbtBytes) throw VoxRefusal(offset(), "too much follows after the last tag");
        ready_ = {};
    }
    return rest;
}

}  // namespace voxilux
