// The reading half of exr.h. Files are hostile until proven otherwise: the header is checked against the caps
// before any plane is allocated, and every exception of the library becomes one line.

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "base/error.h"
#include "base/file.h"
#include "base/printable.h"
#include "base/read_or_refuse.h"
#include "formats/exr.h"

namespace voxilux {
namespace {

constexpr std::string_view kExrKind = "a readable EXR";

class MemoryStream : public Imf::IStream {
  public:
    MemoryStream(std::span<const std::byte> bytes, const std::string& name)
        : Imf::IStream(name.c_str()), bytes_(bytes) {}

    bool read(char c[], int n) override {
        const std::size_t wanted = n < 0 ? 0 : static_cast<std::size_t>(n);
        if (at_ > bytes_.size() || wanted > bytes_.size() - at_)
            throw std::runtime_error(fmt::format("the file ends early, at byte {}", bytes_.size()));
        std::memcpy(c, bytes_.data() + at_, wanted);
        at_ += wanted;
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = static_cast<std::size_t>(position); }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

// A file that is read from the disk as the library asks for it.
class FileStream : public Imf::IStream {
  public:
    explicit FileStream(const std::filesystem::path& path)
        : Imf::IStream(path.string().c_str()), in_(path, std::ios::binary) {
        if (!in_)
            throw Error(ExitCode::input_refused,
                        fmt::format("{}: cannot open: {}", path.string(), std::strerror(errno)));
    }

    bool read(char c[], int n) override {
        if (!in_.read(c, n)) throw std::runtime_error("the file ends early");
        return in_.peek() != std::ifstream::traits_type::eof();
    }
    std::uint64_t tellg() override {
        return static_cast<std::uint64_t>(static_cast<std::streamoff>(in_.tellg()));
    }
    void seekg(std::uint64_t position) override {
        in_.clear();
        in_.seekg(static_cast<std::streamoff>(position));
    }
    void clear() override { in_.clear(); }

  private:
    std::ifstream in_;
};

struct Window {
    std::int64_t x = 0, y = 0, width = 0, height = 0;
};

Window window_of(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, std::int64_t{box.max.x} - box.min.x + 1,
            std::int64_t{box.max.y} - box.min.y + 1};
}

void check_side(const Window& window, std::string_view which) {
    if (window.width < 1 || window.height < 1 || window.width > kMaxExrSide || window.height > kMaxExrSide) {
        throw std::runtime_error(fmt::format("the {} window is {}x{}, each side must be 1 to {}", which,
                                             window.width, window.height, kMaxExrSide));
    }
}

// The part of the display window that the data window covers; none where that is all of it.
std::optional<PixelBox> stored_pixels(const Imf::Header& header) {
    const Window data = window_of(header.dataWindow());
    const Window display = window_of(header.displayWindow());
    const auto inside = [](std::int64_t at, std::int64_t end) {
        return static_cast<int>(std::clamp<std::int64_t>(at, 0, end));
    };
    const PixelBox box{.x0 = inside(data.x - display.x, display.width),
                       .y0 = inside(data.y - display.y, display.height),
                       .x1 = inside(data.x - display.x + data.width, display.width),
                       .y1 = inside(data.y - display.y + data.height, display.height)};
    const bool is_all = box.x0 == 0 && box.y0 == 0 && box.x1 == display.width && box.y1 == display.height;
    return is_all ? std::nullopt : std::optional(box);
}

void check_header(const Imf::Header& header, std::size_t file_bytes) {
    if (header.hasType() && Imf::isDeepData(header.type()))
        throw std::runtime_error("deep data is not supported, flatten it first");
    const Window data = window_of(header.dataWindow());
    const Window display = window_of(header.displayWindow());
    check_side(data, "data");
    check_side(display, "display");
    std::size_t channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        ++channels;
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
            throw std::runtime_error(
                fmt::format("channel {} is subsampled, which is not supported", quoted_name(c.name())));
    }
    if (channels < 1 || channels > kMaxExrChannels)
        throw std::runtime_error(fmt::format("{} channels, must be 1 to {}", channels, kMaxExrChannels));
    const auto bytes_of = [&](const Window& w) {
        return static_cast<std::size_t>(w.width * w.height) * channels * sizeof(float);
    };
    if (bytes_of(data) > kMaxExrBytes)
        throw std::runtime_error(fmt::format("its planes need more than {} bytes", kMaxExrBytes));
    if (bytes_of(display) > std::max(bytes_of(data), kMaxExrFrameBytes))
        throw std::runtime_error(
            fmt::format("the frame around its crop needs more than {} bytes", kMaxExrFrameBytes));
    if (bytes_of(data) > kFreeExrBytes + kMaxExrGrowth * file_bytes) {
        throw std::runtime_error(fmt::format("{}x{} pixels of {} channels cannot lie in {} bytes", data.width,
                                             data.height, channels, file_bytes));
    }
}

// Copies a plane of the data window to its place in the display window; what lies outside is dropped.
std::vector<float> place(const std::vector<float>& plane, const Window& data, const Window& display) {
    std::vector<float> result(static_cast<std::size_t>(display.width * display.height), 0.0f);
    const std::int64_t x0 = std::max(data.x, display.x);
    const std::int64_t x1 = std::min(data.x + data.width, display.x + display.width);
    const std::int64_t y1 = std::min(data.y + data.height, display.y + display.height);
    for (std::int64_t y = std::max(data.y, display.y); y < y1 && x0 < x1; ++y) {
        const auto from = plane.begin() + ((y - data.y) * data.width + (x0 - data.x));
        std::copy(from, from + (x1 - x0),
                  result.begin() + ((y - display.y) * display.width + (x0 - display.x)));
    }
    return result;
}

void read_attributes(const Imf::Header& header, Image& image) {
    for (auto a = header.begin(); a != header.end(); ++a) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        const std::string_view name = a.name();
        if (text != nullptr && name != "type") image.attributes.emplace(printable(name), text->value());
    }
}

