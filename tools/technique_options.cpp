#include "technique_options.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/technique_choice.h"

namespace voxilux {
namespace {

struct NamedTechnique {
    std::string_view effect;
    std::string_view name;
};

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
    throw Error(ExitCode::usage, fmt::format("--technique: '{}' {}", text, why));
}

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

NamedTechnique parse_technique(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) refuse(text, "must be EFFECT=NAME, such as ao=hash");
    const NamedTechnique named{text.substr(0, equals), text.substr(equals + 1)};
    const std::vector<std::string_view> effects = effects_with_techniques();
    if (!contains(effects, named.effect))
        refuse(text, "names no effect with techniques" + name_hint(named.effect, effects));
    const std::vector<std::string_view> names = technique_names(named.effect);
    if (!contains(names, named.name))
        refuse(text, fmt::format("names no technique of {}{}", named.effect, name_hint(named.name, names)));
    return named;
}

}  // namespace

std::string technique_help() {
    std::string help = "how an effect is computed";
    for (const std::string_view effect : effects_with_techniques())
        help += fmt::format("; {}: {}", effect, fmt::join(technique_names(effect), ", "));
    return help + "; may repeat";
}

RenderSettings with_techniques(RenderSettings settings, std::span<const std::string> texts) {
    for (const std::string& text : texts) {
        const auto [effect, name] = parse_technique(text);
        choose_technique(effect, name, settings);
    }
    for (const std::string& text : texts) {
        const auto [effect, name] = parse_technique(text);
        if (!is_chosen(effect, name, settings)) refuse(text, kUnlikePhotons);
    }
    return settings;
}

}  // namespace voxilux
