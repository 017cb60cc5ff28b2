// Writes ten files of each voxel format of other programs into a folder, as seeds for voxel_formats_fuzz.

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "support/voxel_file_builder.h"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const auto& [ending, make] : voxel_file_builder::kSampledFormats) {
        for (std::uint32_t seed = 0; seed < 10; ++seed) {
            const std::string bytes = make(seed).bytes;
            std::ofstream file(folder / (std::to_string(seed) + ending), std::ios::binary);
            if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) return 1;
        }
    }
    return 0;
}
