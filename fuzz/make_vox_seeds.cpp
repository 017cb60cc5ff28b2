// Writes the seed corpus of vox_fuzz into a folder: one small file for each feature of the reader.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "support/vox_builder.h"

namespace {

using namespace vox_builder;

std::string bomb(int levels, int width) {
    std::string chunks = chiral_model(2, 2, 2) + transform(0, 1, -1, {{}});
    for (int i = 1; i <= levels; ++i)
        chunks += group(i, std::vector<int>(static_cast<std::size_t>(width), i + 1));
    return chunks + shape(levels + 1, {{0, {}}});
}

std::string chain(int length) {
    std::string chunks = chiral_model(2, 2, 2);
    for (int i = 0; i < length; ++i)
        chunks += transform(i, i + 1, i % 3, {{{"_r", "20"}, {"_t", "1 2 3"}}});
    return chunks + shape(length, {{0, {}}}) + layer(1, {{"_hidden", "1"}});
}

std::string all_rotations() {
    std::string chunks = chiral_model(2, 3, 4);
    std::vector<int> children;
    for (int byte = 0; byte < 128; ++byte) {
        const int first = byte & 3, second = byte >> 2 & 3;
        if (first == second || first == 3 || second == 3) continue;
        chunks += transform(1000 + byte, 2, 0, {{{"_r", std::to_string(byte)}}});
        children.push_back(1000 + byte);
    }
    return chunks + transform(0, 1, -1, {{}}) + group(1, children) + shape(2, {{0, {}}});
}

std::map<std::string, std::string> seeds() {
    const std::string model = chiral_model(3, 3, 3);
    return {
        {"rich", rich_file_text()},
        {"plain", file_text(model)},
        {"empty", file_text("")},
        {"pack", file_text(chunk("PACK", i32(2)) + model + chiral_model(2, 2, 2))},
        {"palette", file_text(model + palette_chunk())},
        {"short_palette", file_text(model + chunk("RGBA", "abcdefgh"))},
        {"odd_voxels", file_text(size_chunk(2, 2, 2) +
                                 voxels_chunk({{0, 0, 0, 0}, {0, 0, 0, 9}, {5, 0, 0, 1}, {0, 0, 0, 3}}))},
        {"large_model", file_text(size_chunk(256, 256, 256) + voxels_chunk({{255, 255, 255, 255}}))},
        {"old_material",
         file_text(model + chunk("MATT", i32(1) + i32(1) + f32(0.5f) + u32(0x7f) + std::string(28, '\x3e')))},
        {"chain", file_text(chain(20), 200)},
        {"bomb", file_text(bomb(12, 2), 200)},
        {"rotations", file_text(all_rotations(), 200)},
        {"cycle", file_text(model + transform(0, 1, -1, {{}}) + group(1, {0}))},
        {"numbers",
         file_text(model +
                   record("MATL", 1,
                          {{"_type", "_emit"}, {"_emit", "1e999"}, {"_flux", "nan"}, {"_rough", "-inf"}}))},
        {"unknown", file_text(model + chunk("rLIT", "abc", chunk("sub1", "")) + chunk("rAIR", ""))},
        {"settings",
         file_text(model + chunk("rOBJ", dict({{"_type", "_inf"}, {"_i", "2"}, {"_angle", "30 90"}})) +
                   chunk("rOBJ", dict({{"_type", "_env"}, {"_mode", "1"}})) +
                   chunk("rLEN", dict({{"_fov", "60"}, {"_exp", "-1"}})) +
                   record("rCAM", 1, {{"_mode", "orth"}, {"_angle", "20 30 0"}, {"_radius", "9"}}))},
        {"tail", file_text(model) + "tail"},
    };
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_vox_seeds FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const auto& [name, text] : seeds()) {
        std::ofstream out(folder / (name + ".vox"), std::ios::binary);
        out << text;
        if (!out.flush()) {
            std::fprintf(stderr, "%s: cannot write\n", (folder / name).c_str());
            return 73;
        }
    }
    return 0;
}
