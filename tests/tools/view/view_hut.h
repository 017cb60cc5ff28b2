#pragma once

// Small .vox files for the window.

#include "base/file.h"
#include "formats/vox_write.h"
#include "tools/view/view_script.h"

namespace voxilux::test {

// A hollow box of two colours.
inline VoxModel hut_model(int height) {
    VoxModel model{.size = {20, 20, 12}};
    for (int z = 0; z < height; ++z)
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 20; ++x)
                if (z == 0 || x == 0 || y == 19)
                    model.voxels.push_back({static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                                            static_cast<std::uint8_t>(z),
                                            static_cast<std::uint8_t>(z < 6 ? 80 : 140)});
    return model;
}

// A file whose frame i shows the ith model.
inline std::vector<std::byte> vox_of(std::vector<VoxModel> models) {
    VoxShape shape{.id = 3, .attributes = {}, .models = {}};
    for (std::size_t i = 0; i < models.size(); ++i)
        shape.models.push_back({static_cast<std::int32_t>(i),
                                models.size() > 1 ? VoxDict{{"_f", std::to_string(i)}} : VoxDict{}});
    VoxFile file;
    file.models = std::move(models);
    file.nodes = {VoxTransform{.id = 0, .child = 1, .frames = {{}}}, VoxGroup{.id = 1, .children = {2}},
                  VoxTransform{.id = 2, .child = 3, .frames = {{{"_t", "0 0 6"}}}}, std::move(shape)};
    file.layers = {{.id = 0, .attributes = {{"_name", "walls"}}}};
    return write_vox(file);
}
inline std::vector<std::byte> hut(int height = 12) {
    return vox_of({hut_model(height)});
}
// Two frames, 0 and 1, of a hut that shrinks.
inline std::vector<std::byte> shrinking_hut() {
    return vox_of({hut_model(12), hut_model(8)});
}

// Plays a script on the hut; its report is report.json.
inline Ending play_hut(const ScratchFolder& scratch, const std::string& script) {
    write_file_atomically(scratch.path() / "hut.vox", hut());
    const Ending ending = play_scene(scratch, "hut.vox", script);
    EXPECT_EQ(report_of(scratch)["messages"], Json::array());
    return ending;
}

inline std::string click(int x, int y) {
    return "[[step]]\nmove = [" + std::to_string(x) + ", " + std::to_string(y) +
           "]\n[[step]]\npress = 'left'\n[[step]]\nrelease = 'left'\n";
}

}  // namespace voxilux::test
