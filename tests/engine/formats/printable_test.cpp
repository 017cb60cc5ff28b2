// Text of a file on its way to a terminal: the function, and every reader with hostile names.

#include "base/printable.h"

#include <gtest/gtest.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <fstream>
#include <functional>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "formats/exr.h"
#include "formats/png.h"
#include "formats/scene_toml.h"
#include "formats/vox_info.h"
#include "formats/vox_read.h"
#include "scene/vox_material.h"
#include "support/scratch_folder.h"
#include "support/vox_builder.h"

namespace voxilux {
namespace {

// What a terminal, JSON and a reader can take, decided by other means than the code under test: printable
// ASCII, or well-formed UTF-8 outside the C1 and bidirectional controls.
bool is_harmless(const std::string& text, bool has_lines = false) {
    if (text.size() > 4 * 1000) return false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (c == '\n' && has_lines) continue;  // between lines of ours
        if (c < 0x20 || c == 0x7F || c > 0xF4) return false;
        if (c < 0x80) continue;
        if (c < 0xC2) return false;
        const int more = c >= 0xF0 ? 3 : c >= 0xE0 ? 2 : 1;
        const int next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
        if ((c == 0xC2 && next < 0xA0) || (c == 0xED && next >= 0xA0))
            return false;  // C1 controls, surrogates
        if (text.compare(i, 3, "\u202e") == 0) return false;
        for (int k = 0; k < more; ++k) {
            if (++i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return false;
        }
    }
    return true;
}

const std::string kTitle = "\x1b]0;pwned\x07";
const std::vector<std::string> kHostile = {kTitle,
                                           "a\nvoxilux: all is well",
                                           "\x9b[2J",
                                           "\xc2\x9b[2J",
                                           "\xff\xfe",
                                           "\xed\xa0\x80",
                                           "\xc0\x80",
                                           "a\u202eb",
                                           "\x7f",
                                           "cut \xe2\x82",
                                           std::string(100000, 'x'),
                                           std::string(50000, '\x01')};

TEST(Printable, plain_text_of_any_language_stays) {
    for (const std::string text : {"plain", "C:\\a b\\c.png", "Grüße", "材料 1", "𝄞", ""})
        EXPECT_EQ(printable(text), text);
    EXPECT_EQ(quoted_name("it"), "'it'");
}

TEST(Printable, control_characters_and_broken_bytes_are_escaped) {
    EXPECT_EQ(printable(kTitle), "\\x1b]0;pwned\\x07");
    EXPECT_EQ(printable("\xc2\x9b"), "\\u{9b}");
    EXPECT_EQ(printable("a\u202eb"), "a\\u{202e}b");
    EXPECT_EQ(printable("\xff\xc3("), "\\xff\\xc3(");
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
    EXPECT_EQ(printable("\xc0\x80\xe0\x80\x80\xf4\x90\x80\x80"),
              "\\xc0\\x80\\xe0\\x80\\x80\\xf4\\x90\\x80\\x80")
        << "overlong forms, and beyond the last code point";
}

TEST(Printable, long_text_is_cut_to_300_characters) {
    EXPECT_EQ(printable(std::string(300, 'x')), std::string(300, 'x'));
    EXPECT_EQ(printable(std::string(301, 'x')), std::string(297, 'x') + "...");
    std::string greek, cut;
    for (int i = 0; i < 400; ++i)
        greek += "λ";
    for (int i = 0; i < 297; ++i)
        cut += "λ";
    EXPECT_EQ(printable(greek), cut + "...");
    EXPECT_LE(printable(std::string(400, '\x01')).size(), 300u);
    EXPECT_EQ(printable(std::string(400, 'x'), kUncut).size(), 400u);
}

TEST(Printable, second_pass_changes_nothing_and_the_check_sees_raw_text) {
    for (const std::string& text : kHostile) {
        EXPECT_FALSE(is_harmless(text)) << printable(text, 40);
        EXPECT_TRUE(is_harmless(printable(text)));
        EXPECT_TRUE(is_harmless(quoted_name(text)));
        EXPECT_EQ(printable(printable(text)), printable(text));
    }
}

std::string refusal_of(const std::function<void()>& action) {
    try {
        action();
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

std::span<const std::byte> hostile_bytes(const std::string& text) {
    return std::as_bytes(std::span(text));
}

TEST(HostileNames, of_chunks_attributes_and_types_of_a_vox_file) {
    using namespace vox_builder;
    for (const std::string& name : kHostile) {
        const std::string model = size_chunk(1, 1, 1) + voxels_chunk({{0, 0, 0, 1}});
        const std::string id = (name + "    ").substr(0, 4);
        const auto refused =
            read_vox(hostile_bytes(file_text(model + transform(0, 1, -1, {{{"_r", name}}}))));
        ASSERT_FALSE(refused.ok());
        EXPECT_TRUE(is_harmless(refused.reason())) << printable(refused.reason());
        EXPECT_TRUE(is_harmless(read_vox(hostile_bytes(file_text(id + i32(9) + i32(9)))).reason()));
        const auto file = read_vox(hostile_bytes(file_text(
            model + chunk(id, "") + record("MATL", 1, {{"_type", name}, {"_rough", name}, {name, name}}))));
        ASSERT_TRUE(file.ok()) << file.reason();
        const auto info = summarize(file.value());
        ASSERT_TRUE(info.ok());
        EXPECT_TRUE(is_harmless(describe(info.value()), true));
        EXPECT_TRUE(is_harmless(to_json(info.value()).dump()));
        std::vector<std::string> warnings;
        (void)vox_materials(file.value(), warnings);
        EXPECT_FALSE(warnings.empty());
        for (const std::string& warning : warnings)
            EXPECT_TRUE(is_harmless(warning)) << printable(warning);
    }
}

// An EXR with one channel of this name, and an attribute.
std::string exr_file(const std::filesystem::path& path, const std::string& name, int sampling) {
    Imf::Header header(2, 2);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT, sampling, sampling));
    header.insert("comments", Imf::StringAttribute(name));
    float pixels[4] = {1, 2, 3, 4};
    Imf::FrameBuffer frame;
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, pixels, Imath::V2i(0, 0), 2, 2, std::size_t{0},
                                        std::size_t{0}, sampling, sampling));
    Imf::OutputFile file(path.string().c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2 / sampling * sampling);
    return path.string();
}

