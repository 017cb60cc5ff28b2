// Counters of the shaders, which the host reads back after every recording: faults, which are all zero in a
// good run, and work done. VX_COUNTER(constant, number, name in reports); defines one. Numbers have no gaps;
// C++ refuses to compile when a number is missing or used twice.
#ifndef VX_COUNTERS_H
#define VX_COUNTERS_H

#include "portable.h"

#ifdef __cplusplus
#include <array>
#include <utility>

namespace voxilux::gpu {
template <uint number>
inline constexpr const char* kCounterName = nullptr;
}
#define VX_COUNTER(constant, number, name)   \
    inline constexpr uint constant = number; \
    template <>                              \
    inline constexpr const char* kCounterName<number> = #name
#else
#define VX_COUNTER(constant, number, name) const uint constant = number
#endif

VX_BEGIN

VX_COUNTER(kFaultRayUnsound, 0u, ray_unsound);          // a ray that is not finite or has no direction
VX_COUNTER(kFaultMarchExhausted, 1u, march_exhausted);  // a march that reached its step limit
VX_COUNTER(kFaultFilmClamped, 2u, film_clamped);        // a sample above kFilmMaxValue
VX_COUNTER(kFaultFilmNonFinite, 3u, film_non_finite);   // a sample that is NaN or infinite; it counts as zero
VX_COUNTER(kFaultAoTableFull, 4u,
           ao_table_full);  // hits without a slot for their cell: they used their own rays
VX_COUNTER(kFaultPhotonStoreFull, 5u, photon_store_full);  // photons that did not fit in the store, lost
VX_COUNTER(kFaultPhotonPower, 6u, photon_power);   // power or position out of range: photon clamped or lost
VX_COUNTER(kFaultPathTooLong, 7u, path_too_long);  // paths that hit kMaxBounces surfaces and ended there
VX_COUNTER(kFaultLoopCut, 8u, loop_cut);           // paths or sums that the device cut off (lib/loops.glsl)
VX_CONST(uint, kFaultCount, kFaultLoopCut + 1u);

VX_COUNTER(kWorkHits, 9u, hits);          // camera rays that hit something
VX_COUNTER(kWorkAoRays, 10u, ao_rays);    // occlusion rays marched
VX_COUNTER(kWorkSunRays, 11u, sun_rays);  // shadow rays marched
// Of the ambient occlusion hash:
VX_COUNTER(kWorkAoReused, 12u, ao_reused);            // hits whose cell was found by reprojection
VX_COUNTER(kWorkAoSearches, 13u, ao_searches);        // hits whose cell was searched in the table
VX_COUNTER(kWorkAoProbes, 14u, ao_probes);            // keys compared in those searches
VX_COUNTER(kWorkAoClaimed, 15u, ao_claimed);          // cells inserted
VX_COUNTER(kWorkAoEvicted, 16u, ao_evicted);          // cells released
VX_COUNTER(kWorkAoDropped, 17u, ao_dropped);          // samples lost with them; at most 2^32 - 1 per cell
VX_COUNTER(kWorkAoOwnRays, 18u, ao_own_rays);         // occlusion rays that belong to no cell
VX_COUNTER(kWorkAoSwaps, 19u, ao_swaps);              // compare-and-swaps of keys
VX_COUNTER(kWorkPhotonsStored, 20u, photons_stored);  // photons put into the store
VX_COUNTER(kWorkPathSegments, 21u,
           path_segments);  // path segments, and shadow rays to emitters
VX_CONST(uint, kCounterCount, kWorkPathSegments + 1u);

VX_END

#ifdef __cplusplus
namespace voxilux::gpu {
inline constexpr auto kCounterNames = []<uint... numbers>(std::integer_sequence<uint, numbers...>) {
    static_assert(((kCounterName<numbers> != nullptr) && ...), "a number below kCounterCount has no counter");
    static_assert(kCounterName<kCounterCount> == nullptr, "kCounterCount is the number of a counter");
    return std::array{kCounterName<numbers>...};
}
(std::make_integer_sequence<uint, kCounterCount>());
}  // namespace voxilux::gpu
#endif

#endif
