#pragma once

// Small .vox files for tests of the binary.

#include "support/vox_builder.h"
#include "tools/cli/words.h"

namespace voxilux::test {

inline const Words kSmall = {"--size", "24x16", "--spp", "2"};

// A .vox file of 3x4x5 voxels with one used camera, and perhaps a setting.
inline void write_model(const std::filesystem::path& file, const vox_builder::Pairs& setting = {}) {
    using namespace vox_builder;
    std::string chunks = chiral_model(3, 4, 5) + record("rCAM", 0, {{"_radius", "0"}, {"_mode", "pers"}}) +
                         record("rCAM", 2, {{"_angle", "20 30 0"}, {"_radius", "16"}, {"_focus", "0 0 1"}});
    if (!setting.empty()) chunks += chunk("rOBJ", dict(setting));
    const std::vector<std::byte> bytes = vox_builder::file(chunks);
    write_text(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// Without settings.
inline std::string bytes_of_model_without_camera() {
    using namespace vox_builder;
    const std::vector<std::byte> bytes = vox_builder::file(chiral_model(3, 4, 5));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace voxilux::test
