#pragma once

// Helpers to call the binary: command lines as words, and the JSON that comes back.

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"

namespace voxilux::test {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

inline Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// Standard output as JSON, and nothing but JSON on it. `words` ask for it.
inline Json json_of(const Words& words, const Surroundings& surroundings = {}) {
    const Ending ending = run(words, surroundings);
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.err, "");
    return Json::parse(ending.out);
}

inline std::set<std::string> keys_of(const Json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items())
        keys.insert(key);
    return keys;
}

// The plan of a scene at 16x16.
inline Json plan_of(const std::string& scene, const Words& more) {
    return json_of(with({"plan", scene_file(scene), "--size", "16x16", "--json", "-"}, more));
}

// A quick one of a scene with everything, to a.exr.
inline Words small_render(const ScratchFolder& scratch, const Words& more = {}) {
    return with({"render", scene_file("mixed"), "--size", "32x18", "--spp", "2", "--effect", "indirect=off",
                 "-o", scratch / "a.exr"},
                more);
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

}  // namespace voxilux::test
