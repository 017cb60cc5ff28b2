// Every bound and tolerance the shaders and the engine share: its value, unit and reason.
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
// How far the length of a sampled direction may be from 1: a few roundings of 2^-24.
VX_CONST(float, kUnitLengthError, 5.0e-7f);

// Film. Fraction bits of a film sum: one unit is 2^-24, half an ulp of a float near 1.
VX_CONST(int, kFilmFractionBits, 24);
// Largest magnitude that one sample adds to a film sum: the float below 2^19, so 2^20 samples of it stay
// below the 2^39 where a signed 64-bit sum with 24 fraction bits ends. Larger samples are clamped and
// counted.
VX_CONST(float, kFilmMaxValue, 524287.96875f);

// March. A direction component below this counts as zero: over 2^24 cells it moves a ray by less than 2^-36
// voxel.
VX_CONST(float, kMinDirection, 8.673617e-19f);  // 2^-60
// Pace of an axis that the ray does not advance on: j * kNeverCrossed is later than any real crossing, which
// is below 2^24 / kMinDirection = 2e25, and finite for j < 2^24.
VX_CONST(float, kNeverCrossed, 1.0e30f);
// How far a plane count may be underestimated, in planes. Above the rounding error of a position (2^-23 of at
// most 2^15 cells) and below 1, so that one comparison of crossing times corrects it.
VX_CONST(float, kPlaneMargin, 0.015625f);
// Steps of a march beyond the number of planes of the world: entering, leaving, and the border box.
VX_CONST(uint, kMarchSlack, 3u);
// t_max of a ray without end; every crossing time is below.
VX_CONST(float, kUnbounded, 3.0e38f);

// Beams (beam.h). Error of directions, positions and times relative to the distance: 2^-18, tens of times the
// roundings of 2^-24 that they are made of.
VX_CONST(float, kBeamError, 3.814697265625e-6f);
// Factor of a beam's spread: the rounding of a point of the picture, relative to a tile of it, stays far
// below.
VX_CONST(float, kBeamMargin, 1.001f);
// Voxels between a beam and the faces of its box: the rounding of a fraction of a cell, and room.
VX_CONST(float, kBeamPad, 0.015625f);
// A direction that is further from the axis than this may lie between corners of the tile that are nearer.
VX_CONST(float, kWidestBeam, 1.0f);
// A beam that gains less than this many voxels in a step ends.
VX_CONST(float, kBeamGain, 1.0f);
// Steps of a beam. Ending early only means a later hit.
VX_CONST(uint, kBeamSteps, 64u);
// Voxels to where empty space beyond the world ends for a beam: beyond every world and camera.
VX_CONST(float, kBeamEnd, 1.073741824e9f);  // 2^30

// Last word of an array of the world that shaders read: 8 GiB.
VX_CONST(uint, kLastWorldWord, 0x7FFFFFFEu);

// Rays that reach the world later than this many voxels count as misses: beyond it two_float.h leaves its
// domain.
VX_CONST(float, kFarthestEntry, 1.099511627776e12f);  // 2^40
// Planes that a ray has crossed when it reaches the world are counted up to here: more do not fit an int, and
// a ray that has crossed as many is beside every world.
VX_CONST(float, kFarthestPlanes, 1.073741824e9f);  // 2^30

// Depth of a pixel where the camera sees no surface, in voxels: finite, and beyond every scene.
VX_CONST(float, kMissDepth, 1.0e10f);
VX_CONST(float, kPi, 3.14159265f);

// Voxels from the world's corner to where hits on the ground are placed that are farther still: their cells
// are integers.
VX_CONST(float, kFarthestGround, 1.073741824e9f);  // 2^30

// Blocks of pixels (projection.h): a sample lies at least so far inside its block, 2^-24, the spacing of
// samples. One on the border would belong to the pixel beside.
VX_CONST(float, kPixelInset, 5.9604644775390625e-8f);
VX_CONST(float, kInversePi, 0.318309886f);

// Invocations of a workgroup over a list (lib/invocation.glsl).
VX_CONST(uint, kLinearGroup, 64u);

