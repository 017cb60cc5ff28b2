// Every shared .vox file against values that an independent reader computed, and every malformed one against
// the decision that its row of SOURCES.md leaves open.

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "formats/vox_info.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "scene/vox_instances.h"
#include "scene/vox_scene.h"
#include "support/allocation_counter.h"
#include "support/sha256.h"
#include "support/shared_data.h"

namespace voxilux {
namespace {

using nlohmann::json;

// What read_vox promises for any file.
constexpr std::size_t kFreeFileBytes = std::size_t{64} << 20;
constexpr std::size_t kHeapPerByte = 64;
// Seconds to read any of the malformed files, all under 3 MB, with sanitizers on a loaded machine.
constexpr double kSecondsToRefuse = 10.0;

// Fields of the oracle that voxilux info does not print: chunk counts (ours are by meaning), and the digest
// (tested below).
const std::set<std::string> kNotPrinted = {"chunks", "palette_sha", "warn"};

// The first 16 hexadecimal digits of the palette's SHA-256, as the oracle has it.
std::string palette_digest(const VoxFile& file) {
    std::vector<std::uint8_t> bytes;
    for (const VoxColour& c : file.palette)
        bytes.insert(bytes.end(), {c.r, c.g, c.b, c.a});
    return sha256::hex(bytes).substr(0, 16);
}

// Names of the oracle's fields that differ from ours, with both values.
std::vector<std::string> differences(const json& oracle, const VoxFile& file) {
    const json ours = to_json(summarize(file).value());
    std::vector<std::string> found;
    for (const auto& [name, value] : oracle.items()) {
        if (kNotPrinted.contains(name)) continue;
        if (!ours.contains(name) || ours[name] != value)
            found.push_back(name + ": " + value.dump() + " against " + ours.value(name, json()).dump());
    }
    if (oracle.at("palette_sha") != palette_digest(file))
        found.push_back("palette_sha: " + palette_digest(file));
    return found;
}

json read_oracle(const char* name) {
    std::ifstream in(shared_data() / "oracle" / name);
    return json::parse(in);
}

std::filesystem::path vox_path(const std::string& name) {
    return shared_data() / "data" / "vox" / name;
}

TEST(VoxExternal, shared_files_have_the_expected_values) {
    SKIP_WITHOUT_SHARED_DATA();
    std::size_t files = 0;
    const json expected = read_oracle("vox_expected_shared.json");
    for (const auto& [name, entry] : expected.items()) {
        SCOPED_TRACE(name);
        const VoxFile file = load_vox(vox_path(name));
        for (const std::string& difference : differences(entry.at("oracle"), file))
            ADD_FAILURE() << difference;
        EXPECT_TRUE(file.warnings.empty()) << file.warnings.front();
        ++files;
    }
    EXPECT_GE(files, 18u);
}

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return word;
}

// Parses a dictionary independently of the engine.
json dict_at(const std::string& bytes, std::size_t at) {
    json dict = json::object();
    const auto text = [&] {
        const std::size_t length = word_at(bytes, at);
        at += 4 + length;
        return bytes.substr(at - length, length);
    };
    const std::uint32_t count = word_at(bytes, at);
    at += 4;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string key = text();
        dict[key] = text();
    }
    return dict;
}

// The dictionaries of all chunks of an id, `skip` bytes into each.
json dicts_of(const std::string& bytes, const std::string& id, std::size_t skip) {
    json dicts = json::array();
    for (std::size_t at = 20; at + 12 <= bytes.size();) {
        if (bytes.compare(at, 4, id) == 0) dicts.push_back(dict_at(bytes, at + 12 + skip));
        at += 12 + word_at(bytes, at + 4) + word_at(bytes, at + 8);
    }
    return dicts;
}

