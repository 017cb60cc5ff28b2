// Rays through the air: where they end, and how much air is on the way.
#ifndef VX_AIR_RAY_H
#define VX_AIR_RAY_H

#include "atmosphere.h"

VX_BEGIN

// A ray through the air by what its light depends on.
struct AirRay {
    float height;     // of the start, [0, kAirTop]
    float cosine;     // to the vertical there
    float sun;        // the sun's cosine to the vertical there
    float sun_angle;  // cosine of the angle between the ray and the sun
};

// The same ray from a point on it.
VX_FN AirRay ray_after(AirRay ray, float t) {
    if (t <= 0.0f) return ray;
    const float r = kGroundRadius + ray.height;
    ray.height = min(height_after(ray.height, ray.cosine, t), kAirTop);
    ray.cosine = clamp((r * ray.cosine + t) / (kGroundRadius + ray.height), -1.0f, 1.0f);
    ray.sun = clamp((r * ray.sun + t * ray.sun_angle) / (kGroundRadius + ray.height), -1.0f, 1.0f);
    return ray;
}

// What a march knows of its ray beforehand.
struct AirWay {
    float end;            // of the ray, km: at the ground, at the top of the air, or where it is cut
    bool is_ground;       // that it ends there
    bool rises;           // all the way
    bool sinks;           // all the way
    bool is_short;        // columns along it are no differences of long ones
    vec3 start_columns;   // from the start up along its line, or back
    vec3 lowest_columns;  // from its lowest point, where it passes one
};

VX_FN AirWay way_of(AirRay ray) {
    const float h = ray.height;
    AirWay way;
    way.is_ground = hits_ground(h, ray.cosine);
    way.end = way.is_ground ? distance_to_ground(h, ray.cosine)
                            : distance_to_rise(h, ray.cosine, max(kAirTop - h, 0.0f));
    way.rises = ray.cosine >= 0.0f;
    way.sinks = way.is_ground;
    way.is_short = false;
    way.start_columns = columns_up(h, abs(ray.cosine));
    way.lowest_columns = way.rises || way.sinks ? vec3(0.0f) : columns_up(lowest_height(h, ray.cosine), 0.0f);
    return way;
}

// Longer than any ray in the air, km.
VX_CONST(float, kWholeRay, 1e9f);

// Ways up to here are integrated by four Gauss points, km: as differences, columns would keep the error of
// all the air along the line, up to 0.5 % of the light.
VX_CONST(float, kShortWay, 10.0f);
VX_CONST_LIST(float, kFourNode, 4) = {0.0694318442f, 0.3300094782f, 0.6699905218f, 0.9305681558f};
VX_CONST_LIST(float, kFourWeight, 4) = {0.1739274226f, 0.3260725774f, 0.3260725774f, 0.1739274226f};

// The first part of the way, without the ground.
VX_FN AirWay cut_way(AirWay way, float end) {
    if (end <= way.end) {
        way.end = end;
        way.is_ground = false;
        way.is_short = end <= kShortWay;
    }
    return way;
}

VX_FN vec3 short_columns(AirRay ray, float t) {
    vec3 sum = vec3(0.0f);
    for (uint i = 0u; i < 4u; ++i)
        sum += (t * kFourWeight[i]) * air_densities(height_after(ray.height, ray.cosine, t * kFourNode[i]));
    return sum;
}

// From the start of the way to a distance t on it, where the ray has this height and cosine.
VX_FN vec3 columns_to(AirRay ray, AirWay way, float t, float height, float cosine) {
    if (way.is_short) return short_columns(ray, t);
    const vec3 part = columns_up(height, abs(cosine));
    const vec3 columns = way.rises ? way.start_columns - part
                         : (cosine <= 0.0f || way.sinks)
                             ? part - way.start_columns
                             : 2.0f * way.lowest_columns - way.start_columns - part;
    return max(columns, vec3(0.0f));
}

// The same ray where it meets the ground.
VX_FN AirRay ray_to_ground(AirRay ray, AirWay way) {
    const float r = kGroundRadius + ray.height;
    ray.height = 0.0f;
    ray.cosine = clamp((r * ray.cosine + way.end) / kGroundRadius, -1.0f, 0.0f);
    ray.sun = clamp((r * ray.sun + way.end * ray.sun_angle) / kGroundRadius, -1.0f, 1.0f);
    return ray;
}

// Share of light that comes from there.
VX_FN vec3 passes_from(Air air, AirRay ray, AirWay way, float t, float height, float cosine) {
    return air_transmittance(air, columns_to(ray, way, t, height, cosine));
}

struct AirNode {
    float way;     // share of a stretch of the ray
    float weight;  // share of it that the node stands for
};

// Nodes at equal steps of u in [0, 1] crowd where the air is dense: at the start of what rises, at both ends
// of the rest.
VX_FN AirNode air_node(float u, float step, bool rises) {
    AirNode node;
    node.way = rises ? u * u : u * u * (3.0f - 2.0f * u);
    node.weight = (rises ? 2.0f * u : 6.0f * u * (1.0f - u)) * step;
    return node;
}

VX_END

#endif
