// The flags of photon mapping do what the keys of a scene file do.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/scratch_folder.h"
#include "tools/cli/child_process.h"
#include "tools/cli/words.h"

namespace voxilux::test {
namespace {

std::string hash_of(const Words& more) {
    return plan_of("cornell", more)["scene_hash"];
}

TEST(PhotonFlags, are_the_keys_of_the_section) {
    const std::string by_flags = hash_of({"--photons", "1000", "--radius", "3", "--alpha", "0.5"});
    EXPECT_EQ(by_flags,
              hash_of({"-D", "photons.count=1000", "-D", "photons.radius=3", "-D", "photons.alpha=0.5"}));
    EXPECT_NE(by_flags, hash_of({"--photons", "1001", "--radius", "3", "--alpha", "0.5"}));
    EXPECT_NE(by_flags, hash_of({"--photons", "1000", "--radius", "3.5", "--alpha", "0.5"}));
    EXPECT_NE(by_flags, hash_of({"--photons", "1000", "--radius", "3", "--alpha", "0.6"}));
}

TEST(PhotonFlags, replace_what_the_file_says) {
    const Words file = {"-D", "photons.count=1000", "-D", "photons.radius=3", "-D", "photons.alpha=0.5"};
    Words words = file;
    words.insert(words.end(), {"--photons", "0", "--radius", "auto", "--alpha", "1"});
    EXPECT_EQ(hash_of(words), hash_of({"--alpha", "1"}));
    EXPECT_NE(hash_of(file), hash_of({"--alpha", "1"}));
}

TEST(PhotonFlags, number_of_photons_sets_the_store) {
    const auto bytes = [](const Json& plan) {
        for (const Json& row : plan["memory"])
            if (row["buffer"] == "photon.rays") return row["bytes"].get<double>();
        return 0.0;
    };
    const double one = bytes(plan_of("cornell", {"--photons", "20000"}));
    EXPECT_GT(one, 0.0);
    EXPECT_EQ(bytes(plan_of("cornell", {"--photons", "40000"})), 2.0 * one);
}

TEST(PhotonFlags, picture_follows_them) {
    const ScratchFolder scratch;
    const auto render = [&](const std::string& file, const Words& more) {
        Words words = {"render", scene_file("cornell"), "--size",    "16x16", "--iterations",
                       "2",      "--reproducible",      "--photons", "500",   "--quiet",
                       "-o",     scratch / file};
        words.insert(words.end(), more.begin(), more.end());
        const Ending ending = run(words);
        EXPECT_EQ(ending.code, 0) << ending.err;
        return bytes_of(scratch / file);
    };
    const std::string flag = render("a.exr", {"--radius", "20"});
    EXPECT_EQ(flag, render("b.exr", {"-D", "photons.radius=20"}));
    EXPECT_NE(flag, render("c.exr", {"--radius", "5"}));
}

}  // namespace
}  // namespace voxilux::test
