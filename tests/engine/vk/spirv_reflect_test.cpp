#include "vk/spirv_reflect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <string_view>

#include "base/assert.h"
#include "embedded.h"
#include "support/source_tree.h"

namespace voxilux {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::uint32_t>;

// A module assembled by hand, instruction by instruction (SPIR-V specification, section 3).
struct Assembler {
    Words words{0x07230203u, 0x00010500u, 0u, 100u, 0u};

    Assembler& op(std::uint32_t number, std::initializer_list<std::uint32_t> operands,
                  std::string_view text = {}) {
        const std::size_t start = words.size();
        words.push_back(0);
        words.insert(words.end(), operands);
        for (std::size_t i = 0; !text.empty() && i <= text.size(); i += 4) {
            std::uint32_t word = 0;
            for (std::size_t byte = 0; byte < 4 && i + byte < text.size(); ++byte)
                word |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[i + byte])) << (8 * byte);
            words.push_back(word);
        }
        words[start] = static_cast<std::uint32_t>(words.size() - start) << 16 | number;
        return *this;
    }
};

constexpr std::uint32_t kName = 5, kMemberName = 6, kEntryPoint = 15, kExecutionMode = 16, kTypeInt = 21,
                        kTypeImage = 25, kTypeRuntimeArray = 29, kTypeStruct = 30, kTypePointer = 32,
                        kConstant = 43, kForwardPointer = 39, kSpecConstant = 50, kSpecComposite = 51,
                        kVariable = 59, kLoad = 61, kDecorate = 71, kMemberDecorate = 72;
constexpr std::uint32_t kStorageBuffer = 12, kPushConstant = 9, kPhysical = 5349, kUniformConstant = 0;

constexpr std::uint32_t kPhysicalAddresses = 5347;  // capability

const EmbeddedShader& probe(std::string_view name) {
    return *std::ranges::find(probe_shaders(), name, &EmbeddedShader::name);
}

// Block "Items" { uint first; uint rest[]; } at binding 3, read only by its members; local size (16, 4, 1).
Assembler small_module() {
    Assembler module;
    module.op(kEntryPoint, {5, 1}, "main").op(kExecutionMode, {1, 17, 16, 4, 1});
    module.op(kName, {10}, "Items").op(kMemberName, {10, 0}, "first").op(kMemberName, {10, 1}, "rest");
    module.op(kDecorate, {20, 33, 3}).op(kDecorate, {20, 34, 0}).op(kDecorate, {12, 6, 4});
    module.op(kMemberDecorate, {10, 0, 35, 0}).op(kMemberDecorate, {10, 1, 35, 4});
    module.op(kMemberDecorate, {10, 0, 24}).op(kMemberDecorate, {10, 1, 24});
    module.op(kTypeInt, {11, 32, 0}).op(kTypeRuntimeArray, {12, 11}).op(kTypeStruct, {10, 11, 12});
    module.op(kTypePointer, {13, kStorageBuffer, 10}).op(kVariable, {13, 20, kStorageBuffer});
    return module;
}

Words with_use(Assembler module) {
    return module.op(kLoad, {11, 50, 20}).words;
}

TEST(Reflect, block_is_found_by_name_with_its_access) {
    const ProgramInfo info = reflect(with_use(small_module()));
    ASSERT_EQ(info.blocks.size(), 1u);
    EXPECT_EQ(info.blocks[0].name, "Items");
    EXPECT_EQ(info.blocks[0].binding, 3u);
    EXPECT_TRUE(info.blocks[0].readable);
    EXPECT_FALSE(info.blocks[0].writable);
    const StructInfo* items = info.find_struct("Items");
    ASSERT_NE(items, nullptr);
    EXPECT_EQ(items->members, (std::vector<StructMember>{{"first", 0}, {"rest", 4}}));
    EXPECT_EQ(info.find_block("items"), nullptr);
}

