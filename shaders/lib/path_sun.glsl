// The directions from which sunlight reaches a surface, images of the sun included. Include lib/path.glsl
// first.
//
// Sunlight through voxels of glass and off mirrors: faces are axis-aligned, so a mirror flips one sign of
// a direction, and glass keeps the direction of light that leaves by a face parallel to the one it entered
// by. Light therefore arrives from one of eight cones, the sun's own and its images; at a surface in glass,
// from these cones as refracted by a face across one of the three axes. From a surface in air one ray goes
// into the sun's cone and one into another cone; from a surface in glass, one ray goes into any of them.
// These rays may pass mirrors and glass. Light by way of spheres, and light that leaves glass by another
// face, is found by random paths only.
#ifndef VX_PATH_SUN_GLSL
#define VX_PATH_SUN_GLSL

VX_SPECIALIZED(uint, has_images, 0u);  // by voxels of glass and mirrors

// Copies of the frame's values, because lavapipe would load these anew in every turn of a loop
// (shaders/README.md).
vec3 sun_direction;
float sun_height;
float sun_reach;  // the same, widened by the rounding of a direction

void init_sun_images() {
    sun_direction = frame.sun_direction;
    sun_height = frame.sun_cone_height;
    float chord = sqrt(2.0 * sun_height) + kDirectionError;
    sun_reach = 0.5 * chord * chord;
}

vec3 image_direction(uint image) {
    uvec3 flips = uvec3(image & 1u, image & 2u, image & 4u);
    return sun_direction * vec3(flips.x != 0u ? -1.0 : 1.0, flips.y != 0u ? -1.0 : 1.0, flips.z != 0u ? -1.0 : 1.0);
}

const uint kImages = 8u;       // the sun itself included
const uint kAxes = 3u;
const float kOwnShare = 0.75;  // of the rays out of glass: into the sun's own cone, which brings most light

// Probability with which a ray out of glass goes into a cone by one of the axes.
float glass_image_share(uint image) {
    return (image == 0u ? kOwnShare : (1.0 - kOwnShare) / float(kImages - 1u)) / float(kAxes);
}

struct GlassImage {
    uint image;
    uint axis;
};

GlassImage draw_glass_image(float u) {
    bool is_own = u < kOwnShare;
    float rest = is_own ? u / kOwnShare : (u - kOwnShare) / (1.0 - kOwnShare);
    uint images = is_own ? 1u : kImages - 1u;
    uint drawn = min(uint(rest * float(kAxes * images)), kAxes * images - 1u);
    GlassImage result;
    result.image = is_own ? 0u : 1u + drawn % images;
    result.axis = drawn / images;
    return result;
}

// A direction refracted by a face across `axis`, where `eta` is the index of refraction behind the face
// divided by that before it. Zero at total reflection.
vec3 across_face(vec3 direction, uint axis, float eta) {
    vec3 along = direction / eta;
    along = vec3(axis == 0u ? 0.0 : along.x, axis == 1u ? 0.0 : along.y, axis == 2u ? 0.0 : along.z);
    float square = 1.0 - dot(along, along);
    if (!(square > 0.0)) return vec3(0.0);
    float through = sqrt(square) * (direction[axis] < 0.0 ? -1.0 : 1.0);
    return along + through * face_normal(2u * axis + 1u);
}

// Number of the sun's images, from `first` on, that contain a direction.
float images_in(vec3 direction, uint first) {
    float images = 0.0;
    for (uint image = first; image < kImages; ++image)
        images += is_in_cone(direction, image_direction(image), sun_reach) ? 1.0 : 0.0;
    return images;
}

// For Walk::image_share: the density of rays into a direction, times the solid angle of the sun. Refraction
// at a face multiplies it by eta^2 cos / cos' (Snell's law).
float samples_of_sun(vec3 direction, uint medium) {
    float own = is_in_cone(direction, sun_direction, sun_reach) ? 1.0 : 0.0;
    if (has_images == 0u) return own;
    float samples = own + images_in(direction, 1u) / float(kImages - 1u);
    if (has_glass_voxels == 0u || medium == kNoMedium) return samples;
    float ior = material_ior(medium);
    samples = 0.0;
    for (uint axis = 0u; axis < kAxes; ++axis) {
        vec3 outside = across_face(direction, axis, 1.0 / ior);
        if (outside[axis] == 0.0) continue;
        float shares = is_in_cone(outside, sun_direction, sun_reach) ? glass_image_share(0u) : 0.0;
        shares += images_in(outside, 1u) * glass_image_share(1u);
        samples += shares * ior * ior * abs(direction[axis] / outside[axis]);
    }
    return samples;
}

#endif
