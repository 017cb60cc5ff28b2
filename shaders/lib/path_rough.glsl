// Rough surfaces on a path. Include lib/path.glsl first.
#ifndef VX_PATH_ROUGH_GLSL
#define VX_PATH_ROUGH_GLSL

layout(r32ui) readonly uniform uimageBuffer Gains;  // rows of kGainPlaces

struct RoughVertex {
    PathRay beyond;  // where rays that cross the surface start
    vec3 outward;    // unit, towards where the path came from
    vec3 albedo;
    float alpha;  // 0: the surface is diffuse
    float eta;
    uint gain_row;
};

RoughVertex no_rough_vertex(PathRay ray) {
    RoughVertex vertex;
    vertex.beyond = ray;
    vertex.outward = vec3(0.0, 0.0, 1.0);
    vertex.albedo = vec3(0.0);
    vertex.alpha = 0.0;
    vertex.eta = 0.0;
    vertex.gain_row = 0u;
    return vertex;
}

RoughVertex rough_vertex(PathRay path, PathHit found, BsdfSample event) {
    RoughVertex vertex = no_rough_vertex(path);
    if (event.kind != kEventRough) return vertex;
    vertex.outward = -path.direction;
    vertex.albedo = event.albedo;
    vertex.alpha = event.alpha;
    vertex.eta = event.eta;
    vertex.gain_row = event.gain_row;
    event.kind = kEventRefract;
    if (event.eta != 0.0) vertex.beyond = path_after(path, found, event);
    return vertex;
}

float gain_of(uint row, float cosine, float alpha) {
    float place = gain_place(cosine, alpha) * float(kGainPlaces - 1u);
    uint low = min(uint(place), kGainPlaces - 2u);
    int at = int(kGainPlaces * row + low);
    return mix(uintBitsToFloat(imageLoad(Gains, at).x), uintBitsToFloat(imageLoad(Gains, at + 1).x), place - float(low));
}

// The factor of a direction's value that makes up for light lost by one scattering (shared/bsdf.h).
vec3 rough_factor(RoughVertex vertex, vec3 normal, vec3 direction) {
    float gain = gain_of(vertex.gain_row, dot(vertex.outward, normal), vertex.alpha);
    if (vertex.eta != 0.0) return vec3(gain);
    return metal_factor(vertex.albedo, gain * gain_of(vertex.gain_row, dot(direction, normal), vertex.alpha));
}

#endif
