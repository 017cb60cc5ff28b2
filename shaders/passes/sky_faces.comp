#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// Irradiance / pi of the six faces of an unoccluded voxel under the sky: a face per invocation.

#include "lib/invocation.glsl"
#include "lib/sky.glsl"
#include "shared/sampling.h"

layout(scalar) writeonly buffer SkyFaces {
    vec3 sky_faces[];
};

void main() {
    uint face = linear_id();
    if (face >= kFaceCount) return;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kFaceRays; ++i) {
        FaceRay ray = face_ray(sky, i);
        sum += max(dot(ray.direction, face_normal(face)), 0.0) * ray.weight * sky_radiance(sky, ray.direction);
    }
    sky_faces[face] = sum * kInversePi;
}
