// The section [technique] of a scene file: which technique computes an effect.

#include "formats/toml_scene.h"
#include "formats/toml_section.h"
#include "scene/technique_choice.h"

namespace voxilux {

void read_technique(TomlScene& in) {
    const toml::table* table = find_section(in, "technique");
    if (table == nullptr) return;
    const std::vector<std::string_view> effects = effects_with_techniques();
    const TomlSection section(*table, "[technique]", effects);
    RenderSettings& settings = in.scene.settings;
    std::vector<std::pair<std::string_view, std::string_view>> chosen;
    for (const std::string_view effect : effects) {
        const std::vector<std::string_view> names = technique_names(effect);
        const auto choice = section.choice(effect, names);
        if (!choice) continue;
        choose_technique(effect, names[*choice], settings);
        chosen.emplace_back(effect, names[*choice]);
    }
    for (const auto& [effect, name] : chosen)
        if (!is_chosen(effect, name, settings)) section.refuse(effect, kUnlikePhotons);
}

}  // namespace voxilux
