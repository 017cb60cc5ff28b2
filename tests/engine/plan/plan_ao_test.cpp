// How occlusion is computed: what the settings say, what the plan chooses and refuses, and what a plan with
// cells contains.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "engine/plan/plan_scenes.h"
#include "formats/scene_toml.h"
#include "frame/frame.h"

namespace voxilux {
namespace {

constexpr AoNeeds kServes{.has_voxels = true, .world_size = glm::ivec3(64), .pixels = 640 * 360, .frames = 2};

RenderSettings asking_for(AoMethod method) {
    RenderSettings settings;
    settings.ao.method = method;
    return settings;
}

// The message that refuses a plan, or how it goes.
std::string answer(const RenderSettings& settings, const AoNeeds& needs) {
    try {
        return plan_ao(settings, needs).uses_cells() ? "hash" : "brute";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
}

struct Hindrance {
    std::string what;
    AoNeeds needs;
};

std::vector<Hindrance> hindrances() {
    std::vector<Hindrance> all{
        {"no voxels", kServes}, {"longer than 131072", kServes}, {"over 2097152 pixels", kServes}};
    all[0].needs.has_voxels = false;
    all[1].needs.world_size.y = 131088;
    all[2].needs.pixels = 2097153;
    return all;
}

TEST(PlanAo, automatic_uses_cells_for_several_frames_that_allow_it) {
    const RenderSettings settings = asking_for(AoMethod::automatic);
    EXPECT_EQ(answer(settings, kServes), "hash");
    AoNeeds single = kServes;
    single.frames = 1;
    EXPECT_EQ(answer(settings, single), "brute");
    for (const Hindrance& hindrance : hindrances()) {
        EXPECT_EQ(answer(settings, hindrance.needs), "brute");
        EXPECT_NE(plan_ao(settings, hindrance.needs).reason.find(hindrance.what), std::string::npos)
            << hindrance.what;
    }
}

TEST(PlanAo, method_that_is_named_is_used_or_refused) {
    AoNeeds single = kServes;
    single.frames = 1;
    for (const AoNeeds& needs : {kServes, single}) {
        EXPECT_EQ(answer(asking_for(AoMethod::hash), needs), "hash");
        EXPECT_EQ(answer(asking_for(AoMethod::brute), needs), "brute");
    }
    for (const Hindrance& hindrance : hindrances()) {
        EXPECT_EQ(answer(asking_for(AoMethod::brute), hindrance.needs), "brute");
        const std::string refusal = answer(asking_for(AoMethod::hash), hindrance.needs);
        EXPECT_NE(refusal.find(hindrance.what), std::string::npos) << refusal;
        EXPECT_NE(refusal.find("use brute force"), std::string::npos) << refusal;
    }
}

TEST(PlanAo, frames_with_moving_voxels_are_traced_pixel_by_pixel_unless_asked_otherwise) {
    AoNeeds moving = kServes;
    moving.moves_voxels = true;
    const AoPlan plan = plan_ao(asking_for(AoMethod::automatic), moving);
    EXPECT_FALSE(plan.uses_cells());
    EXPECT_NE(plan.reason.find("moving voxels"), std::string::npos) << plan.reason;
    const AoPlan asked = plan_ao(asking_for(AoMethod::hash), moving);
    EXPECT_TRUE(asked.uses_cells());
    EXPECT_TRUE(asked.ages) << "voxels that rest for some frames keep their cells";
}

// A sample is one dispatch over the whole picture, and its rays are counted in 32 bits.
TEST(PlanAo, picture_of_more_rows_or_rays_than_one_dispatch_takes_or_counts_is_refused) {
    RenderSettings settings = asking_for(AoMethod::hash);
    settings.size = {16, 65536};
    AoNeeds needs = kServes;
    needs.max_rows = 65535;
    EXPECT_NE(answer(settings, needs).find("over 65535 rows"), std::string::npos);
    settings.size.y = 65535;
    EXPECT_EQ(answer(settings, needs), "hash");
    needs.pixels = 65537;
    settings.ao_rays = 65535;
    EXPECT_EQ(answer(settings, needs), "hash");
    needs.pixels = 65538;
    EXPECT_NE(answer(settings, needs).find("over 4294967295 occlusion rays"), std::string::npos);
    settings.ao.method = AoMethod::automatic;
    EXPECT_EQ(answer(settings, needs), "brute");
}

TEST(PlanAo, limits_themselves_are_served) {
    AoNeeds largest = kServes;
    largest.world_size = glm::ivec3(131072);
    largest.pixels = 2097152;
    EXPECT_EQ(answer(asking_for(AoMethod::hash), largest), "hash");
}

TEST(PlanAo, slots_are_a_power_of_two_and_at_least_one_for_each_pixel) {
    for (const std::uint64_t pixels : {1u, 4096u, 4097u, 230400u, 2073600u, 2097152u}) {
        AoNeeds needs = kServes;
        needs.pixels = pixels;
        const std::uint32_t slots = plan_ao(asking_for(AoMethod::hash), needs).slots;
        EXPECT_TRUE(std::has_single_bit(slots)) << slots;
        EXPECT_GE(slots, pixels);
    }
    EXPECT_EQ(plan_ao(asking_for(AoMethod::brute), kServes).slots, 0u);
}

TEST(PlanAo, slots_that_are_asked_for_are_taken_or_refused) {
    RenderSettings settings = asking_for(AoMethod::hash);
    for (const std::uint32_t slots : {1u, 2u, 16u, 1u << 24}) {
        settings.ao.slots = slots;
        EXPECT_EQ(plan_ao(settings, kServes).slots, slots);
    }
    for (const std::uint32_t slots : {3u, 48u, (1u << 24) - 1}) {
        settings.ao.slots = slots;
        EXPECT_NE(answer(settings, kServes).find("is not a power of two"), std::string::npos) << slots;
    }
}

TEST(PlanAo, merged_excludes_what_must_know_the_cell_first) {
    RenderSettings settings = asking_for(AoMethod::hash);
    settings.ao.merged = true;
    EXPECT_EQ(answer(settings, kServes), "hash");
    settings.ao.checkerboard = true;
    EXPECT_NE(answer(settings, kServes).find("excludes"), std::string::npos);
    settings.ao.checkerboard = false;
    settings.ao.sample_limit = 1;
    EXPECT_NE(answer(settings, kServes).find("excludes"), std::string::npos);
    settings.ao.merged = false;
    settings.ao.checkerboard = true;
    EXPECT_EQ(answer(settings, kServes), "hash");
}

AoSettings read(const std::string& section) {
    return parse_scene("[ao]\n" + section + "\n", "s.toml").settings.ao;
}

TEST(AoToml, every_key_is_read) {
    EXPECT_EQ(parse_scene("", "s.toml").settings.ao, AoSettings{});
    EXPECT_EQ(read(""), AoSettings{});
    const AoSettings all = read(
        "method = 'hash'\ncell_px = 5.5\nreproject = false\nmerged = true\ncheckerboard = true\nsampling = "
        "'pixel'\n"
        "filter = 3\nsample_limit = 500\nslots = 1024");
    EXPECT_EQ(all, (AoSettings{.method = AoMethod::hash,
                               .cell_px = 5.5f,
                               .reproject = false,
                               .merged = true,
                               .checkerboard = true,
                               .by_pixel = true,
                               .filter = 3,
                               .sample_limit = 500,
                               .slots = 1024}));
    EXPECT_EQ(read("method = 'brute'").method, AoMethod::brute);
    EXPECT_EQ(read("method = 'auto'").method, AoMethod::automatic);
    EXPECT_FALSE(read("sampling = 'cell'").by_pixel);
}

std::string refusal(const std::string& section) {
    try {
        (void)read(section);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        return error.what();
    }
    return "accepted";
}

TEST(AoToml, ends_of_every_range_are_read) {
    for (const char* line :
         {"cell_px = 4096", "cell_px = 0.001", "filter = 0", "filter = 4", "sample_limit = 0",
          "sample_limit = 4294967295", "slots = 0", "slots = 16777216"})
        EXPECT_EQ(refusal(line), "accepted") << line;
}

TEST(AoToml, bad_value_is_refused_with_its_line) {
    for (const char* line :
         {"cell_px = 0", "cell_px = -1", "cell_px = 4096.5", "cell_px = nan", "cell_px = 'ten'", "filter = 5",
          "filter = -1", "filter = 1.5", "sample_limit = -1", "sample_limit = 4294967296", "slots = -2",
          "slots = 16777217", "method = 'magic'", "method = 1", "sampling = 'pixels'", "reproject = 1",
          "merged = 'no'", "checkerboard = 0", "cell = 3"}) {
        const std::string message = refusal(line);
        EXPECT_TRUE(message.starts_with("s.toml:2:")) << line << ": " << message;
    }
}

// Names in a plan that belong to occlusion.
std::set<std::string> ao_names(const RenderPlan& plan) {
    std::set<std::string> names;
    const auto add = [&](const std::string& name) {
        if (name.starts_with("ao.")) names.insert(name);
    };
    const Footprint needs = footprint(plan);
    for (const PlannedPass& pass : needs.passes)
        add(pass.label);
    for (const PlannedBuffer& buffer : needs.buffers)
        add(buffer.buffer);
    return names;
}

std::set<std::string> planned_names(const std::vector<std::string>& overrides) {
    return ao_names(test::plan_of(test::repository_scene("mixed", overrides)));
}

TEST(PlanAo, plan_lists_exactly_what_its_options_need) {
    EXPECT_EQ(planned_names({"ao.method=brute"}), (std::set<std::string>{"ao.trace", "ao.visibility"}));
    const std::set<std::string> merged{"ao.sample", "ao.resolve", "ao.visibility", "ao.frame",
                                       "ao.keys",   "ao.samples", "ao.unoccluded", "ao.slots_even",
                                       "ao.own",    "ao.touched"};
    EXPECT_EQ(planned_names({"ao.method=hash"}), merged);
    std::set<std::string> cells = merged;
    cells.insert("ao.lookup");
    EXPECT_EQ(planned_names({"ao.method=hash", "ao.merged=false"}), cells);
    EXPECT_EQ(planned_names({"ao.method=hash", "ao.checkerboard=true"}), cells);
    std::set<std::string> reprojected = merged;
    reprojected.insert({"ao.reproject", "ao.search", "ao.missed", "ao.slots_odd"});
    EXPECT_EQ(planned_names({"ao.method=hash", "ao.reproject=true"}), reprojected);
    std::set<std::string> filtered = merged;
    filtered.insert({"ao.filter", "ao.variance", "ao.filtered", "ao.filtered_variance"});
    EXPECT_EQ(planned_names({"ao.method=hash", "ao.filter=2"}), filtered);
}

// All occlusion passes that the frames record, and the sizes that they declare. A single frame gives up no
// cells.
constexpr std::uint32_t kFrames = 9;

TEST(PlanAo, recordings_use_exactly_what_the_plan_lists) {
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
             {"ao.method=hash"},
             {"ao.method=hash", "ao.merged=false"},
             {"ao.method=hash", "ao.reproject=true"},
             {"ao.method=hash", "ao.filter=3", "ao.checkerboard=true", "ao.slots=64"}}) {
        const Scene scene = test::repository_scene("mixed", options);
        PlanRequest request = test::exr_request();
        request.frames = kFrames;
        const PreparedScene prepared = prepare_scene(scene, request, DeviceLimits{});
        const gpu::FrameParams params = frame_params(prepared.plan, scene, prepared.march_world);
        const DispatchTile tile{.row_count = static_cast<std::uint32_t>(prepared.plan.settings.size.y)};
        const Footprint needs = footprint(prepared.plan);
        FrameState state;
        std::set<std::string> used;
        for (std::uint32_t i = 0; i < kFrames; ++i) {
            Recording recording;
            record_frame(prepared.plan, tile, params, {0, state}, recording);
            for (const BufferProxy& proxy : recording.buffers()) {
                if (!proxy.name.starts_with("ao.")) continue;
                used.insert(proxy.name);
                const auto planned = std::ranges::find(needs.buffers, proxy.name, &PlannedBuffer::buffer);
                ASSERT_NE(planned, needs.buffers.end()) << proxy.name;
                EXPECT_EQ(planned->bytes, proxy.size_bytes) << proxy.name;
                EXPECT_EQ(planned->persistent, proxy.persistent) << proxy.name;
            }
            for (const Command& command : recording.commands()) {
                const auto* dispatch = std::get_if<Dispatch>(&command);
                const auto* indirect = std::get_if<DispatchIndirect>(&command);
                if (indirect != nullptr) dispatch = &indirect->dispatch;
                if (dispatch != nullptr && dispatch->label.starts_with("ao.")) used.insert(dispatch->label);
            }
            state.finish_sample(params);
            state.live_cells = prepared.plan.ao.slots / 4;  // enough to be swept
            ++state.frames_done;
        }
        EXPECT_EQ(used, ao_names(prepared.plan));
    }
}

}  // namespace
}  // namespace voxilux
