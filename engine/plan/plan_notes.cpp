#include "plan/plan_notes.h"

#include <fmt/format.h>

#include <string>

namespace voxilux {
namespace {

// What an image without an effect may lack. Light between Lambertian surfaces is a series over bounces: where
// no albedo is above a, the irradiance of bounce k is at most a^k of the largest direct one anywhere, so all
// bounces together are at most a / (1 - a) of it. Mirrors and glass gather light, which has no such bound.
std::string words_without(Effect effect, const SceneFacts& facts) {
    const std::string words = fmt::format("{}, which the claimed error does not count", name_of(effect));
    const bool is_bounded = !facts.has_glass && !facts.has_metal && facts.max_albedo < 1.0;
    if (effect != Effect::indirect || !is_bounded) return words;
    return fmt::format("{}: at most {:.0f} % of the strongest direct irradiance", words,
                       100.0 * facts.max_albedo / (1.0 - facts.max_albedo));
}

}  // namespace

void add_notes(RenderPlan& plan, const SceneFacts& facts) {
    const bool is_polished = facts.has_glass || facts.has_metal;
    for (const EffectState& state : plan.effects)
        if (state.by_choice && !state.on) plan.without.push_back(words_without(state.effect, facts));
    if (plan.has_aerial()) plan.notes.emplace_back("the scene throws no shadow into the air before it");
    if (plan.has_aerial() && is_polished)
        plan.notes.emplace_back(
            "the air is seen before first hits, not between mirrors or glass and what they show");
    if (plan.traces_air() && !plan.paths.runs() && (!plan.has(Effect::ao) || plan.ao.uses_cells()))
        plan.notes.emplace_back("no rays look for the sky's light at surfaces, which is that of its tables");
    if (plan.has(Effect::sky) && is_polished && !plan.paths.runs())
        plan.notes.emplace_back("glass and mirrors block the light of the sky as walls do");
    if (plan.has_sky_image() && is_polished && plan.paths.runs())
        plan.notes.emplace_back(
            "light of the sky by way of mirrors and glass is found by chance: bright spots of it are noisy");
    if (plan.has(Effect::sun) && plan.paths_find_sun_caustics && plan.has_specular_spheres)
        plan.notes.emplace_back(
            "sunlight by way of spheres of metal and glass is found by chance: it is noisy");
    plan.notes.insert(plan.notes.end(), facts.simplified.begin(), facts.simplified.end());
    if (!plan.shows_rough)
        plan.notes.insert(plan.notes.end(), facts.simplified_rough.begin(), facts.simplified_rough.end());
}

}  // namespace voxilux
