#include "passes/sky/sky_image.h"

#include "passes/sky/sky.h"
#include "scene/sky_image.h"

namespace voxilux {
namespace {

std::uint64_t texel_count(const RenderPlan& plan) {
    return static_cast<std::uint64_t>(plan.sky_image.x) * static_cast<std::uint64_t>(plan.sky_image.y);
}

}  // namespace

std::string sky_texels_buffer(const RenderPlan& plan, Recording& recording) {
    if (!plan.has_sky_image()) return placeholder_buffer(recording);
    return declare<gpu::vec4>(recording, "sky.texels", texel_count(plan), Lifetime::persistent);
}

std::string sky_table_buffer(const RenderPlan& plan, Recording& recording) {
    if (!plan.has_sky_image()) return placeholder_buffer(recording);
    return declare<gpu::AliasEntry>(recording, "sky.table", texel_count(plan), Lifetime::persistent);
}

std::vector<Constant> sky_image_constants(const RenderPlan& plan) {
    const glm::uvec2 size(plan.has_sky_image() ? plan.sky_image : glm::ivec2(0));
    return {{"sky_columns", size.x}, {"sky_rows", size.y}};
}

void record_sky_image(const RenderPlan& plan, const Sky& sky, Recording& recording) {
    if (!plan.has_sky_image()) return;
    const SkySampler sampler = sky_sampler(sky);
    recording.upload(sky_texels_buffer(plan, recording), std::as_bytes(std::span(sampler.texels)));
    recording.upload(sky_table_buffer(plan, recording), std::as_bytes(std::span(sampler.table)));
    if (traces_sky(plan) || plan.paths.runs()) return;
    const std::array<glm::vec3, 6> faces = sky_face_light(sky);
    recording.upload(sky_faces_buffer(plan, recording), std::as_bytes(std::span(faces)));
}

}  // namespace voxilux
