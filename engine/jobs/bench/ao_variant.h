#pragma once

// The ways of finding occlusion that `bench ao` compares.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace voxilux {

struct AoVariant {
    std::string name;
    AoSettings ao;
    Sequence sequence = Sequence::sobol;
};

// The one that the others are compared with: rays for each pixel alone, and no memory of earlier frames.
inline constexpr const char* kAoBaseline = "brute";

// Brute force, the hash as it is by default, and the hash with one option changed.
[[nodiscard]] const std::vector<AoVariant>& ao_variants();

// The variants of these names, each once; all of them for no name. Throws Error(usage) for a name that does
// not exist.
[[nodiscard]] std::vector<AoVariant> ao_variants_named(std::span<const std::string> names);

// Whether a variant is the hash with a width of cells and no other change: they have a bias of their own.
[[nodiscard]] bool sets_only_width(const AoVariant& variant);

}  // namespace voxilux