TEST(Reflect, block_is_writable_unless_all_members_say_no) {
    Assembler module = small_module();
    const auto is_second_non_writable = [](const Words& words, std::size_t at) {
        return words[at] == (4u << 16 | kMemberDecorate) && words[at + 2] == 1 && words[at + 3] == 24;
    };
    for (std::size_t at = 5; at + 3 < module.words.size(); at += module.words[at] >> 16) {
        if (is_second_non_writable(module.words, at)) module.words[at + 3] = 23;  // Coherent
    }
    EXPECT_TRUE(reflect(with_use(module)).blocks[0].writable);
}

TEST(Reflect, unused_block_needs_no_buffer) {
    EXPECT_TRUE(reflect(small_module().words).blocks.empty());
}

TEST(Reflect, local_size_is_fixed_or_specialized) {
    const ProgramInfo fixed = reflect(small_module().words);
    EXPECT_EQ(fixed.local_size[0].size, 16u);
    EXPECT_EQ(fixed.local_size[1].size, 4u);
    EXPECT_FALSE(fixed.local_size[0].spec_id.has_value());

    Assembler module = small_module();
    module.op(kDecorate, {30, 1, 77}).op(kDecorate, {33, 11, 25});
    module.op(kSpecConstant, {11, 30, 32}).op(kConstant, {11, 31, 2});
    module.op(kSpecComposite, {14, 33, 30, 31, 31});
    const ProgramInfo info = reflect(module.words);
    EXPECT_EQ(info.local_size[0].size, 32u);
    EXPECT_EQ(info.local_size[0].spec_id, 77u);
    EXPECT_EQ(info.local_size[1].size, 2u);
    EXPECT_FALSE(info.local_size[1].spec_id.has_value());
}

// Constants "a" and "b" of the given numbers.
Assembler module_with_constants(std::uint32_t a, std::uint32_t b) {
    Assembler module = small_module();
    module.op(kName, {90}, "a").op(kName, {91}, "b").op(kDecorate, {90, 1, a}).op(kDecorate, {91, 1, b});
    return module.op(kSpecConstant, {11, 90, 5}).op(kSpecConstant, {11, 91, 6});
}

TEST(Reflect, constants_that_share_a_number_are_refused) {
    const ProgramInfo info = reflect(module_with_constants(3, 4).words);
    EXPECT_EQ(info.find_constant("a")->id, 3u);
    EXPECT_EQ(info.find_constant("b")->default_value, 6u);
    EXPECT_THROW((void)reflect(module_with_constants(3, 3).words), InternalError);
}

// The build numbers constants by their names, so that no shader picks a number that another has.
std::vector<std::string> numbers_by_hand(const std::string& shader) {
    static const test::Pattern by_hand("constant_id *= *[0-9]+");
    std::vector<std::string> found;
    for (const std::string& line : test::lines_of(shader))
        if (!by_hand.find(line).empty()) found.push_back(line);
    return found;
}

TEST(ConstantNumbers, no_shader_picks_one) {
    int shaders = 0;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(VX_SOURCE_DIR) / "shaders")) {
        const auto extension = entry.path().extension();
        if (extension != ".comp" && extension != ".glsl") continue;
        ++shaders;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        EXPECT_TRUE(numbers_by_hand(text.str()).empty()) << entry.path();
    }
    EXPECT_GT(shaders, 50);
    EXPECT_EQ(numbers_by_hand("layout(constant_id = 3) const uint a = 1u;").size(), 1u);
}

// One name has one number in all shaders, and none is that of a local size.
TEST(ConstantNumbers, name_and_number_belong_together) {
    std::map<std::string, std::uint32_t> number_of;
    std::map<std::uint32_t, std::string> name_of;
    for (const auto shaders : {pass_shaders(), probe_shaders()}) {
        for (const EmbeddedShader& shader : shaders) {
            for (const SpecConstant& constant : reflect(shader.spirv).constants) {
                if (constant.name.empty()) continue;
                EXPECT_EQ(number_of.emplace(constant.name, constant.id).first->second, constant.id);
                EXPECT_EQ(name_of.emplace(constant.id, constant.name).first->second, constant.name);
                EXPECT_LT(constant.id, 100u) << constant.name;
            }
        }
    }
    EXPECT_GT(number_of.size(), 20u);
}