TEST(VoxExternal, settings_and_cameras_equal_an_independent_dump) {
    SKIP_WITHOUT_SHARED_DATA();
    std::size_t with_objects = 0, with_cameras = 0;
    const json expected = read_oracle("vox_expected_shared.json");
    for (const auto& [name, entry] : expected.items()) {
        SCOPED_TRACE(name);
        const std::vector<std::byte> raw = read_file(vox_path(name), std::size_t{1} << 30);
        const std::string bytes(reinterpret_cast<const char*>(raw.data()), raw.size());
        const json objects = dicts_of(bytes, "rOBJ", 0);
        const json cameras = dicts_of(bytes, "rCAM", 4);
        const json info = to_json(summarize(load_vox(vox_path(name))).value());
        if (!objects.empty() || dicts_of(bytes, "rLIT", 0).empty()) {
            EXPECT_EQ(info["settings"], objects);
        }
        EXPECT_EQ(info["cameras"], cameras.size());
        EXPECT_TRUE(info["saved_cameras"].empty()) << "no slot of these files was ever used";
        with_objects += objects.empty() ? 0 : 1;
        with_cameras += cameras.empty() ? 0 : 1;
    }
    EXPECT_EQ(with_objects, 9u);
    EXPECT_EQ(with_cameras, 5u);
    const json old = to_json(summarize(load_vox(vox_path("metal-material.vox"))).value())["settings"];
    EXPECT_EQ(old, json::parse(R"([{"_type": "_inf", "_i": "0.6", "_k": "255 255 255", "_angle": "50 50",
        "_area": "0.07"}, {"_type": "_uni", "_i": "0.7", "_k": "255 255 255"}, {"_type": "_fog_uni", "_d": "0.2",
        "_k": "255 255 255", "_g": "0"}, {"_type": "_lens", "_fov": "45", "_aperture": "0.25"}, {"_type": "_film",
        "_stops": "0", "_vig": "0", "_gam": "2.2"}, {"_type": "_bloom", "_mix": "0.5", "_scale": "1",
        "_threshold": "1"}, {"_type": "_ground", "_color": "80 80 80"}, {"_type": "_bg", "_color": "0 0 0"},
        {"_type": "_edge", "_color": "0 0 0"}])"));
}

TEST(VoxExternal, expected_values_comparator_sees_one_changed_thing) {
    SKIP_WITHOUT_SHARED_DATA();
    const json oracle = read_oracle("vox_expected_shared.json").at("xyz.vox").at("oracle");
    const VoxFile good = load_vox(vox_path("xyz.vox"));
    ASSERT_TRUE(differences(oracle, good).empty());
    const std::pair<const char*, void (*)(VoxFile&)> changes[] = {
        {"a voxel is gone", [](VoxFile& f) { f.models[0].voxels.pop_back(); }},
        {"a colour is off by one", [](VoxFile& f) { ++f.palette[100].g; }},
        {"a model is wider", [](VoxFile& f) { ++f.models[0].size.x; }},
        {"a node moves",
         [](VoxFile& f) {
             for (VoxNode& node : f.nodes) {
                 auto* transform = std::get_if<VoxTransform>(&node);
                 if (transform != nullptr && transform->id == 2) transform->frames[0] = {{"_t", "2 -3 3"}};
             }
         }},
        {"a node turns",
         [](VoxFile& f) {
             for (VoxNode& node : f.nodes) {
                 auto* transform = std::get_if<VoxTransform>(&node);
                 if (transform != nullptr && transform->id == 4)
                     transform->frames[0] = {{"_r", "4"}, {"_t", "2 -3 -2"}};
             }
         }},
        {"a layer is hidden", [](VoxFile& f) { f.layers[0].attributes.emplace_back("_hidden", "1"); }},
        {"a material has another type",
         [](VoxFile& f) {
             f.materials[9].attributes = {{"_type", "_metal"}};
         }},
    };
    for (const auto& [what, change] : changes) {
        VoxFile changed = good;
        change(changed);
        EXPECT_FALSE(differences(oracle, changed).empty()) << what;
    }
}

TEST(VoxExternal, shared_files_survive_write_and_read) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const auto& entry : std::filesystem::directory_iterator(shared_data() / "data" / "vox")) {
        SCOPED_TRACE(entry.path().filename().string());
        const VoxFile file = load_vox(entry.path());
        const auto bytes = write_vox(file);
        const auto again = read_vox(bytes);
        ASSERT_TRUE(again) << again.reason();
        EXPECT_TRUE(again.value() == file);
        EXPECT_LE(bytes.size(), std::filesystem::file_size(entry.path()));
    }
}

TEST(VoxExternal, shared_files_make_scenes_of_their_visible_voxels) {
    SKIP_WITHOUT_SHARED_DATA();
    for (const auto& entry : std::filesystem::directory_iterator(shared_data() / "data" / "vox")) {
        SCOPED_TRACE(entry.path().filename().string());
        const VoxFile file = load_vox(entry.path());
        const PeakAllocation peak;
        const Scene scene = scene_from_vox(file);
        EXPECT_LE(peak.bytes(), kFreeFileBytes + kHeapPerByte * std::filesystem::file_size(entry.path()));
        std::uint64_t visible = 0;
        const auto instances = vox_instances(file);
        for (const VoxInstance& instance : instances.value())
            visible += instance.hidden ? 0 : file.models[instance.model].voxels.size();
        std::uint64_t placed = 0;
        for (const Instance& instance : scene.instances)
            placed += scene.models.at(instance.model).voxels.size();
        EXPECT_EQ(placed, visible);  // these files have neither duplicates nor empty voxels
        EXPECT_GT(placed, 0u);
    }
}

enum class Decision { refuse, load };

struct MalformedRow {
    const char* file;
    Decision decision;
    const char* text;          // in the refusal, or in the only warning; "" for a load without one
    std::size_t scene_voxels;  // of the loaded scene's models
};

