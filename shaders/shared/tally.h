// Numbers that shaders count and the host reads back after every recording: faults, which are all zero in a
// good run, and work done.
#ifndef VX_TALLY_H
#define VX_TALLY_H

#include "portable.h"

VX_BEGIN

VX_CONST(uint, kFaultRayUnsound, 0u);      // a ray that is not finite or has no direction
VX_CONST(uint, kFaultMarchExhausted, 1u);  // a march that met its step limit
VX_CONST(uint, kFaultFilmClamped, 2u);     // a sample above kFilmMaxValue
VX_CONST(uint, kFaultFilmNonFinite, 3u);   // a sample that is NaN or infinite; it counts as zero
VX_CONST(uint, kFaultAoTableFull, 4u);     // hits that found no slot for their cell: they used their own rays
VX_CONST(uint, kFaultPhotonStoreFull, 5u);  // photons that found no room in the store: they are lost
VX_CONST(uint, kFaultPhotonPower, 6u);      // photons whose power or place was out of range: clamped or lost
VX_CONST(uint, kFaultPathTooLong, 7u);      // paths that met kMostBounces surfaces, and ended there
VX_CONST(uint, kFaultLoopCut, 8u);          // paths or sums that the device cut off (lib/loops.glsl)
VX_CONST(uint, kFaultCount, 9u);

VX_CONST(uint, kWorkHits, 9u);      // camera rays that hit something
VX_CONST(uint, kWorkAoRays, 10u);   // occlusion rays marched
VX_CONST(uint, kWorkSunRays, 11u);  // shadow rays marched
// Of the ambient occlusion hash:
VX_CONST(uint, kWorkAoReused, 12u);       // hits whose cell was found by reprojection
VX_CONST(uint, kWorkAoSearches, 13u);     // hits whose cell was searched in the table
VX_CONST(uint, kWorkAoProbes, 14u);       // keys looked at in those searches
VX_CONST(uint, kWorkAoClaimed, 15u);      // cells entered
VX_CONST(uint, kWorkAoEvicted, 16u);      // cells given up
VX_CONST(uint, kWorkAoDropped, 17u);      // samples that were in them; saturates at 2^32 - 1 for each cell
VX_CONST(uint, kWorkAoOwnRays, 18u);      // occlusion rays that no cell took
VX_CONST(uint, kWorkAoSwaps, 19u);        // compare-and-swaps of keys
VX_CONST(uint, kWorkPhotonsStored, 20u);  // photons that found room in the store
VX_CONST(uint, kWorkPathSegments, 21u);   // ways from surface to surface, and shadow rays to lamps
VX_CONST(uint, kTallyCount, 22u);

VX_END

#ifdef __cplusplus
namespace voxilux::gpu {
inline constexpr const char* kTallyNames[kTallyCount] = {
    "ray_unsound",       "march_exhausted", "film_clamped",  "film_non_finite", "ao_table_full",
    "photon_store_full", "photon_power",    "path_too_long", "loop_cut",        "hits",
    "ao_rays",           "sun_rays",        "ao_reused",     "ao_searches",     "ao_probes",
    "ao_claimed",        "ao_evicted",      "ao_dropped",    "ao_own_rays",     "ao_swaps",
    "photons_stored",    "path_segments"};
}
#endif

#endif
