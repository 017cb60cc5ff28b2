// Files that are cut, damaged, or made to explode: each is read in bounded memory and time, and a refusal
// always names the place. Under the sanitizers, these tests show that nothing is read or written outside its
// bounds.

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "formats/vox_info.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "scene/vox_instances.h"
#include "scene/vox_scene.h"
#include "support/allocation_counter.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

using namespace vox_builder;

constexpr std::uint32_t kSeed = 20240607;
constexpr std::size_t kFreeBytes = std::size_t{64} << 20;  // of read_vox's promise
constexpr std::size_t kBytesPerByte = 64;
// The fixed memory that a small file needs: tables of the palette. With this stricter bound the cost per byte
// shows.
constexpr std::size_t kFixedBytes = std::size_t{1} << 18;

// Reads a file and does everything with it that is possible; returns the reason when it is refused.
std::string use(std::span<const std::byte> bytes) {
    const auto file = read_vox(bytes);
    if (!file) return file.reason();
    const auto instances = vox_instances(file.value(), 3);
    if (!instances) return instances.reason();
    (void)summarize(file.value());
    (void)scene_from_vox(file.value(), {.frame = 3});
    const auto again = read_vox(write_vox(file.value()));
    EXPECT_TRUE(again) << again.reason();
    return "";
}

TEST(VoxHostile, every_truncation_is_refused_with_an_offset_inside_the_file) {
    const std::string text = rich_file_text();
    for (std::size_t length = 0; length < text.size(); ++length) {
        const auto file = read_vox(bytes_of(text.substr(0, length)));
        ASSERT_FALSE(file) << length;
        ASSERT_TRUE(file.reason().starts_with("at byte ")) << file.reason();
        EXPECT_LE(std::stoul(file.reason().substr(8)), length) << file.reason();
    }
}

// The sizes in MAIN are cut, too, so that parsing ends inside a chunk.
TEST(VoxHostile, every_truncation_inside_an_honest_main_is_refused_or_loads) {
    const std::string text = rich_file_text();
    constexpr std::size_t kFirstChunk = 20;
    std::size_t refused = 0;
    for (std::size_t length = kFirstChunk; length < text.size(); ++length) {
        const auto file = read_vox(vox_builder::file(text.substr(kFirstChunk, length - kFirstChunk), 200));
        if (file) continue;
        EXPECT_TRUE(file.reason().starts_with("at byte ")) << file.reason();
        ++refused;
    }
    EXPECT_GT(refused, text.size() * 9 / 10);
}

TEST(VoxHostile, changed_bytes_are_refused_with_an_offset_or_load) {
    const std::string text = rich_file_text();
    std::mt19937 random(kSeed);
    std::size_t refused = 0, loaded = 0;
    for (int round = 0; round < 6000; ++round) {
        std::string damaged = text;
        const auto changes = 1 + random() % 3;
        for (unsigned i = 0; i < changes; ++i)
            damaged[random() % damaged.size()] = static_cast<char>(random());
        const std::string reason = use(bytes_of(damaged));
        ++(reason.empty() ? loaded : refused);
        EXPECT_TRUE(reason.empty() || reason.starts_with("at byte ") || reason.starts_with("node "))
            << reason;
    }
    EXPECT_GT(refused, 500u) << "seed " << kSeed;
    EXPECT_GT(loaded, 500u) << "seed " << kSeed;
}

// Lengths and counts are where parsers break: every aligned 32-bit word takes each of these values.
TEST(VoxHostile, extreme_words_at_every_offset_are_survived) {
    const std::string text = rich_file_text();
    for (std::size_t at = 0; at + 4 <= text.size(); ++at) {
        for (const std::uint32_t value : {0u, 1u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
            std::string damaged = text;
            damaged.replace(at, 4, u32(value));
            const std::string reason = use(bytes_of(damaged));
            EXPECT_TRUE(reason.empty() || reason.starts_with("at byte ") || reason.starts_with("node "))
                << reason;
        }
    }
}

std::string chain(int length) {
    std::string chunks = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}});
    for (int i = 0; i < length; i += 2) {
        chunks += transform(i, i + 1, -1, {{{"_t", "1 0 0"}}});
        chunks += group(i + 1, {i + 2});
    }
    return chunks + shape(length, {{0, {}}});
}

