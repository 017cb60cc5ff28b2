#include "passes/display/display.h"

#include <algorithm>

#include "base/assert.h"
#include "base/checked_cast.h"
#include "passes/ao/ao.h"
#include "passes/plane.h"
#include "shared/window.h"

namespace voxilux {
namespace {

// Where the values of a channel are, and what they mean.
struct ChannelSource {
    FilmPlane plane;
    bool has_halves = false;
    bool has_floats = false;
    gpu::uint shows = gpu::kShowsRadiance;
};

ChannelSource source_of(DisplayChannel channel) {
    switch (channel) {
        case DisplayChannel::albedo:
            return {.plane = {"albedo", 3}, .shows = gpu::kShowsAlbedo};
        case DisplayChannel::normal:
            return {.plane = {"normal", 3}, .shows = gpu::kShowsVector};
        case DisplayChannel::position:
            return {.plane = {"position", 3}, .has_floats = true, .shows = gpu::kShowsVector};
        case DisplayChannel::depth:
            return {.plane = {"depth", 1}, .has_floats = true, .shows = gpu::kShowsNumber};
        case DisplayChannel::ao:
            return {.plane = {"ao", 1}, .shows = gpu::kShowsNumber};
        case DisplayChannel::sun:
            return {.plane = {"sun", 1}, .shows = gpu::kShowsNumber};
        case DisplayChannel::error:
            return {.plane = {"beauty_a", 3}, .has_halves = true, .shows = gpu::kShowsError};
        case DisplayChannel::color:
        case DisplayChannel::cells:
        case DisplayChannel::steps:
            break;
    }
    return {.plane = {"beauty_a", 3}, .has_halves = true};
}

std::uint64_t pixels_of(const RenderPlan& plan) {
    return static_cast<std::uint64_t>(plan.settings.size.x) *
           static_cast<std::uint64_t>(plan.settings.size.y);
}

std::string reference_buffer(const RenderPlan& plan, Recording& recording) {
    return declare<float>(recording, "display.reference", 3 * pixels_of(plan), Lifetime::persistent);
}

DisplayBuffer display_buffer(const RenderPlan& plan, Recording& recording) {
    return {declare<std::uint32_t>(recording, "display.codes", pixels_of(plan), Lifetime::persistent),
            plan.settings.size};
}

std::vector<Constant> display_constants(const ChannelSource& source, const DisplayLook& look) {
    const bool compares = source.shows == gpu::kShowsRadiance;
    return {{"shows", source.shows},
            {"compares", compares ? static_cast<gpu::uint>(look.comparison) : gpu::kComparesNothing},
            {"components", source.plane.components},
            {"has_halves", source.has_halves ? 1u : 0u},
            {"has_floats", source.has_floats ? 1u : 0u},
            {"is_filmic", look.curve == ToneMap::filmic ? 1u : 0u},
            {"is_bgr", look.is_bgr ? 1u : 0u}};
}

std::string values_of(const RenderPlan& plan, const ChannelSource& source, std::uint32_t film_tile,
                      Recording& recording) {
    return source.has_floats ? film_plane<float>(plan, source.plane, film_tile, recording)
                             : film_plane<std::int64_t>(plan, source.plane, film_tile, recording);
}

}  // namespace

bool has_channel(const RenderPlan& plan, DisplayChannel channel) {
    if (channel == DisplayChannel::color || channel == DisplayChannel::error) return true;
    if (channel == DisplayChannel::cells) return plan.has(Effect::ao) && plan.ao.uses_cells();
    if (channel == DisplayChannel::steps) return plan.has(Effect::voxels);
    if (channel == DisplayChannel::ao && !plan.has(Effect::ao)) return false;
    if (channel == DisplayChannel::sun && !plan.has(Effect::sun)) return false;
    return plan.has(Effect::aov);
}

DisplayBuffer record_display_resolve(const RenderPlan& plan, const SampleCounts& counts,
                                     const DisplayLook& look, Recording& recording) {
    VX_ASSERT(has_channel(plan, look.channel) && look.channel < DisplayChannel::cells);
    const ChannelSource source = source_of(look.channel);
    const DisplayBuffer display = display_buffer(plan, recording);
    const bool compares = look.comparison != DisplayComparison::none;
    const std::string reference =
        compares ? reference_buffer(plan, recording) : placeholder_buffer(recording);
    const auto width = static_cast<std::uint32_t>(display.size.x);
    const auto height = static_cast<std::uint32_t>(display.size.y);
    for (std::uint32_t film_tile = 0; film_tile < plan.film_tile_count; ++film_tile) {
        const std::uint32_t first_row = film_tile * plan.film_tile_rows;
        const gpu::DisplayResolvePush push{
            .low = look.low,
            .high = look.high,
            .pixel_count = width * std::min(plan.film_tile_rows, height - first_row),
            .width = width,
            .first_row = first_row,
            .samples = counts.samples,
            .rows_ahead = counts.rows_ahead,
            .exposure = look.exposure,
            .divider = look.divider};
        const std::string other = source.has_halves
                                      ? film_plane<std::int64_t>(plan, {"beauty_b", 3}, film_tile, recording)
                                      : placeholder_buffer(recording);
        recording.dispatch({.label = "display.resolve",
                            .shader = "display_resolve",
                            .extent = {(push.pixel_count + gpu::kGroupPixels - 1) / gpu::kGroupPixels, 1, 1},
                            .bindings = {{"Values", values_of(plan, source, film_tile, recording)},
                                         {"OtherHalf", other},
                                         {"Reference", reference},
                                         {"Display", display.buffer}},
                            .constants = display_constants(source, look),
                            .push = to_bytes(push)});
    }
    return display;
}

DisplayBuffer record_display_cells(const RenderPlan& plan, std::uint64_t sample, const DisplayLook& look,
                                   Recording& recording) {
    VX_ASSERT(has_channel(plan, DisplayChannel::cells) && plan.film_tile_count == 1);
    const DisplayBuffer display = display_buffer(plan, recording);
    const SeenCells cells = seen_cells(plan, sample, recording);
    const auto pixels = checked_cast<std::uint32_t>(pixels_of(plan), "pixels");
    const gpu::DisplayCellsPush push{.pixel_count = pixels, .low = look.low.x, .high = look.high.x};
    recording.dispatch(
        {.label = "display.cells",
         .shader = "display_cells",
         .extent = {pixels, 1, 1},
         .bindings = {{"Slots", cells.slots}, {"Samples", cells.samples}, {"Display", display.buffer}},
         .constants = {{"is_bgr", look.is_bgr ? 1u : 0u}},
         .push = to_bytes(push)});
    return display;
}

DisplayBuffer record_display_steps(const RenderPlan& plan, gpu::FrameParams params, const DisplayLook& look,
                                   Recording& recording) {
    VX_ASSERT(has_channel(plan, DisplayChannel::steps));
    const DisplayBuffer display = display_buffer(plan, recording);
    params.first_row = static_cast<gpu::uint>(plan.first_pixel.y);
    params.row_count = static_cast<gpu::uint>(display.size.y);
    recording.upload(frame_buffer(recording), to_bytes(params));
    Dispatch dispatch{.label = "display.steps",
                      .shader = "display_steps",
                      .extent = pixel_extent(plan, {.row_count = params.row_count}),
                      .bindings = {{"Frame", frame_buffer(recording)}, {"Display", display.buffer}},
                      .constants = {sequence_constant(plan),
                                    projection_constant(plan),
                                    {"has_shadows", plan.has(Effect::sun) ? 1u : 0u},
                                    {"is_bgr", look.is_bgr ? 1u : 0u}},
                      .push = to_bytes(gpu::DisplayRangePush{.low = look.low.x, .high = look.high.x})};
    point_to_world(plan.world.traversal, world_buffers(plan, recording), dispatch);
    recording.dispatch(std::move(dispatch));
    return display;
}

void record_display_reference(const RenderPlan& plan, std::span<const float> radiance, Recording& recording) {
    VX_ASSERT_EQ(radiance.size(), 3 * pixels_of(plan));
    recording.upload(reference_buffer(plan, recording), std::as_bytes(radiance));
}

}  // namespace voxilux