// Ambient occlusion in a hash. Levels of cells: the largest is a whole face of a voxel, so that no cell
// reaches across a wall, the smallest 1/16 of its edge, what the bits of a key leave.
VX_CONST(uint, kAoLevels, 5u);
// Parts of a face over all levels: (4^kAoLevels - 1) / 3.
VX_CONST(uint, kAoFaceParts, 341u);
// Worlds that keys can tell the voxels of: edges up to here, voxels.
VX_CONST(int, kAoMaxEdge, 131072);
// Slots from its home on that may hold a cell. With two fifths of the slots taken, a cell finds them all
// taken by others about once in 10^6 times, with a third of them less than once in 10^7.
VX_CONST(uint, kCellProbes, 32u);
// Frames after which a cell that nobody sees may be given up. Longer than a touch may be late
// (kCellTouchPeriod).
VX_CONST(uint, kCellMaxAge, 32u);
// The same when the table fills up. Longer than a touch may be late (kCellTouchPeriod).
VX_CONST(uint, kCellMinAge, 16u);
VX_CONST(uint, kCellTouchPeriod, 8u);  // frames; a power of two
// Standard deviations beyond which two visibility values are taken to differ. SVGF (Schied et al. 2017,
// section 4.4) uses 4 for luminance.
VX_CONST(float, kAoFilterSigmas, 4.0f);

// Spheres that are tested in an unrolled loop. 16 kB, what every device takes as a uniform block, hold 455;
// beyond 16 the loop gets too long to be unrolled.
VX_CONST(uint, kFewSpheres, 16u);

// By how much of the distance from which a sphere is looked at, boxes around spheres are larger than these.
// Crossings are found with a few roundings of 2^-24 of that distance, so a ray may hit a sphere that it
// misses by as much.
VX_CONST(float, kSphereSlack, 2.0e-6f);
// Components of directions below it are taken for it where a box is met: nothing is as long as its inverse.
VX_CONST(float, kLeastSlope, 1.0e-20f);

// Length of a ray that only asks what its first cell holds, voxels: shorter than any way out of a cell but
// none.
VX_CONST(float, kProbeLength, 1.0e-30f);
// Surfaces that one path may meet. Roulette ends all but those between perfect mirrors, which never end.
VX_CONST(uint, kMaxBounces, 4096u);
// Steps of the loop of an invocation that traces photons one after the other.
VX_CONST(uint, kMaxPhotonSteps, 16777216u);
// Surfaces that a path from the camera meets before roulette may end it: it costs more noise than time there.
VX_CONST(uint, kSureBounces, 8u);

// How far two directions may lie apart that would be one without rounding: some roundings of 2^-24 at each of
// several mirrors. A sun of 0.05 degrees is 400 times as wide.
VX_CONST(float, kDirectionError, 1.0e-6f);
// Surfaces that a path of path_trace may meet: one between walls of albedo 0.999 meets more once in 10^28.
VX_CONST(uint, kMaxPathSurfaces, 65536u);
// Turns of all loops after which an invocation of path_trace ends its round: three quarters of what lavapipe
// allows (lib/loops.glsl). What is left is for the march that it is in.
VX_CONST(uint, kRoundTurns, 49152u);

// Glass. Largest ratio of two indices of refraction: scene files allow 1 to 4, so that ratios lie in [1/4,
// 4].
VX_CONST(float, kMaxEta, 16.0f);

// Photons. Smallest radius of a gather, in voxels: the distance of neighbouring floats between 1024 and 2048.
// A smaller disc would measure the rounding of positions.
VX_CONST(float, kMinPhotonRadius, 1.220703125e-4f);  // 2^-13
// Factor by which a disc is widened when its cells are looked up: several roundings of a distance.
VX_CONST(float, kPhotonReach, 1.00000095367431640625f);  // 1 + 2^-20
// Number of the farthest cell of photons; what lies beyond is in it, too.
VX_CONST(float, kFarthestPhotonCell, 1.073741824e9f);  // 2^30
// Cells along x in the width of a cell along y and z: fewer photons to look at, more buckets.
VX_CONST(float, kPhotonCellParts, 2.0f);
// Marks of cells that visible points touch, for each bucket; a power of two. A room's unseen part has several
// times the cells of the seen one: with one mark for each of few buckets, up to half as many photons again
// would be stored.
VX_CONST(uint, kMarksPerBucket, 8u);
// Visible points gather together when they are no farther apart than this many radii.
VX_CONST(float, kGatherSpread, 4.0f);
// A sphere cuts the disc of a point only where the sine of the angle between their surfaces is above this:
// nearly parallel surfaces lie on each other or are apart, and where they cross is rounding.
VX_CONST(float, kMinSlope, 0.001f);
// A disc counts as no less than this share of it: what a corner of three walls leaves. In narrower corners
// cuts are not independent, and dividing by less would amplify noise.
VX_CONST(float, kMinShare, 0.25f);
// Workgroups along x of an indirect dispatch; the others go along y. The least limit that Vulkan allows.
VX_CONST(uint, kMaxGroups, 65535u);

VX_END

#endif
