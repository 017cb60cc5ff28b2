#include "formats/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <vector>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "base/assert.h"
#include "base/error.h"
#include "base/file.h"

namespace voxilux {
namespace {

constexpr float kLargestHalf = 65504.0f;

// An output stream that keeps its first failure: OpenEXR swallows what is thrown while it closes a file, and
// a full disk often shows only then.
class CheckedStream : public Imf::OStream {
  public:
    explicit CheckedStream(const std::filesystem::path& path)
        : Imf::OStream(path.string().c_str()), out_(path, std::ios::binary) {
        check();
    }
    void write(const char c[], int n) override {
        out_.write(c, n);
        check();
    }
    // Called from a destructor of the library, outside of any catch: it must not throw.
    std::uint64_t tellp() override {
        note();
        return out_ ? static_cast<std::uint64_t>(static_cast<std::streamoff>(out_.tellp())) : 0;
    }
    void seekp(std::uint64_t position) override {
        out_.seekp(static_cast<std::streamoff>(position));
        check();
    }
    void close() {
        if (failure_ == 0) out_.close();
        check();
    }

  private:
    void note() {
        if (!out_ && failure_ == 0) failure_ = errno != 0 ? errno : EIO;
    }
    void check() {
        note();
        if (failure_ != 0) throw std::runtime_error(std::strerror(failure_));
    }

    std::ofstream out_;
    int failure_ = 0;
};

// The nearest value that the channel can hold; counts what it changed.
float storable(float value, float largest, WriteReport& report) {
    if (std::isnan(value)) {
        ++report.non_finite;
        return 0.0f;
    }
    if (std::isinf(value)) {
        ++report.non_finite;
        return std::copysign(largest, value);
    }
    if (std::abs(value) > largest) {
        ++report.clamped;
        return std::copysign(largest, value);
    }
    return value;
}

// EXR matrices act on row vectors, GLM's on column vectors; both lie in memory as the same 16 floats.
Imath::M44f exr_matrix(const glm::mat4& m) {
    Imath::M44f result;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j)
            result[i][j] = m[i][j];
    }
    return result;
}

std::string local_date() {
    const std::time_t now = std::time(nullptr);
    std::tm fields{};
    localtime_r(&now, &fields);
    char text[32];
    const std::size_t length = std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &fields);
    return std::string(text, length);
}

Imf::Header base_header(const Image& image, const ExrWindow& window) {
    const int full_width = window.full_width > 0 ? window.full_width : image.width;
    const int full_height = window.full_height > 0 ? window.full_height : image.height;
    const Imath::Box2i display(Imath::V2i(0, 0), Imath::V2i(full_width - 1, full_height - 1));
    const Imath::Box2i data(Imath::V2i(window.x, window.y),
                            Imath::V2i(window.x + image.width - 1, window.y + image.height - 1));
    return Imf::Header(display, data, 1.0f, Imath::V2f(0, 0), 1.0f, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
}

Imf::Header make_header(const Image& image, const ExrOptions& options) {
    Imf::Header header = base_header(image, options.window);
    for (const auto& [name, text] : image.attributes) {
        if (options.reproducible && name == "capDate") continue;
        header.insert(name, Imf::StringAttribute(text));
    }
    Imf::addChromaticities(header, Imf::Chromaticities());  // the default ones are Rec.709 with D65
    header.insert("software", Imf::StringAttribute(options.software));
    if (!options.comments.empty()) header.insert("comments", Imf::StringAttribute(options.comments));
    if (!options.reproducible) header.insert("capDate", Imf::StringAttribute(local_date()));
    if (options.world_to_camera) Imf::addWorldToCamera(header, exr_matrix(*options.world_to_camera));
    if (options.world_to_ndc) Imf::addWorldToNDC(header, exr_matrix(*options.world_to_ndc));
    for (const auto& [name, channel] : image.channels) {
        const bool is_half = channel.precision == Image::Precision::half;
        header.channels().insert(name, Imf::Channel(is_half ? Imf::HALF : Imf::FLOAT));
    }
    for (const auto& [name, words] : image.words)
        header.channels().insert(name, Imf::Channel(Imf::UINT));
    return header;
}

// The planes that are stored in another form than the image holds them in. They must outlive the frame buffer
// that points into them.
struct Planes {
    std::map<std::string, std::vector<half>> halves;
    std::map<std::string, std::vector<float>> singles;
};

Planes make_planes(const Image& image, WriteReport& report) {
    Planes planes;
    for (const auto& [name, channel] : image.channels) {
        VX_ASSERT_EQ(channel.pixels.size(), pixel_count(image));
        if (channel.precision == Image::Precision::half) {
            std::vector<half>& plane = planes.halves[name];
            plane.reserve(channel.pixels.size());
            for (const float v : channel.pixels)
                plane.emplace_back(storable(v, kLargestHalf, report));
        } else {
            if (std::ranges::all_of(channel.pixels, [](float v) { return std::isfinite(v); })) continue;
            std::vector<float>& plane = planes.singles[name];
            plane.reserve(channel.pixels.size());
            const float largest = std::numeric_limits<float>::max();
            for (const float v : channel.pixels)
                plane.push_back(storable(v, largest, report));
        }
    }
    return planes;
}

template <class T>
Imf::Slice slice_of(Imf::PixelType type, const std::vector<T>& plane, const Imath::Box2i& window) {
    const std::size_t width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    return Imf::Slice::Make(type, plane.data(), window, sizeof(T), sizeof(T) * width);
}

void write_planes(Imf::OStream& stream, const Imf::Header& header, const Planes& planes, const Image& image) {
    Imf::FrameBuffer frame;
    const Imath::Box2i window = header.dataWindow();
    for (const auto& [name, plane] : planes.halves)
        frame.insert(name, slice_of(Imf::HALF, plane, window));
    for (const auto& [name, channel] : image.channels) {
        if (planes.halves.contains(name)) continue;
        const auto changed = planes.singles.find(name);
        frame.insert(
            name,
            slice_of(Imf::FLOAT, changed == planes.singles.end() ? channel.pixels : changed->second, window));
    }
    for (const auto& [name, words] : image.words) {
        VX_ASSERT_EQ(words.size(), pixel_count(image));
        frame.insert(name, slice_of(Imf::UINT, words, window));
    }
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(window.max.y - window.min.y + 1);
}

}  // namespace

WriteReport write_exr(const std::filesystem::path& path, const Image& image, const ExrOptions& options) {
    VX_ASSERT(image.width > 0 && image.height > 0 && !image.channels.empty());
    WriteReport report;
    const Planes planes = make_planes(image, report);
    write_file_atomically(path, [&](const std::filesystem::path& temporary) {
        errno = 0;
        CheckedStream stream(temporary);
        write_planes(stream, make_header(image, options), planes, image);
        stream.close();
    });
    return report;
}

}  // namespace voxilux
