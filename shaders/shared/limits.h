// Every bound and tolerance shared by the shaders and the engine: its value, unit and reason.
#ifndef VX_LIMITS_H
#define VX_LIMITS_H

#include "portable.h"

VX_BEGIN

// Numbers in [0, 1) are drawn as multiples of 2^-24, half an ulp of a float below 1.
VX_CONST(float, kUnitSteps, 16777216.0f);            // 2^24
VX_CONST(float, kUnitStep, 5.9604644775390625e-8f);  // 2^-24

// Sampling. Dimensions of the Halton sequence that have a prime base; the rest are white noise, because two
// large bases stay correlated until about their product of points is drawn.
VX_CONST(uint, kHaltonDimensions, 12u);
// Frames after which the Halton sequence starts again; a power of two.
VX_CONST(uint, kHaltonPeriod, 8192u);
// Digits of the largest index, kHaltonPeriod, in the smallest base: 8192 is 14 binary digits.
VX_CONST(uint, kHaltonDigitsMax, 14u);
// Largest deviation of the length of a sampled direction from 1: a few roundings of 2^-24.
VX_CONST(float, kUnitLengthError, 5.0e-7f);

// Film. Fraction bits of a film sum: one unit is 2^-24, half an ulp of a float near 1.
VX_CONST(int, kFilmFractionBits, 24);
// Largest magnitude that one sample adds to a film sum: the largest float below 2^19, so that 2^20 samples of
// it stay below the 2^39 where a signed 64-bit sum with 24 fraction bits ends. Larger samples are clamped and
// counted.
VX_CONST(float, kFilmMaxValue, 524287.96875f);

// March. A direction component below this counts as zero: over 2^24 cells it moves a ray by less than 2^-36
// voxel.
VX_CONST(float, kMinDirection, 8.673617e-19f);  // 2^-60
// Inverse direction on an axis along which the ray does not advance: j * kNeverCrossed is later than any real
// crossing, which is below 2^24 / kMinDirection = 2e25, and finite for j < 2^24.
VX_CONST(float, kNeverCrossed, 1.0e30f);
// Largest underestimate of a plane count, in planes. Above the rounding error of a position (2^-23 of at most
// 2^15 cells) and below 1, so that one comparison of crossing times corrects it.
VX_CONST(float, kPlaneMargin, 0.015625f);
// Steps of a march beyond the number of planes of the world: for entering, leaving, and the border box.
VX_CONST(uint, kMarchSlack, 3u);
// t_max of an unbounded ray; every crossing time is below.
VX_CONST(float, kUnbounded, 3.0e38f);

// Beams (beam.h). Error of directions, positions and times relative to the distance: 2^-18, tens of
// times the roundings of 2^-24 that cause it.
VX_CONST(float, kBeamError, 3.814697265625e-6f);
// Factor of a beam's spread: far more than the rounding of an image position, relative to a tile.
VX_CONST(float, kBeamMargin, 1.001f);
// Voxels between a beam and the faces of its box: more than the rounding of a fraction of a cell.
VX_CONST(float, kBeamPad, 0.015625f);
// A beam wider than this may contain directions farther from the axis than the corners of its tile.
VX_CONST(float, kWidestBeam, 1.0f);
// A beam that gains fewer voxels than this in a step ends.
VX_CONST(float, kBeamGain, 1.0f);
// Steps of a beam. A beam that ends early only makes its rays start earlier.
VX_CONST(uint, kBeamSteps, 64u);
// Distance in voxels at which empty space beyond the world ends for a beam: beyond every world and camera.
VX_CONST(float, kBeamEnd, 1.073741824e9f);  // 2^30

// Last word of a world array that shaders can read: 8 GiB.
VX_CONST(uint, kLastWorldWord, 0x7FFFFFFEu);

// Rays that reach the world later than this many voxels count as misses: beyond it two_float.h leaves its
// domain.
VX_CONST(float, kFarthestEntry, 1.099511627776e12f);  // 2^40
// Largest count of planes that a ray has crossed when it reaches the world: more do not fit an int, and such
// a ray misses every world.
VX_CONST(float, kFarthestPlanes, 1.073741824e9f);  // 2^30

// Depth of a pixel where the camera sees no surface, in voxels: finite, and beyond every scene.
VX_CONST(float, kMissDepth, 1.0e10f);
VX_CONST(float, kPi, 3.14159265f);

// Hits on the ground farther than this from the world's corner, in voxels, are moved to this distance: their
// cells must fit an int.
VX_CONST(float, kFarthestGround, 1.073741824e9f);  // 2^30

// Blocks of pixels (projection.h): the least distance of a sample from the border of its block: 2^-24, the
// spacing of samples. A sample on the border would belong to the neighbouring pixel.
VX_CONST(float, kPixelInset, 5.9604644775390625e-8f);
VX_CONST(float, kInversePi, 0.318309886f);

// Invocations of a workgroup over a list (lib/invocation.glsl).
VX_CONST(uint, kLinearGroup, 64u);

