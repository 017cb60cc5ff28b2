#include "view/quality_choice.h"

#include "base/error.h"

namespace voxilux {

void choose_quality(const QualityPreset& preset, ViewState& state) {
    LivePicture& picture = state.picture;
    RenderSettings settings = picture.settings();
    settings.ao_rays = preset.ao_rays;
    try {
        picture.change(settings, picture.request());
        settings.spp = price_of(preset, picture.rest_plan().photons.runs()).samples;
        picture.change(settings, picture.request());
        picture.set_max_samples(settings.spp);
        state.quality = &preset;
        state.message.clear();
    } catch (const Error& error) {
        state.message = error.what();
    }
}

void step_quality(ViewState& state) {
    if (!state.picture.is_loaded()) return;
    const std::span<const QualityPreset> presets = quality_presets();
    const auto chosen = std::ranges::find(presets, state.quality, [](const auto& one) { return &one; });
    const auto number = static_cast<std::size_t>(chosen - presets.begin());
    choose_quality(presets[(number + 1) % presets.size() * (chosen != presets.end() ? 1 : 0)], state);
}

}  // namespace voxilux