template <class T>
Imf::Slice slice_of(Imf::PixelType type, std::vector<T>& plane, const Imath::Box2i& box) {
    static_assert(sizeof(T) == 4);
    const Window data = window_of(box);
    plane.resize(static_cast<std::size_t>(data.width * data.height));
    return Imf::Slice::Make(type, plane.data(), box, sizeof(T),
                            sizeof(T) * static_cast<std::size_t>(data.width));
}

// The channels inside `box`, rows of the data window. Whole numbers go into `image.words`, or, with
// `as_float`, are read as floats; then sums are left out.
void read_channels(Imf::InputPart& part, const Imath::Box2i& box, bool as_float, Image& image) {
    const Imf::Header& header = part.header();
    Imf::FrameBuffer frame;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const std::string name = printable(c.name());
        if (image.channels.contains(name) || image.words.contains(name))
            throw std::runtime_error(fmt::format("two channels are called {}", quoted_name(name)));
        const bool is_whole_number = c.channel().type == Imf::UINT;
        if (is_whole_number && !as_float) {
            frame.insert(c.name(), slice_of(Imf::UINT, image.words[name], box));
        } else if (!is_whole_number || !name.starts_with(kSumsLayer)) {
            Image::Channel& channel = image.channels[name];
            frame.insert(c.name(), slice_of(Imf::FLOAT, channel.pixels, box));
            channel.precision =
                c.channel().type == Imf::HALF ? Image::Precision::half : Image::Precision::single;
        }
    }
    part.setFrameBuffer(frame);
    part.readPixels(box.min.y, box.max.y);
}

Image read_frame(Imf::MultiPartInputFile& file) {
    Imf::InputPart part(file, 0);
    const Imf::Header& header = part.header();
    const Window display = window_of(header.displayWindow());
    Image image{.width = static_cast<int>(display.width),
                .height = static_cast<int>(display.height),
                .stored = stored_pixels(header)};
    read_attributes(header, image);
    read_channels(part, header.dataWindow(), true, image);
    if (header.dataWindow() == header.displayWindow()) return image;
    for (auto& [name, channel] : image.channels)
        channel.pixels = place(channel.pixels, window_of(header.dataWindow()), display);
    return image;
}

// The library allocates tables by the header while it opens a file; this makes it check the header first.
void limit_library() {
    Imf::Header::setMaxImageSize(kMaxExrSide, kMaxExrSide);
}

std::unique_ptr<Imf::IStream> open_stream(const std::filesystem::path& path) {
    limit_library();
    return std::make_unique<FileStream>(path);
}

}  // namespace

struct ExrRows::State {
    explicit State(const std::filesystem::path& path)
        : name(path.string()), stream(open_stream(path)), file(*stream, 0, false) {
        check_header(file.header(0), std::filesystem::file_size(path));
        part.emplace(file, 0);
        const Window data = window_of(part->header().dataWindow());
        head = {.width = static_cast<int>(data.width), .height = static_cast<int>(data.height)};
        read_attributes(part->header(), head);
    }

    std::string name;
    std::unique_ptr<Imf::IStream> stream;
    Imf::MultiPartInputFile file;
    std::optional<Imf::InputPart> part;
    Image head;
};

ExrRows::ExrRows(const std::filesystem::path& path)
    : state_(read_or_refuse(path.string(), kExrKind, [&] { return std::make_unique<State>(path); })) {}

ExrRows::~ExrRows() = default;

const Image& ExrRows::head() const {
    return state_->head;
}

Image ExrRows::read(int first, int count) {
    VX_ASSERT(first >= 0 && count > 0 && count <= state_->head.height - first);
    return read_or_refuse(state_->name, kExrKind, [&] {
        Imath::Box2i box = state_->part->header().dataWindow();
        box.min.y += first;
        box.max.y = box.min.y + count - 1;
        Image rows{.width = state_->head.width, .height = count};
        read_channels(*state_->part, box, false, rows);
        return rows;
    });
}

Image decode_exr(std::span<const std::byte> bytes, const std::string& name) {
    return read_or_refuse(name, kExrKind, [&] {
        limit_library();
        MemoryStream stream(bytes, name);
        Imf::MultiPartInputFile file(stream, 0, false);
        check_header(file.header(0), bytes.size());
        return read_frame(file);
    });
}

Image read_exr(const std::filesystem::path& path) {
    return decode_exr(read_file(path, kMaxExrFileBytes), path.string());
}

}  // namespace voxilux