TEST(HostileNames, of_channels_of_an_exr) {
    const ScratchFolder folder;
    for (const std::string& hostile : kHostile) {
        const std::string name = hostile.substr(0, 200);  // the format allows up to 255
        const Image image = read_exr(exr_file(folder / "a.exr", name, 1));
        ASSERT_EQ(image.channels.size(), 1u);
        EXPECT_TRUE(is_harmless(image.channels.begin()->first)) << image.channels.begin()->first;
        EXPECT_EQ(image.channels.begin()->second.pixels, (std::vector<float>{1, 2, 3, 4}));
        const std::string refusal = refusal_of([&] { (void)read_exr(exr_file(folder / "b.exr", name, 2)); });
        EXPECT_NE(refusal.find("is subsampled"), std::string::npos) << refusal;
        EXPECT_TRUE(is_harmless(refusal)) << refusal;
    }
}

TEST(HostileNames, of_what_calls_itself_an_image) {
    for (const std::string& name : kHostile) {
        const std::string png = std::string("\x89PNG\r\n\x1a\n") + name;
        EXPECT_TRUE(is_harmless(refusal_of([&] { (void)decode_png(hostile_bytes(png), "a.png"); })));
        const std::string exr = "\x76\x2f\x31\x01" + std::string("\x02\x00\x00\x00", 4) + name;
        const std::string refusal = refusal_of([&] { (void)decode_exr(hostile_bytes(exr), "a.exr"); });
        EXPECT_FALSE(refusal.empty());
        EXPECT_TRUE(is_harmless(refusal)) << refusal;
    }
}

TEST(HostileNames, of_keys_and_texts_of_a_scene) {
    const ScratchFolder folder;
    for (const std::string key : {"\\u001b]0;pwned\\u0007", "\\u009b[2J", "a\\u202eb", "\\u007f"}) {
        for (const std::string& text : {"\"" + key + "\" = 1\n", "[render]\nsequence = \"" + key + "\"\n",
                                        "[vox]\nfile = \"" + key + ".vox\"\n"}) {
            std::ofstream(folder / "s.toml") << text;
            const std::string refusal = refusal_of([&] { (void)load_scene(folder / "s.toml"); });
            EXPECT_FALSE(refusal.empty()) << text;
            EXPECT_TRUE(is_harmless(refusal)) << refusal;
        }
    }
}

}  // namespace
}  // namespace voxilux
