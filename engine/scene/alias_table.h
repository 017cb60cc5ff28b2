#pragma once

#include <span>
#include <vector>

#include "shared/alias.h"

namespace voxilux {

// The table that draws i with a probability in proportion to powers[i] (shared/alias.h); empty when there is
// no power. The powers are finite and >= 0, fewer than 2^32. Probabilities are rounded by at most 2^-24;
// `pdf` is the probability with which the rounded table draws: nothing without power is drawn and nothing
// with power is lost. Source: Vose 1991, "A Linear Algorithm for Generating Random Numbers with a Given
// Distribution".
[[nodiscard]] std::vector<gpu::AliasEntry> build_alias_table(std::span<const double> powers);

}  // namespace voxilux
