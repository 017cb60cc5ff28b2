#include "frame/footprint.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"
#include "passes/denoise/denoise.h"
#include "passes/upload.h"

namespace voxilux {
namespace {

// Adds recordings up.
class FootprintSum {
  public:
    // Adds a recording that is executed `times` times. With 0, only its buffers count.
    void add(const Recording& recording, std::uint64_t times) {
        for (const BufferProxy& proxy : recording.buffers()) {
            const auto [known, is_new] = buffers_.emplace(proxy.name, sum_.buffers.size());
            if (is_new) sum_.buffers.push_back({proxy.name, proxy.size_bytes, proxy.persistent});
            VX_ASSERT_EQ(sum_.buffers[known->second].bytes, proxy.size_bytes);
        }
        for (const Command& command : recording.commands()) {
            if (times == 0) break;
            if (const auto* dispatch = std::get_if<Dispatch>(&command)) add_pass(*dispatch, times);
            if (const auto* indirect = std::get_if<DispatchIndirect>(&command))
                add_pass(indirect->dispatch, times);
        }
    }

    [[nodiscard]] Footprint sum() {
        for (PlannedBuffer& planned : sum_.buffers)
            planned.by_address = addressed_.contains(planned.buffer);
        return sum_;
    }

  private:
    void add_pass(const Dispatch& dispatch, std::uint64_t times) {
        auto known = std::ranges::find(sum_.passes, dispatch.label, &PlannedPass::label);
        if (known == sum_.passes.end()) known = sum_.passes.insert(known, PlannedPass{dispatch.label});
        known->count += times;
        for (const Address& address : dispatch.addresses)
            addressed_.insert(address.buffer);
    }