TEST(Reflect, push_struct_has_its_size_and_members) {
    Assembler module = small_module();
    module.op(kMemberName, {40, 0}, "count").op(kMemberName, {40, 1}, "scale");
    module.op(kMemberDecorate, {40, 0, 35, 0}).op(kMemberDecorate, {40, 1, 35, 12});
    module.op(kTypeStruct, {40, 11, 11}).op(kTypePointer, {41, kPushConstant, 40});
    module.op(kVariable, {41, 42, kPushConstant}).op(kLoad, {40, 51, 42});
    const ProgramInfo info = reflect(module.words);
    EXPECT_EQ(info.push_bytes, 16u);
    EXPECT_EQ(info.push_members, (std::vector<StructMember>{{"count", 0}, {"scale", 12}}));
}

// Pointers to readonly block "Words" (id 70) and to plain block "Sums" (id 80); the push struct (id 40) has
// the given members at the given offsets.
Assembler module_with_pointers(std::array<std::uint32_t, 3> members, std::array<std::uint32_t, 3> offsets) {
    Assembler module = small_module();
    module.op(kName, {70}, "Words").op(kName, {80}, "Sums").op(kDecorate, {70, 2}).op(kDecorate, {80, 2});
    module.op(kMemberDecorate, {70, 0, 35, 0}).op(kMemberDecorate, {70, 0, 24});
    module.op(kMemberDecorate, {80, 0, 35, 0});
    for (std::uint32_t i = 0; i < 3; ++i)
        module.op(kMemberName, {40, i}, std::string(1, static_cast<char>('a' + i)))
            .op(kMemberDecorate, {40, i, 35, offsets[i]});
    module.op(kForwardPointer, {71, kPhysical}).op(kForwardPointer, {81, kPhysical});
    module.op(kTypeStruct, {40, members[0], members[1], members[2]});
    module.op(kTypeStruct, {70, 12}).op(kTypePointer, {71, kPhysical, 70});
    module.op(kTypeStruct, {80, 12}).op(kTypePointer, {81, kPhysical, 80});
    module.op(kTypePointer, {41, kPushConstant, 40}).op(kVariable, {41, 42, kPushConstant});
    return module.op(kLoad, {40, 51, 42});
}

TEST(Reflect, pointers_of_the_push_struct_have_the_access_of_their_blocks) {
    const ProgramInfo info = reflect(with_use(module_with_pointers({71, 81, 11}, {0, 8, 16})));
    ASSERT_EQ(info.addresses.size(), 2u);
    EXPECT_EQ(info.addresses[0].name, "a");
    EXPECT_TRUE(info.addresses[0].readable && !info.addresses[0].writable);
    EXPECT_EQ(info.addresses[1].name, "b");
    EXPECT_TRUE(info.addresses[1].readable && info.addresses[1].writable);
    EXPECT_EQ(info.push_bytes, 20u);
    ASSERT_EQ(info.blocks.size(), 1u);  // what pointers lead to is not bound
    EXPECT_EQ(info.blocks[0].name, "Items");
    EXPECT_EQ(info.find_address("c"), nullptr);
}

TEST(Reflect, pointers_that_are_not_the_first_members_of_the_push_struct_are_refused) {
    EXPECT_THROW((void)reflect(module_with_pointers({11, 71, 81}, {0, 8, 16}).words), InternalError);
    EXPECT_THROW((void)reflect(module_with_pointers({71, 11, 81}, {0, 8, 16}).words), InternalError);
}

TEST(Reflect, pointer_to_a_block_that_the_push_struct_does_not_have_is_refused) {
    EXPECT_THROW((void)reflect(module_with_pointers({71, 11, 11}, {0, 8, 12}).words), InternalError);
}

