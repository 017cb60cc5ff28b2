// The hits of rough visible points, whose light the path finds: black to all other passes, because they look
// like those of rays that start inside a voxel. Hit::sphere tells where they are, by numbers that no sphere has.
#ifndef VX_BLACK_HIT_GLSL
#define VX_BLACK_HIT_GLSL

#include "shared/gpu_types.h"
#include "shared/sampling.h"

const uint kBlackSphere = 0x80000000u;             // and the sphere
const uint kBlackFace = 0xFFFFFFFFu - kFaceCount;  // and the face of a voxel

Hit black_hit(Hit hit) {
    bool on_voxel = hit.face < kFaceCount;
    hit.sphere = on_voxel ? kBlackFace + hit.face : kBlackSphere + hit.sphere;
    hit.face = kFaceInside;
    return hit;
}

// The hit as it was, except that a sphere is seen from outside.
Hit true_hit(Hit hit) {
    if (hit.face != kFaceInside || hit.sphere < kBlackSphere) return hit;
    bool on_voxel = hit.sphere >= kBlackFace;
    hit.face = on_voxel ? hit.sphere - kBlackFace : kFaceSphere;
    hit.sphere = on_voxel ? kNoSphere : hit.sphere - kBlackSphere;
    return hit;
}

#endif