    Footprint sum_;
    std::map<std::string, std::size_t> buffers_;  // positions in sum_.buffers
    std::set<std::string> addressed_;
};

// Dispatch tiles of a film tile that differ only in their first row.
struct EqualDispatchTiles {
    DispatchTile tile;
    std::uint64_t count = 0;
};

std::vector<EqualDispatchTiles> tiles_of(const RenderPlan& plan) {
    std::vector<EqualDispatchTiles> all;
    const auto height = static_cast<std::uint32_t>(plan.settings.size.y);
    for (std::uint32_t film_tile = 0; film_tile < plan.film_tile_count; ++film_tile) {
        const std::uint32_t first = film_tile * plan.film_tile_rows;
        const std::uint32_t rows = std::min(plan.film_tile_rows, height - first);
        const auto add = [&](std::uint32_t row_count, std::uint64_t count) {
            if (row_count * count != 0) all.push_back({{film_tile, first, first, row_count}, count});
        };
        add(plan.tile_rows, rows / plan.tile_rows);
        add(rows % plan.tile_rows, 1);
    }
    return all;
}

constexpr std::uint64_t kLeastPhotonStore = 1u << 20;  // bytes

// Its passes run once, after the last sample.
void add_denoiser(glm::ivec2 size, FootprintSum& sum) {
    const std::vector<DenoiseStrip> strips = denoise_strips(size);
    for (const DenoiseStrip& strip : strips) {
        Recording recording;
        record_denoise({size.x, strip.rows}, most_rows(strips), 0.5f, {}, recording);
        sum.add(recording, 1);
    }
}

// Any camera: what is recorded does not depend on it.
gpu::FrameParams some_params() {
    gpu::FrameParams params{};
    params.width = params.height = 1;
    params.camera_right = {1.0f, 0.0f, 0.0f};
    params.camera_up = {0.0f, 1.0f, 0.0f};
    params.camera_forward = {0.0f, 0.0f, 1.0f};
    return params;
}

// The state of the frame with most passes: where later frames may evict occlusion cells, one whose table is
// full.
FrameState fullest_state(const RenderPlan& plan) {
    if (!plan.ao.ages) return {};
    return {.frames_done = 1, .samples_done = plan.samples(), .live_cells = plan.ao.slots};
}

void check_memory(const Footprint& needs, std::uint64_t budget_bytes, const DeviceLimits& limits) {
    for (const PlannedBuffer& planned : needs.buffers) {
        const std::uint64_t limit = planned.by_address
                                        ? max_world_array_bytes(limits)
                                        : std::min(limits.max_binding_bytes, limits.max_allocation_bytes);
        if (planned.bytes > limit) {
            throw Error(ExitCode::out_of_memory,
                        fmt::format("buffer '{}' needs {} bytes but {} takes {} at most; make the {} smaller",
                                    planned.buffer, planned.bytes, limits.name, limit,
                                    planned.buffer.starts_with("world") ? "scene" : "picture"));
        }
    }
    if (budget_bytes != 0 && needs.total_bytes() > budget_bytes) {
        const auto largest = std::ranges::max_element(needs.buffers, {}, &PlannedBuffer::bytes);
        throw Error(
            ExitCode::out_of_memory,
            fmt::format(
                "the render needs {} MiB on the device, over the budget of {} MiB; the largest buffer "
                "is '{}' with {} MiB",
                needs.total_bytes() >> 20, budget_bytes >> 20, largest->buffer, largest->bytes >> 20));
    }
}

}  // namespace

std::uint64_t Footprint::total_bytes() const {
    std::uint64_t total = 0;
    for (const PlannedBuffer& planned : buffers)
        total += planned.bytes;
    return total;
}

Footprint footprint(const RenderPlan& plan, const SampleRecorder& record) {
    FootprintSum sum;
    // Without data nothing is uploaded; buffers and passes follow from the plan.
    Recording scene;
    const MarchWorld no_words{.traversal = plan.world.traversal, .chunks_size = plan.world.size / 16};
    record_scene_upload(plan, Scene{}, no_words, LightList{}, scene);
    sum.add(scene, 1);
    const gpu::FrameParams params = some_params();
    const std::uint32_t samples = plan.samples();
    for (const EqualDispatchTiles& equal : tiles_of(plan)) {
        FrameState state = fullest_state(plan);
        for (std::uint32_t i = 0; i < std::min(samples, 2u); ++i) {
            Recording recording;
            record(plan, equal.tile, params, {plan.part.sample(i), state, plan.part.first()}, recording);
            sum.add(recording, equal.count * (i == 0 ? 1 : samples - 1));
            state.finish_sample(params);
        }
    }
    if (plan.needs_pilot()) {  // runs before the first frame, so only its buffers count
        Recording pilot;
        record(plan_counting(plan, 0.0), tiles_of(plan).front().tile, params, {}, pilot);
        sum.add(pilot, 0);
    }
    Recording film;
    record_film_clear(plan, film);
    sum.add(film, 1);
    if (plan.is_denoised()) add_denoiser(plan.settings.size, sum);
    return sum.sum();
}

RenderPlan plan_within_memory(const Scene& scene, const SceneFacts& facts, const WorldFacts& world,
                              const PlanRequest& request, const DeviceLimits& limits) {
    RenderPlan plan = plan_render(scene, facts, world, request, limits);
    Footprint needs = footprint(plan);
    // Shorter runs of photons give the same image in less memory.
    PlanRequest with_runs = request;
    with_runs.photon_store_bytes = limits.max_binding_bytes;
    const auto is_over = [&] {
        return request.memory_budget_bytes != 0 && needs.total_bytes() > request.memory_budget_bytes;
    };
    while (is_over() && plan.photons.runs() && with_runs.photon_store_bytes > kLeastPhotonStore) {
        with_runs.photon_store_bytes /= 2;
        plan = plan_render(scene, facts, world, with_runs, limits);
        needs = footprint(plan);
    }
    check_memory(needs, request.memory_budget_bytes, limits);
    return plan;
}

}  // namespace voxilux