TEST(Reflect, compiled_probes_show_what_they_reach_by_address) {
    const ProgramInfo gather = reflect(probe("gather_words").spirv);
    ASSERT_EQ(gather.addresses.size(), 1u);
    EXPECT_EQ(gather.addresses[0].name, "from");
    EXPECT_TRUE(gather.addresses[0].readable && !gather.addresses[0].writable);
    EXPECT_EQ(gather.blocks.size(), 3u);
    EXPECT_EQ(gather.find_block("Words"), nullptr);
    EXPECT_EQ(gather.push_bytes, 12u);
    EXPECT_EQ(std::ranges::count(gather.capabilities, kPhysicalAddresses), 1);
    const ProgramInfo scatter = reflect(probe("scatter_words").spirv);
    ASSERT_EQ(scatter.addresses.size(), 1u);
    EXPECT_TRUE(!scatter.addresses[0].readable && scatter.addresses[0].writable);
    EXPECT_TRUE(reflect(probe("add_constant").spirv).addresses.empty());
}

TEST(Reflect, texel_buffers_go_by_the_names_of_their_variables) {
    const auto film = std::ranges::find(pass_shaders(), "film_add", &EmbeddedShader::name);
    ASSERT_NE(film, pass_shaders().end());
    const ProgramInfo info = reflect(film->spirv);
    const BufferBlock* read = info.find_block("Ao");
    const BufferBlock* summed = info.find_block("BeautyWords");
    const BufferBlock* written = info.find_block("Color");
    ASSERT_TRUE(read != nullptr && summed != nullptr && written != nullptr);
    EXPECT_TRUE(read->kind == BlockKind::texels && read->readable && !read->writable);
    EXPECT_TRUE(summed->kind == BlockKind::storage && !summed->readable && summed->writable);
    EXPECT_TRUE(written->kind == BlockKind::texels && !written->readable && written->writable);
    const auto march = std::ranges::find(pass_shaders(), "primary_march", &EmbeddedShader::name);
    ASSERT_NE(march, pass_shaders().end());
    EXPECT_EQ(reflect(march->spirv).find_block("Leaves")->kind, BlockKind::words);
    EXPECT_EQ(info.find_block("Counters")->kind, BlockKind::storage);
    EXPECT_EQ(info.find_block("Frame")->kind, BlockKind::uniform);
}

// Of images reflection knows storage texel buffers of four words and of one: dimension, kind and format in
// the type.
TEST(Reflect, images_that_are_no_texel_buffers_are_refused) {
    const auto module_with = [](std::uint32_t dimension, std::uint32_t sampled, std::uint32_t format) {
        Assembler module = small_module();
        module.op(kName, {61}, "Texels").op(kDecorate, {61, 33, 7});
        module.op(kTypeImage, {62, 11, dimension, 0, 0, 0, sampled, format});
        module.op(kTypePointer, {63, kUniformConstant, 62}).op(kVariable, {63, 61, kUniformConstant});
        return with_use(module.op(kLoad, {62, 64, 61}));
    };
    EXPECT_EQ(reflect(module_with(5, 2, 30)).find_block("Texels")->binding, 7u);
    EXPECT_EQ(reflect(module_with(5, 2, 30)).find_block("Texels")->kind, BlockKind::texels);
    EXPECT_EQ(reflect(module_with(5, 2, 33)).find_block("Texels")->kind, BlockKind::words);
    EXPECT_THROW((void)reflect(module_with(1, 2, 30)), InternalError) << "a picture";
    EXPECT_THROW((void)reflect(module_with(5, 1, 30)), InternalError) << "sampled";
    EXPECT_THROW((void)reflect(module_with(5, 2, 1)), InternalError) << "floats";
}

TEST(Reflect, broken_modules_are_refused) {
    EXPECT_THROW((void)reflect({}), InternalError);
    EXPECT_THROW((void)reflect(Words{1, 2, 3, 4, 5}), InternalError);
    EXPECT_THROW((void)reflect(Assembler().words), InternalError);  // no entry point
    Assembler graphics;
    EXPECT_THROW((void)reflect(graphics.op(kEntryPoint, {4, 1}, "main").words), InternalError);
    Words overrun = small_module().words;
    overrun.push_back(9u << 16 | kName);
    EXPECT_THROW((void)reflect(overrun), InternalError);
    Words stuck = small_module().words;
    stuck.push_back(kName);  // an instruction of no words
    EXPECT_THROW((void)reflect(stuck), InternalError);
    Assembler twice = small_module();
    twice.op(kVariable, {13, 21, kStorageBuffer}).op(kDecorate, {21, 33, 4}).op(kLoad, {11, 52, 21});
    EXPECT_THROW((void)reflect(with_use(twice)), InternalError);  // two blocks of one name
    Assembler unbound = small_module();
    unbound.op(kVariable, {13, 22, kStorageBuffer}).op(kLoad, {11, 53, 22});
    EXPECT_THROW((void)reflect(unbound.words), InternalError);
}

