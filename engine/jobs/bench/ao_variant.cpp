#include "jobs/bench/ao_variant.h"

#include "jobs/bench/item_named.h"

namespace voxilux {
namespace {

AoSettings hash() {
    return {.method = AoMethod::hash};
}

template <class Value>
AoSettings hash_with(Value AoSettings::*member, Value value) {
    AoSettings ao = hash();
    ao.*member = value;
    return ao;
}

std::vector<AoVariant> make_variants() {
    const AoSettings by_pixel = hash_with(&AoSettings::by_pixel, true);
    std::vector<AoVariant> variants = {
        {kAoBaseline, {.method = AoMethod::brute}},
        {"hash", hash()},
        {"reproject", hash_with(&AoSettings::reproject, std::optional(true))},
        {"split", hash_with(&AoSettings::merged, std::optional(false))},
        {"checkerboard", hash_with(&AoSettings::checkerboard, true)},
        {"limit-4096", hash_with(&AoSettings::sample_limit, 4096u)},
        {"px-5", hash_with(&AoSettings::cell_px, 5.0f)},
        {"px-16", hash_with(&AoSettings::cell_px, 16.0f)},
        {"cell-halton", hash(), Sequence::halton},
        {"cell-white", hash(), Sequence::white},
        {"pixel-sobol", by_pixel},
        {"pixel-halton", by_pixel, Sequence::halton},
        {"pixel-white", by_pixel, Sequence::white},
    };
    for (std::uint32_t i = 1; i <= 4; ++i)
        variants.push_back({fmt::format("filter-{}", i), hash_with(&AoSettings::filter, i)});
    return variants;
}

}  // namespace

const std::vector<AoVariant>& ao_variants() {
    static const std::vector<AoVariant> variants = make_variants();
    return variants;
}

const AoVariant& ao_variant_named(std::string_view name) {
    return item_named("variant", name, ao_variants(), &AoVariant::name);
}

bool sets_only_width(const AoVariant& variant) {
    return variant.ao == hash_with(&AoSettings::cell_px, variant.ao.cell_px) &&
           variant.sequence == Sequence::sobol;
}

}  // namespace voxilux
