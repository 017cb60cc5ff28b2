#include "formats/image_file.h"

#include <array>
#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "formats/exr.h"
#include "formats/png.h"

namespace voxilux {
namespace {

constexpr std::array<unsigned char, 4> kExrMagic = {0x76, 0x2F, 0x31, 0x01};
constexpr std::array<unsigned char, 4> kPngMagic = {0x89, 'P', 'N', 'G'};

bool begins_with(std::span<const std::byte> bytes, const std::array<unsigned char, 4>& magic) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

}  // namespace

Image read_image(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = read_file(path, kMaxExrFileBytes);
    if (begins_with(bytes, kExrMagic)) return decode_exr(bytes, path.string());
    if (begins_with(bytes, kPngMagic)) return decode_png(bytes, path.string());
    throw Error(ExitCode::input_refused, fmt::format("{}: neither an EXR nor a PNG", path.string()));
}

void write_image(const std::filesystem::path& path, const Image& image) {
    const std::string ending = path.extension().string();
    if (ending == ".png") {
        write_png(path, image);
    } else if (ending == ".exr") {
        write_exr(path, image, {.reproducible = true});
    } else {
        throw Error(ExitCode::usage, fmt::format("{}: the name must end in .exr or .png", path.string()));
    }
}

}  // namespace voxilux