TEST(Reflect, type_that_holds_itself_is_refused) {
    Assembler module = small_module();
    module.op(kMemberDecorate, {60, 0, 35, 0}).op(kTypeStruct, {60, 60});
    EXPECT_THROW((void)reflect(module.words), InternalError);
}

TEST(Reflect, compiled_probe_shows_blocks_constants_and_push) {
    const ProgramInfo info = reflect(probe("add_constant").spirv);
    ASSERT_EQ(info.blocks.size(), 2u);  // Unused is not there
    const BufferBlock* in = info.find_block("In");
    const BufferBlock* out = info.find_block("Out");
    ASSERT_TRUE(in != nullptr && out != nullptr);
    EXPECT_TRUE(in->readable && !in->writable);
    EXPECT_TRUE(out->writable && !out->readable);
    EXPECT_EQ(info.push_bytes, 4u);
    EXPECT_EQ(info.push_members, (std::vector<StructMember>{{"count", 0}}));
    EXPECT_EQ(info.local_size[0].size, 64u);
    EXPECT_EQ(info.local_size[0].spec_id, 100u);
    ASSERT_NE(info.find_constant("step"), nullptr);
    EXPECT_EQ(info.find_constant("step")->default_value, 1u);
    ASSERT_NE(info.find_constant("is_negative"), nullptr);
    EXPECT_NE(info.find_constant("is_negative")->id, info.find_constant("step")->id);
    EXPECT_EQ(reflect(probe("count_invocations").spirv).blocks[0].readable, true);
    EXPECT_EQ(reflect(probe("count_invocations").spirv).blocks[0].writable, true);
}

TEST(Reflect, compiled_struct_shows_offsets_and_stride) {
    const ProgramInfo info = reflect(probe("pixel_ids").spirv);
    const auto laid_out = std::ranges::find_if(
        info.structs, [](const StructInfo& one) { return one.name == "Pixel" && one.array_stride > 0; });
    ASSERT_NE(laid_out, info.structs.end());
    EXPECT_EQ(laid_out->members, (std::vector<StructMember>{{"index", 0}, {"group_x", 4}, {"group_y", 8}}));
    EXPECT_EQ(laid_out->size_bytes, 12u);
    EXPECT_EQ(laid_out->array_stride, 12u);
    EXPECT_TRUE(info.local_size[0].spec_id && info.local_size[1].spec_id);
}

TEST(Reflect, every_embedded_shader_reflects) {
    for (const auto shaders : {pass_shaders(), probe_shaders()}) {
        for (const EmbeddedShader& shader : shaders)
            EXPECT_NO_THROW((void)reflect(shader.spirv)) << shader.name;
    }
}

// Cut at every word and with words changed at random: a value or an InternalError, nothing else.
TEST(Reflect, damaged_modules_never_do_worse_than_throw) {
    const auto good = probe("pixel_ids").spirv;
    const auto try_reflect = [](std::span<const std::uint32_t> words) {
        try {
            (void)reflect(words);
        } catch (const InternalError&) {
        }
    };
    for (std::size_t length = 0; length <= good.size(); ++length)
        try_reflect(good.first(length));
    std::mt19937 random(11);
    for (int i = 0; i < 5000; ++i) {
        Words words(good.begin(), good.end());
        for (int change = 0; change < 3; ++change) {
            std::uint32_t& word = words[random() % words.size()];
            word = random() % 2 == 0 ? static_cast<std::uint32_t>(random()) : word ^ (1u << (random() % 32));
        }
        try_reflect(words);
    }
}

}  // namespace
}  // namespace voxilux