TEST(VoxHostile, chain_of_a_million_nodes_loads) {
    constexpr int kDepth = 1000000;
    const auto bytes = vox_builder::file(chain(kDepth));
    const PeakAllocation peak;
    const auto file = read_vox(bytes);
    ASSERT_TRUE(file) << file.reason();
    const auto instances = vox_instances(file.value());
    ASSERT_TRUE(instances) << instances.reason();
    ASSERT_EQ(instances.value().size(), 1u);
    EXPECT_EQ(instances.value()[0].translation, glm::ivec3(kDepth / 2, 0, 0));
    EXPECT_LE(peak.bytes(), kFreeBytes + kBytesPerByte * bytes.size());
}

// `levels` groups, each with `width` times the next: width^levels paths from a few hundred bytes.
std::string bomb(int levels, int width, bool has_shape) {
    std::string chunks = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}}) + transform(0, 1, -1, {{}});
    for (int i = 1; i <= levels; ++i)
        chunks += group(i, std::vector<int>(static_cast<std::size_t>(width), i + 1));
    return chunks + (has_shape ? shape(levels + 1, {{0, {}}}) : group(levels + 1, {}));
}

TEST(VoxHostile, exponential_graphs_are_refused_before_they_are_walked) {
    for (const bool has_shape : {true, false}) {
        const auto bytes = vox_builder::file(bomb(100, 2, has_shape));
        const PeakAllocation peak;
        const auto file = read_vox(bytes);
        ASSERT_FALSE(file);
        EXPECT_NE(file.reason().find("the scene graph expands to more than 4194304 nodes"),
                  std::string::npos);
        EXPECT_LE(peak.bytes(), kFreeBytes);
    }
}

TEST(VoxHostile, instances_up_to_the_limit_load_and_one_more_is_refused) {
    constexpr int kSide = 512;  // 512 * 512 is kVoxMaxInstances
    static_assert(kSide * kSide == kVoxMaxInstances);
    const auto bytes = vox_builder::file(bomb(2, kSide, true));
    const PeakAllocation peak;
    const auto file = read_vox(bytes);
    ASSERT_TRUE(file) << file.reason();
    EXPECT_EQ(scene_from_vox(file.value()).instances.size(), kVoxMaxInstances);
    EXPECT_LE(peak.bytes(), kFreeBytes + kBytesPerByte * bytes.size());
    const std::string wider = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}}) + transform(0, 1, -1, {{}}) +
                              group(1, {2, 4}) + group(2, std::vector<int>(kSide, 3)) +
                              group(3, std::vector<int>(kSide, 4)) + shape(4, {{0, {}}});
    const auto refused = read_vox(vox_builder::file(wider));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.reason().find("the scene graph has more than 262144 instances"), std::string::npos);
}

TEST(VoxHostile, many_instances_of_many_voxels_are_refused_by_their_sum) {
    std::string voxels = u32(40000);
    for (int i = 0; i < 40000; ++i)
        voxels += std::string{static_cast<char>(i % 200), static_cast<char>(i / 200), '\0', '\1'};
    const std::string chunks = size_chunk(256, 256, 256) + chunk("XYZI", voxels) + transform(0, 1, -1, {{}}) +
                               group(1, std::vector<int>(512, 2)) + group(2, std::vector<int>(200, 3)) +
                               shape(3, {{0, {}}});
    const auto file = read_vox(vox_builder::file(chunks));
    ASSERT_TRUE(file) << file.reason();
    try {
        (void)scene_from_vox(file.value());
        FAIL() << "4 * 10^9 voxels were accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_STREQ(error.what(), "the visible instances have more than 2147483648 voxels together");
    }
}

