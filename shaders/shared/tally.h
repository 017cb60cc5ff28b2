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
VX_CONST(uint, kFaultCount, 4u);

VX_CONST(uint, kWorkHits, 4u);     // camera rays that hit something
VX_CONST(uint, kWorkAoRays, 5u);   // occlusion rays marched
VX_CONST(uint, kWorkSunRays, 6u);  // shadow rays marched
VX_CONST(uint, kTallyCount, 7u);

VX_END

#ifdef __cplusplus
namespace voxilux::gpu {
inline constexpr const char* kTallyNames[kTallyCount] = {
    "ray_unsound", "march_exhausted", "film_clamped", "film_non_finite", "hits", "ao_rays", "sun_rays"};
}
#endif

#endif
