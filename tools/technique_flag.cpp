#include "technique_flag.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/technique_choice.h"

namespace voxilux {
namespace {

[[noreturn]] void refuse_technique(std::string_view text, const std::string& why) {
    throw Error(ExitCode::usage, fmt::format("--technique: '{}' {}", text, why));
}

}  // namespace

NamedTechnique parse_technique(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) refuse_technique(text, "must be EFFECT=NAME, such as ao=hash");
    const std::vector<std::string_view> effects = effects_with_techniques();
    const auto effect = std::ranges::find(effects, text.substr(0, equals));
    if (effect == effects.end())
        refuse_technique(text,
                         "names no effect with techniques" + name_hint(text.substr(0, equals), effects));
    const std::vector<std::string_view> names = technique_names(*effect);
    const auto name = std::ranges::find(names, text.substr(equals + 1));
    if (name == names.end())
        refuse_technique(text, fmt::format("names no technique of {}{}", *effect,
                                           name_hint(text.substr(equals + 1), names)));
    return {*effect, *name};
}

std::string technique_help() {
    std::string help = "how an effect is computed";
    for (const std::string_view effect : effects_with_techniques())
        help += fmt::format("; {}: {}", effect, fmt::join(technique_names(effect), ", "));
    return help + "; may repeat";
}

void choose_techniques(std::span<const NamedTechnique> named, RenderSettings& settings) {
    for (const auto& [effect, name] : named)
        choose_technique(effect, name, settings);
    for (const auto& [effect, name] : named)
        if (!is_chosen(effect, name, settings))
            refuse_technique(fmt::format("{}={}", effect, name), kUnlikePhotons);
}

}  // namespace voxilux
