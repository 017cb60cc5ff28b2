#pragma once

// The variants of occlusion that `bench ao` compares.

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace voxilux {

struct AoVariant {
    std::string name;
    AoSettings ao;
    Sequence sequence = Sequence::sobol;

    bool operator==(const AoVariant&) const = default;
};

// The baseline: rays for each pixel alone, and no memory of earlier frames.
inline constexpr const char* kAoBaseline = "brute";

// Brute force, the hash as it is by default, and the hash with one option changed.
[[nodiscard]] const std::vector<AoVariant>& ao_variants();

// The variant of that name; Error(usage) with the known names when there is none.
[[nodiscard]] const AoVariant& ao_variant_named(std::string_view name);

// Whether a variant is the hash with another cell width and no other change: such variants have a bias of
// their own.
[[nodiscard]] bool sets_only_width(const AoVariant& variant);

}  // namespace voxilux
