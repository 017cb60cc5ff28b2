// Untruthful files: each is refused with a reason that names the place, within a memory bound.

#include <gtest/gtest.h>

#include <functional>

#include "support/allocation_counter.h"
#include "support/gltf_builder.h"
#include "voxelizer/decode_image.h"
#include "voxelizer/load_gltf.h"

namespace voxilux {
namespace {

using gltf_builder::bytes_of;
using gltf_builder::File;
using gltf_builder::json;
using gltf_builder::textured_square;

// The refusal_of_hostile, or "" for a file that is read.
std::string refusal_of_hostile(const std::string& bytes) {
    MeshNotes notes;
    try {
        (void)load_gltf(std::as_bytes(std::span(bytes)), "no-such-folder", {}, notes);
        return "";
    } catch (const MeshFault& fault) {
        return fault.what();
    }
}

struct Lie {
    const char* words;  // of the refusal_of_hostile
    std::function<void(json&)> tell;
};

// textured_square(): views and accessors 0 positions, 1 indices, 2 coordinates; view 3 the image.
const Lie kLies[] = {
    {"accessors[0] reaches past its view", [](json& r) { r["accessors"][0]["count"] = 5; }},
    {"elements; at most", [](json& r) { r["accessors"][0]["count"] = 9007199254740991; }},
    {"is not a whole number from 0 to 2^53",
     [](json& r) { r["accessors"][0]["count"] = 18446744073709551615u; }},
    {"is not a whole number", [](json& r) { r["accessors"][0]["count"] = -4; }},
    {"is not a whole number", [](json& r) { r["accessors"][0]["count"] = 1.5; }},
    {"accessors[0].count is not a number", [](json& r) { r["accessors"][0]["count"] = "4"; }},
    {"accessors[0].count is missing", [](json& r) { r["accessors"][0].erase("count"); }},
    {"reaches past its view", [](json& r) { r["accessors"][0]["byteOffset"] = 4; }},
    {"reaches past its view", [](json& r) { r["accessors"][0]["byteOffset"] = 9007199254740991; }},
    {"reaches past its view", [](json& r) { r["bufferViews"][0]["byteStride"] = 252; }},
    {"byteStride 1099511627776 does not fit",
     [](json& r) { r["bufferViews"][0]["byteStride"] = 1099511627776; }},
    {"byteStride 8 does not fit", [](json& r) { r["bufferViews"][0]["byteStride"] = 8; }},
    {"bufferViews[0] reaches byte", [](json& r) { r["bufferViews"][0]["byteLength"] = 9007199254740991; }},
    {"bufferViews[0] reaches byte", [](json& r) { r["bufferViews"][0]["byteOffset"] = 9007199254740991; }},
    {"names buffers[1], but there are 1", [](json& r) { r["bufferViews"][0]["buffer"] = 1; }},
    {"names bufferViews[4], but there are 4", [](json& r) { r["accessors"][0]["bufferView"] = 4; }},
    {"names accessors[9], but there are 3",
     [](json& r) { r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }},
    {"should have 1000000 bytes", [](json& r) { r["buffers"][0]["byteLength"] = 1000000; }},
    {"componentType 5124 is not one", [](json& r) { r["accessors"][0]["componentType"] = 5124; }},
    {"type is none of", [](json& r) { r["accessors"][0]["type"] = "MAT4"; }},
    {"but is not VEC3", [](json& r) { r["accessors"][0]["type"] = "VEC2"; }},
    {"is not an unsigned SCALAR", [](json& r) { r["accessors"][1]["componentType"] = 5122; }},
    {"has 3 elements for 4 vertices", [](json& r) { r["accessors"][2]["count"] = 3; }},
    {"element 2 names vertex 2 of 2",
     [](json& r) { r["accessors"][0]["count"] = r["accessors"][2]["count"] = 2; }},
    {"holds positions, but has no data", [](json& r) { r["accessors"][0].erase("bufferView"); }},
    {"KHR_draco_mesh_compression, which is not read",
     [](json& r) {
         r["accessors"][0].erase("bufferView");
         r["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = json::object();
     }},
    {"needs the extension 'KHR_draco_mesh_compression'",
     [](json& r) {
         r["extensionsRequired"] = {"KHR_texture_transform", "KHR_draco_mesh_compression"};
     }},
    {"needs the extension 'KHR_texture_basisu'",
     [](json& r) { r["extensionsRequired"] = {"KHR_texture_basisu"}; }},
    {"mode 7 is not one", [](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 7; }},
    {"nodes[0] is reached twice", [](json& r) { r["nodes"][0]["children"] = {0}; }},
    {"nodes[2] is reached twice",
     [](json& r) {
         r["nodes"] = {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}};
     }},
    {"nodes[0] is reached twice",
     [](json& r) {
         r["scenes"][0]["nodes"] = {0, 0};
     }},
    {"names nodes[7], but there are 1", [](json& r) { r["nodes"][0]["children"] = {7}; }},
    {"names scenes[1], but there are 1", [](json& r) { r["scene"] = 1; }},
    {"nodes[0].matrix has 15 numbers, not 16",
     [](json& r) { r["nodes"][0]["matrix"] = std::vector<int>(15, 1); }},
    {"nodes[0].rotation is zero",
     [](json& r) {
         r["nodes"][0]["rotation"] = {0, 0, 0, 0};
     }},
    {"nodes[0].scale is not a number",
     [](json& r) {
         r["nodes"][0]["scale"] = {1, nullptr, 1};
     }},
    {"nodes[0] is not an object", [](json& r) { r["nodes"][0] = 3; }},
    {"accessors is not an array",
     [](json& r) {
         r["accessors"] = {{"a", 1}};
     }},
    {"alphaMode is none of", [](json& r) { r["materials"][0]["alphaMode"] = "GLASS"; }},
    {"wrapS is not a wrap mode",
     [](json& r) {
         r["samplers"] = {{{"wrapS", 1}}};
         r["textures"][0]["sampler"] = 0;
     }},
    {"glTF '1.0' is not read", [](json& r) { r["asset"]["version"] = "1.0"; }},
    {"asset.version is missing", [](json& r) { r.erase("asset"); }},
    {"numbers from 2^31 on", [](json& r) { r["meshes"][0]["primitives"][0]["indices"] = 4294967297; }},
    {"bufferView is not a whole number", [](json& r) { r["images"][0]["bufferView"] = -1; }},
    {"images[0].bufferView names bufferViews[4]", [](json& r) { r["images"][0]["bufferView"] = 4; }},
    {"bufferViews[3] reaches byte", [](json& r) { r["bufferViews"][3]["byteOffset"] = 100000; }},
    {"bufferViews[3], which images[0] reads, is empty",
     [](json& r) { r["bufferViews"][3]["byteLength"] = 0; }},
    {"holds indices, but has no bufferView", [](json& r) { r["accessors"][1].erase("bufferView"); }},
    {"not valid glTF: Unsupported `type`", [](json& r) { r["accessors"][0]["type"] = "VEC5"; }},
    {"the buffers have over", [](json& r) { r["buffers"][0]["byteLength"] = 9007199254740991; }},
    {"buffers[0].byteLength is 0", [](json& r) { r["buffers"][0]["byteLength"] = 0; }},
};

std::string told(const Lie& lie) {
    File file = textured_square();
    file.root = file.with_buffer(true);
    lie.tell(file.root);
    return file.gltf();
}

TEST(HostileGltf, every_lie_is_refused_by_name) {
    for (const Lie& lie : kLies) {
        const std::string text = told(lie);
        const PeakAllocation peak;
        const std::string reason = refusal_of_hostile(text);
        EXPECT_NE(reason.find(lie.words), std::string::npos) << lie.words << "\n" << reason;
        EXPECT_LT(peak.bytes(), std::size_t{1} << 20) << lie.words;
    }
    EXPECT_EQ(refusal_of_hostile(told({"", [](json&) {}})), "") << "the file without a lie is read";
}

// A square whose last corner is sparse, with a change.
std::string sparse_refusal(const std::function<void(json&)>& tell) {
    File file;
    const int view = file.view(bytes_of(gltf_builder::kSquare));
    const int places = file.view(bytes_of(std::vector<std::uint16_t>{3}));
    const int values = file.view(bytes_of(std::vector<float>{0, 1, 0}));
    json sparse = {{"count", 1},
                   {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                   {"values", {{"bufferView", values}}}};
    tell(sparse);
    file.primitive({{"POSITION", file.accessor(view, 5126, "VEC3", 4, {{"sparse", sparse}})}}, {{"mode", 6}});
    return refusal_of_hostile(file.glb());
}

TEST(HostileGltf, sparse_blocks_that_lie_are_refused) {
    EXPECT_EQ(sparse_refusal([](json&) {}), "");
    const auto holds = [](const std::string& text, const char* words) {
        return text.find(words) != std::string::npos;
    };
    EXPECT_TRUE(holds(sparse_refusal([](json& s) { s["count"] = 2; }), "indices reaches past its view"));
    EXPECT_TRUE(holds(sparse_refusal([](json& s) { s["count"] = 5; }), "above that of its accessor"));
    EXPECT_TRUE(holds(sparse_refusal([](json& s) {
                          s["indices"].update({{"bufferView", 0}, {"byteOffset", 14}});
                      }),
                      "names element"));
    EXPECT_TRUE(
        holds(sparse_refusal([](json& s) { s["indices"]["componentType"] = 5126; }), "is not unsigned"));
    EXPECT_TRUE(holds(sparse_refusal([](json& s) { s["values"]["byteOffset"] = 4; }),
                      "values reaches past its view"));
    EXPECT_TRUE(holds(sparse_refusal([](json& s) { s.erase("values"); }), "values.bufferView is missing"));
}

TEST(HostileGltf, buffers_outside_the_folder_are_refused) {
    const auto with = [](const std::string& uri) {
        File file = gltf_builder::square();
        file.root["buffers"] = {{{"byteLength", 60}, {"uri", uri}}};
        return refusal_of_hostile(file.gltf());
    };
    for (const char* uri : {"../a.bin", "a/../../b.bin", "%2e%2e/a.bin", "..%2Fa.bin"})
        EXPECT_NE(with(uri).find("leaves the folder"), std::string::npos) << uri;
    for (const char* uri :
         {"/etc/passwd", "file:///etc/passwd", "http://a/b", "%2Fetc%2Fpasswd", "", "..\\a.bin"})
        EXPECT_NE(with(uri).find("is not a path relative"), std::string::npos) << uri;
    for (const char* uri : {"a%2", "a%zz", "%"})
        EXPECT_NE(with(uri).find("broken %"), std::string::npos) << uri;
    EXPECT_NE(with("a%00.bin").find("zero byte"), std::string::npos);
    EXPECT_NE(with("gone.bin").find("cannot open"), std::string::npos);
    EXPECT_NE(with("data:application/octet-stream;base64,AAA!").find("breaks at character 3"),
              std::string::npos);
    EXPECT_NE(with("data:application/octet-stream;base64,AAAAA").find("cut off"), std::string::npos);
    EXPECT_NE(with("data:text/plain,AAAA").find("not base64"), std::string::npos);
}

TEST(HostileGltf, every_cut_of_a_binary_file_is_refused) {
    const std::string whole = textured_square().glb();
    EXPECT_EQ(refusal_of_hostile(whole), "");
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_NE(refusal_of_hostile(whole.substr(0, size)), "") << size;
}

TEST(HostileGltf, every_changed_byte_is_read_or_refused) {
    const std::string whole = textured_square().glb();
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const char flip : {'\x01', '\x40', '\x80'}) {
            std::string changed = whole;
            changed[at] = static_cast<char>(changed[at] ^ flip);
            (void)refusal_of_hostile(changed);
        }
    }
}

TEST(HostileGltf, deep_json_is_refused_without_recursion) {
    constexpr std::size_t kDepth = 300000;
    const std::string deep = std::string(kDepth, '[') + std::string(kDepth, ']');
    EXPECT_EQ(refusal_of_hostile("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep + "}"), "");
    EXPECT_NE(refusal_of_hostile(deep), "");
    EXPECT_EQ(refusal_of_hostile("{\"a\":1e999}"), "not valid JSON: a number is too large");
}

TEST(HostileGltf, long_lists_of_tiny_items_take_memory_in_proportion_and_have_a_limit) {
    const std::pair<const char*, json> tiny[] = {
        {"scenes", json::object()},
        {"nodes", json::object()},
        {"cameras", json::object()},
        {"meshes", json::object()},
        {"materials", json::object()},
        {"textures", json::object()},
        {"images", json::object()},
        {"samplers", json::object()},
        {"animations", json::object()},
        {"skins", json::object()},
        {"accessors", {{"type", "VEC3"}, {"count", 1}, {"componentType", 5126}}},
        {"meshes", {{"primitives", std::vector<json>(3, {{"attributes", json::object()}})}}},
        {"materials", {{"extensions", {{"KHR_materials_ior", json::object()}}}}}};
    for (const auto& [key, item] : tiny) {
        File file = textured_square();
        file.root[key] = std::vector<json>(20000, item);
        const std::string bytes = file.glb();
        const PeakAllocation peak;
        (void)refusal_of_hostile(bytes);
        EXPECT_LT(peak.bytes(), 1024 * bytes.size()) << key;
    }
    File file = textured_square();
    file.root["materials"] = std::vector<json>(65537, json::object());
    EXPECT_EQ(refusal_of_hostile(file.glb()), "materials has 65537 items; at most 65536 are read");
}

TEST(HostileGltf, image_of_a_giant_size_is_left_out_before_it_is_decoded) {
    File file = textured_square();
    std::string png = gltf_builder::small_png();
    png.replace(16, 8, std::string("\x00\x00\x40\x00\x00\x00\x40\x00", 8));
    file.root["images"][0]["bufferView"] = file.view(png);
    MeshNotes notes;
    const std::string bytes = file.glb();
    const PeakAllocation peak;
    const Mesh mesh = load_gltf(std::as_bytes(std::span(bytes)), "", {}, notes);
    EXPECT_LT(peak.bytes(), std::size_t{1} << 20);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes.begin()->first.find("16384 x 16384 texels"), std::string::npos) << notes.begin()->first;
}

// The bits of a deflate stream, from the lowest of each byte (RFC 1951).
struct Bits {
    std::string bytes;
    int used = 8;
    void put(unsigned value, int count) {  // the lowest bit of `value` first
        for (int i = 0; i < count; ++i) {
            if (used == 8) {
                bytes += '\0';
                used = 0;
            }
            bytes.back() = static_cast<char>(bytes.back() | static_cast<char>((value >> i & 1u) << used++));
        }
    }
};

// A PNG of 2 x 2 texels that unpacks into 1 + 258 * matches bytes.
std::string bomb(int matches) {
    Bits bits;
    bits.put(0x0178, 16);     // zlib's header
    bits.put(0b011, 3);       // the last block, with the fixed codes
    bits.put(0b00001100, 8);  // a zero
    for (int i = 0; i < matches; ++i) {
        bits.put(0b10100011, 8);  // length 258
        bits.put(0, 5);           // from one byte before
    }
    bits.put(0, 7);  // the end
    const auto big_endian = [](std::size_t value) {
        return std::string{static_cast<char>(value >> 24), static_cast<char>(value >> 16),
                           static_cast<char>(value >> 8), static_cast<char>(value)};
    };
    const std::string png = gltf_builder::small_png();
    return png.substr(0, 33) + big_endian(bits.bytes.size()) + "IDAT" + bits.bytes + "crc " +
           png.substr(png.size() - 12);
}

TEST(HostileImage, picture_that_unpacks_into_far_more_than_its_size_is_refused) {
    const auto is_decoded = [](const std::string& png) {
        return decode_image(std::as_bytes(std::span(png))).has_value();
    };
    EXPECT_TRUE(is_decoded(bomb(4)));
    EXPECT_FALSE(is_decoded(bomb(100000)));
}

TEST(HostileImage, jpeg_of_too_many_scans_is_refused_before_they_are_read) {
    // A grey progressive JPEG of 8 x 8 texels whose scans hold nothing.
    const auto jpeg = [](int scans) {
        std::string bytes("\xFF\xD8\xFF\xC2\x00\x0B\x08\x00\x08\x00\x08\x01\x01\x11\x00", 15);
        bytes += std::string("\xFF\xDB\x00\x43\x00", 5) + std::string(64, '\x01');
        bytes += std::string("\xFF\xC4\x00\x14\x00\x01", 6) + std::string(15, '\0') + std::string(1, '\0');
        for (int i = 0; i < scans; ++i)
            bytes += std::string("\xFF\xDA\x00\x08\x01\x01\x00\x00\x00\x00\x00", 11);
        return bytes + "\xFF\xD9";
    };
    const auto is_decoded = [&](int scans) {
        const std::string bytes = jpeg(scans);
        return decode_image(std::as_bytes(std::span(bytes))).has_value();
    };
    EXPECT_TRUE(is_decoded(3));
    EXPECT_FALSE(is_decoded(65));
}

TEST(HostileGltf, many_nodes_on_one_mesh_stop_at_the_limits) {
    File file = textured_square();
    json nodes = json::array(), roots = json::array();
    for (int i = 0; i < 100; ++i) {
        nodes.push_back({{"mesh", 0}});
        roots.push_back(i);
    }
    file.root["nodes"] = nodes;
    file.root["scenes"][0]["nodes"] = roots;
    const std::string bytes = file.glb();
    const auto with = [&](const MeshLimits& limits) {
        MeshNotes notes;
        try {
            return std::to_string(
                load_gltf(std::as_bytes(std::span(bytes)), "", {.limits = limits}, notes).triangles.size());
        } catch (const MeshFault& fault) {
            return std::string(fault.what());
        }
    };
    EXPECT_EQ(with({}), "200");
    EXPECT_EQ(with({.vertices = 399}), "over 399 vertices are not read");
    EXPECT_EQ(with({.triangles = 199}), "over 199 triangles are not read");
    EXPECT_EQ(with({.parts = 99}), "over 99 parts of meshes are not read");
    EXPECT_EQ(with({.vertices = 400, .triangles = 200, .parts = 100}), "200");
}

}  // namespace
}  // namespace voxilux