TEST(VoxHostile, sum_of_translations_beyond_the_limit_is_refused) {
    const std::string far = std::to_string(kVoxMaxTranslation) + " 0 0";
    const auto file =
        read_vox(vox_builder::file(chiral_model(2, 2, 2) + transform(0, 1, -1, {{{"_t", far}}}) +
                                   transform(1, 2, -1, {{{"_t", "1 0 0"}}}) + shape(2, {{0, {}}})));
    ASSERT_TRUE(file) << file.reason();
    const auto instances = vox_instances(file.value());
    ASSERT_FALSE(instances);
    EXPECT_EQ(instances.reason(), "node 2: its position is beyond 268435456 voxels from the origin");
}

struct Amplifier {
    const char* name;
    std::string unit;  // repeated to fill a file
    std::string head;
};

// The smallest chunk or item of each kind, a hundred thousand times: the greatest cost that a byte of a file
// can have.
TEST(VoxHostile, densest_chunks_stay_within_the_memory_bound) {
    const std::string model = size_chunk(1, 1, 1);
    const Amplifier amplifiers[] = {
        {"unknown", chunk("zzzz", ""), model},
        {"XYZI", chunk("XYZI", u32(0)), model},
        {"rOBJ", chunk("rOBJ", u32(0)), model},
        {"LAYR", chunk("LAYR", u32(0) + u32(0)), model},
        {"MATL", chunk("MATL", u32(1) + u32(0)), model},
        {"MATT", chunk("MATT", u32(1) + u32(0) + u32(0) + u32(0)), model},
        {"rOBJ pairs", chunk("rOBJ", u32(1) + u32(0) + u32(0)), model},
        {"rOBJ text", chunk("rOBJ", u32(1) + text("0123456789abcdef") + text("")), model},
        {"RGBA", chunk("RGBA", ""), model},
    };
    for (const Amplifier& amplifier : amplifiers) {
        std::string chunks = amplifier.head;
        while (chunks.size() < 1000000)
            chunks += amplifier.unit;
        const auto bytes = vox_builder::file(chunks);
        const PeakAllocation peak;
        const std::string reason = use(bytes);
        EXPECT_EQ(reason, "") << amplifier.name;
        EXPECT_LE(peak.bytes(), kFixedBytes + kBytesPerByte * bytes.size()) << amplifier.name;
    }
}

TEST(VoxHostile, densest_items_stay_within_the_memory_bound) {
    constexpr std::size_t kItems = 100000;
    const std::string model = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}});
    std::string nodes = transform(0, 1, -1, {{}});
    for (int i = 1; i < 200000; ++i)
        nodes += group(i, {});
    const std::pair<const char*, std::string> dense[] = {
        {"pairs", chunk("rOBJ", size_of(kItems) + std::string(8 * kItems, '\0'))},
        {"frames", chunk("nTRN", i32(0) + u32(0) + i32(-1) + i32(-1) + i32(-1) + size_of(kItems) +
                                     std::string(4 * kItems, '\0'))},
        {"shape models", transform(0, 1, -1, {{}}) + chunk("nSHP", i32(1) + u32(0) + size_of(kItems) +
                                                                       std::string(8 * kItems, '\0'))},
        {"children", transform(0, 1, -1, {{}}) +
                         chunk("nGRP", i32(1) + u32(0) + size_of(kItems) + std::string(4 * kItems, '\x7f'))},
        {"nodes", nodes},
        {"notes", chunk("NOTE", size_of(kItems) + std::string(4 * kItems, '\0'))},
        {"lying pairs", chunk("rOBJ", size_of(kItems) + std::string(8 * kItems - 1, '\1') + "x")},
    };
    for (const auto& [name, chunks] : dense) {
        const auto bytes = vox_builder::file(model + chunks);
        const PeakAllocation peak;
        (void)use(bytes);
        EXPECT_LE(peak.bytes(), kFixedBytes + kBytesPerByte * bytes.size()) << name;
    }
}

// The meter of the bounds above can show a breach.
TEST(VoxHostile, allocation_counter_sees_what_is_held_at_once) {
    const PeakAllocation peak;
    { const std::vector<std::byte> block(kFreeBytes + 1); }
    { const std::vector<std::byte> block(1000); }
    EXPECT_GT(peak.bytes(), kFreeBytes);
    EXPECT_LT(peak.bytes(), kFreeBytes + 100000);
}

}  // namespace
}  // namespace voxilux