// SOURCES.md lets some files be either refused or repaired; this table is the choice. A file is refused if it
// cannot be shown as its author meant it, and repaired if only a part is lost, which is named.
const MalformedRow kMalformed[] = {
    {"chunk_size_negative.vox", Decision::load, "at byte 72: 32 bytes after MAIN are ignored", 3},
    {"dict_count_huge.vox", Decision::refuse,
     "at byte 88: nTRN holds 2147483647 attributes but the chunk has room for 1", 0},
    {"index_zero_and_duplicates.vox", Decision::load, "model 0: ", 1},
    {"instances_10_pow_7.vox", Decision::refuse, "the scene graph expands to more than 4194304 nodes", 0},
    {"model_id_out_of_range.vox", Decision::load, "skipped", 0},
    {"node_chain_60000_deep.vox", Decision::load, "", 3},
    {"node_cycle.vox", Decision::refuse, "the scene graph has a cycle", 0},
    {"not_a.vox", Decision::refuse, "at byte 0: not a .vox file", 0},
    {"rgba_short_84_bytes.vox", Decision::load, "RGBA has 84 bytes, not 1024", 3},
    {"rotation_byte_bad.vox", Decision::refuse, "rotation 5: rows 1 and 2 name columns 1 and 1", 0},
    {"size_overflow_65536.vox", Decision::refuse, "SIZE has a side of 65536, which must be from 1 to 256", 0},
    {"size_zero.vox", Decision::refuse, "SIZE has a side of 0, which must be from 1 to 256", 0},
    {"trailing_garbage.vox", Decision::load, "at byte 1248: 66 bytes after MAIN are ignored", 3},
    {"truncated_in_xyzi.vox", Decision::refuse, "at byte 8: MAIN says 0 + 1088 bytes but the file has 36", 0},
    {"voxel_outside_size.vox", Decision::load, "voxels outside its size are ignored", 2},
    {"xyzi_before_size.vox", Decision::refuse, "XYZI without a SIZE before it", 0},
    {"xyzi_count_past_chunk.vox", Decision::refuse, "XYZI holds 1000000 voxels but the chunk has room for 3",
     0},
};

std::size_t model_voxels(const Scene& scene) {
    std::size_t voxels = 0;
    for (const VoxelModel& model : scene.models)
        voxels += model.voxels.size();
    return voxels;
}

void check_malformed(const MalformedRow& row, std::span<const std::byte> bytes) {
    const auto file = read_vox(bytes);
    EXPECT_EQ(file.ok(), row.decision == Decision::load) << (file ? "loaded" : file.reason());
    if (!file) {
        EXPECT_TRUE(file.reason().starts_with("at byte ")) << file.reason();
        EXPECT_NE(file.reason().find(row.text), std::string::npos) << file.reason();
        return;
    }
    const auto& warnings = file.value().warnings;
    EXPECT_EQ(warnings.empty(), *row.text == '\0');
    if (!warnings.empty()) {
        EXPECT_NE(warnings.front().find(row.text), std::string::npos) << warnings.front();
    }
    EXPECT_EQ(model_voxels(scene_from_vox(file.value())), row.scene_voxels);
    EXPECT_TRUE(summarize(file.value()).ok());
}

TEST(VoxExternal, malformed_files_are_refused_or_loaded_as_decided) {
    SKIP_WITHOUT_SHARED_DATA();
    std::set<std::string> unseen;
    for (const auto& entry :
         std::filesystem::directory_iterator(shared_data() / "data" / "malformed" / "vox"))
        unseen.insert(entry.path().filename().string());
    for (const MalformedRow& row : kMalformed) {
        SCOPED_TRACE(row.file);
        ASSERT_EQ(unseen.erase(row.file), 1u);
        const auto bytes = read_file(shared_data() / "data" / "malformed" / "vox" / row.file);
        const PeakAllocation peak;
        const auto start = std::chrono::steady_clock::now();
        check_malformed(row, bytes);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        EXPECT_LE(peak.bytes(), kFreeFileBytes + kHeapPerByte * bytes.size());
        EXPECT_LE(taken.count(), kSecondsToRefuse);
    }
    EXPECT_TRUE(unseen.empty()) << *unseen.begin() << " has no decision";
}

TEST(VoxExternal, malformed_comparator_sees_a_wrong_decision) {
    SKIP_WITHOUT_SHARED_DATA();
    const auto bytes = read_file(shared_data() / "data" / "malformed" / "vox" / "node_cycle.vox");
    const auto file = read_vox(bytes);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.reason().find("SIZE"), std::string::npos);
    EXPECT_THROW((void)load_vox(shared_data() / "data" / "malformed" / "vox" / "node_cycle.vox"), Error);
}

}  // namespace
}  // namespace voxilux