// Ambient occlusion in a hash. Levels of cells: the largest is a whole voxel face, so that no cell reaches
// across a wall; the smallest is 1/16 of its edge, as far as the bits of a key allow.
VX_CONST(uint, kAoLevels, 5u);
// Parts of a face over all levels: (4^kAoLevels - 1) / 3.
VX_CONST(uint, kAoFaceParts, 341u);
// Largest edge of a world whose voxels a key can tell apart, voxels.
VX_CONST(int, kAoMaxEdge, 131072);
// Slots from its home on that may hold a cell. When two fifths of the slots are in use, a cell finds all of
// its slots taken about once in 10^6 times; with a third, less than once in 10^7.
VX_CONST(uint, kCellProbes, 32u);
// Frames after which an unseen cell may be released. Longer than a touch may be late (kCellTouchPeriod).
VX_CONST(uint, kCellMaxAge, 32u);
// The same when the table fills up. Longer than a touch may be late (kCellTouchPeriod).
VX_CONST(uint, kCellMinAge, 16u);
VX_CONST(uint, kCellTouchPeriod, 8u);  // frames; a power of two
// Standard deviations beyond which two visibility values count as different. SVGF (Schied et al. 2017,
// section 4.4) uses 4 for luminance.
VX_CONST(float, kAoFilterSigmas, 4.0f);

// Spheres that are tested in an unrolled loop. 16 kB, the size of a uniform block that every device supports,
// hold 455; beyond 16 the loop gets too long to be unrolled.
VX_CONST(uint, kFewSpheres, 16u);

// Groups of nodes that wait while a ray walks the hierarchy over spheres (sphere_tree.h), one for each level
// but the last two: eight children a node hold 8^9 spheres. Each takes 2 % of a step.
VX_CONST(uint, kTreeStack, 8u);
// Extra size of the boxes around spheres, relative to the distance of the ray's origin. Crossings are
// computed with a few roundings of 2^-24 of that distance, so a ray may hit a sphere that it misses by as
// much.
VX_CONST(float, kSphereSlack, 2.0e-6f);
// Smaller components of a direction count as this value in box tests, so that their inverse is finite.
VX_CONST(float, kLeastSlope, 1.0e-20f);

// Length in voxels of a ray that only tests what its first cell holds: not 0, but shorter than any exit from
// a cell.
VX_CONST(float, kProbeLength, 1.0e-30f);
// Surfaces that one path may hit. Roulette ends all paths except those between perfect mirrors, which never
// end.
VX_CONST(uint, kMaxBounces, 4096u);
// Steps of the loop of an invocation that traces photons one after the other.
VX_CONST(uint, kMaxPhotonSteps, 16777216u);
// Minimum bounces of a path from the camera before roulette, which costs more noise there than it saves time.
VX_CONST(uint, kSureBounces, 8u);

// Largest distance of two directions that would be equal without rounding: several roundings of 2^-24 at each
// of several mirrors. A sun of 0.05 degrees is 400 times as wide.
VX_CONST(float, kDirectionError, 1.0e-6f);
// Surfaces that a path of path_trace may hit: one between walls of albedo 0.999 hits more once in 10^28.
VX_CONST(uint, kMaxPathSurfaces, 65536u);
// Turns of all loops after which an invocation of path_trace ends its round: three quarters of what lavapipe
// allows (lib/loops.glsl). The rest is for the current march.
VX_CONST(uint, kRoundTurns, 49152u);

// Glass. Largest ratio of two indices of refraction: scene files allow 1 to 4, so ratios are in [1/4, 4].
VX_CONST(float, kMaxEta, 16.0f);

// Rough surfaces. Below this roughness they are smooth: microfacets then lean by 10^-4 radians, a fiftieth of
// the sun's radius, and directions in floats still tell them apart.
VX_CONST(float, kMinRoughness, 0.01f);
// The same for glass that hardly bends light, for which half vectors lose bits: microfacets of roughness
// alpha turn light by about alpha * |eta - 1| radians.
VX_CONST(float, kMinSpread, 1.0e-5f);
// Places on a row of gains (bsdf.h), and the widest scale on which they get denser. A white metal then keeps
// its light within 0.5 %, glass of ior 1.3 or more within 1 %. Towards ior 1 very rough glass errs more: 2 %
// at 1.1, near the horizon.
VX_CONST(uint, kGainPlaces, 32u);
VX_CONST(float, kGainScale, 0.25f);

// Photons. Smallest radius of a kernel, in voxels: the spacing of floats between 1024 and 2048. A smaller
// kernel would measure the rounding of positions.
VX_CONST(float, kMinPhotonRadius, 1.220703125e-4f);  // 2^-13
// Factor by which a kernel is widened when its cells are looked up: several roundings of a distance.
VX_CONST(float, kPhotonReach, 1.00000095367431640625f);  // 1 + 2^-20
// Index of the farthest cell of photons, which also takes everything beyond.
VX_CONST(float, kFarthestPhotonCell, 1.073741824e9f);  // 2^30
// Cells along x in the width of a cell along y and z: fewer photons to test, more buckets.
VX_CONST(float, kPhotonCellParts, 2.0f);
// Marks, per bucket, of cells that visible points touch; a power of two. The unseen part of a room has
// several times the cells of the seen one: with one mark per bucket and few buckets, up to half as many
// photons again would be stored.
VX_CONST(uint, kMarksPerBucket, 8u);
// Visible points gather together when they are at most this many radii apart.
VX_CONST(float, kGatherSpread, 4.0f);
// A sphere cuts the kernel of a point only where the sine of the angle between their surfaces is above this:
// nearly parallel surfaces either coincide or are apart, and where they cross is rounding error.
VX_CONST(float, kMinSlope, 0.001f);
// Smallest fraction of a kernel that is assumed to receive photons: what a corner of three walls leaves. In
// narrower corners cuts are not independent, and dividing by less would amplify noise.
VX_CONST(float, kMinShare, 0.25f);
// Workgroups along x of an indirect dispatch; the others go along y. The smallest limit that Vulkan allows.
VX_CONST(uint, kMaxGroups, 65535u);

VX_END

#endif
