#include "frame/footprint.h"

namespace voxilux {
namespace {

std::string runs_text(const PhotonPlan& photons) {
    return photons.run_count() > 1 ? fmt::format(" in {} runs", photons.run_count()) : "";
}

}  // namespace

std::string describe(const RenderPlan& plan) {
    const RenderSettings& s = plan.settings;
    std::string text =
        fmt::format("picture   {}x{}, {} samples per pixel, {} occlusion rays of {} voxels each\n", s.size.x,
                    s.size.y, s.spp, s.ao_rays, s.ao_radius);
    if (plan.image_size != s.size) {
        text += fmt::format("crop      from column {}, row {} of an image of {}x{}\n", plan.first_pixel.x,
                            plan.first_pixel.y, plan.image_size.x, plan.image_size.y);
    }
    if (!plan.part.empty())
        text += fmt::format("part      {} samples: {}\n", plan.samples(), plan.part.text());
    text += fmt::format("split     {} film tile(s) of {} rows\n", plan.film_tile_count, plan.film_tile_rows);
    if (plan.has(Effect::voxels)) {
        text +=
            fmt::format("traversal {:<10} {}, {} x {} x {} cells\n", name_of(plan.world.traversal),
                        plan.world.traversal_reason, plan.world.size.x, plan.world.size.y, plan.world.size.z);
    }
    for (const EffectState& state : plan.effects)
        text += fmt::format("effect    {:<10} {:<4} {}\n", name_of(state.effect), state.on ? "on" : "off",
                            state.reason);
    for (const auto& [technique, reason] : plan.techniques) {
        if (plan.has(technique->effect))
            text += fmt::format("technique {:<10} {:<11} {}\n", name_of(technique->effect), technique->name,
                                reason);
    }
    if (plan.photons.runs())
        text += fmt::format("photons   {} per iteration{}, room for {}, first radius {}, alpha {:.3g}\n",
                            plan.photons.count(), runs_text(plan.photons), plan.photons.capacity,
                            plan.needs_pilot() ? "from a pilot" : fmt::format("{:.4g}", plan.photons.radius),
                            plan.settings.photons.alpha);
    if (plan.photons.aims)
        text += fmt::format("          towards mirrors and glass: {:.2g} % of all light\n",
                            100.0 * plan.photons.power / (plan.photons.power + plan.photons.power_left_out));
    if (plan.paths.runs())
        text +=
            fmt::format("paths     {} per invocation, {} round(s)\n", plan.paths.per_lane, plan.paths.rounds);
    const Footprint needs = footprint(plan);
    for (const PlannedPass& pass : needs.passes)
        text += fmt::format("pass      {:<14} x {}\n", pass.label, pass.count);
    for (const PlannedBuffer& planned : needs.buffers)
        text += fmt::format("buffer    {:<22} {} bytes\n", planned.buffer, planned.bytes);
    text += fmt::format("memory    {:.1f} MiB on the device\n",
                        static_cast<double>(needs.total_bytes()) / 1048576.0);
    text += fmt::format("rays      primary {}, ao at most {}, sun at most {}\n", plan.rays.primary,
                        plan.rays.ao, plan.rays.sun);
    for (const std::string& effect : plan.without)
        text += fmt::format("without   {}\n", effect);
    for (const std::string& note : plan.notes)
        text += fmt::format("note      {}\n", note);
    return text;
}

}  // namespace voxilux
