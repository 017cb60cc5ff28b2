// The light of the sky by brute force: paths through the air, without a table. A ray is marched in a few
// jittered steps. Each of them gathers sunlight that is scattered once more, and one of them, drawn in
// proportion to what it scatters, sends the path on (resampled importance sampling: Talbot, Cline and Egbert
// 2005, "Importance Resampling for Global Illumination", with a candidate from each stratum). The mean over
// paths is the radiance of all orders of scattering, but for the error of atmosphere.h's transmittances.
//
// Light is per unit of the sun's irradiance above the air. It is the same on both sides of the vertical plane
// of the sun, so that rays need no side (AirRay).
#ifndef VX_SKY_PATH_H
#define VX_SKY_PATH_H

#include "air_ray.h"
#include "rng.h"
#include "sampling.h"
#include "sequence.h"
#include "sky_view.h"

VX_BEGIN

VX_CONST(uint, kAirSteps, 8u);  // of a ray
// Roulette: a path that carries this share of its light or more goes on, but for one in ten. Dusk is lit from
// afar, by paths that carry little.
VX_CONST(float, kAirWorth, 0.25f);
VX_CONST(float, kAirSurvival, 0.9f);
VX_CONST(uint, kAirRays, 240u);         // of a path: one in 10^11 would be longer
VX_CONST(uint, kAirSalt, 0x61697273u);  // keeps its noise apart from other noise ("airs" in ASCII)

struct AirPath {
    AirRay ray;
    vec3 throughput;  // what its light is multiplied by
    vec3 light;       // that was found
    NoiseStream noise;
};

// Where a ray may send its path on.
struct AirCandidate {
    AirRay ray;     // the same from there
    vec3 rayleigh;  // of light along the ray: the share that air turns into it there, over the phase function
    vec3 mie;       // likewise, that aerosol does
    vec3 ground;    // that the ground reflects
};

VX_FN float sum_of(vec3 v) {
    return v.x + v.y + v.z;
}

VX_FN float weight_of(AirCandidate candidate) {
    return sum_of(candidate.rayleigh) + sum_of(candidate.mie) + sum_of(candidate.ground);
}

// A step of a ray: the share u of its way, in steps of so much.
VX_FN AirCandidate air_candidate(Air air, AirRay ray, AirWay way, vec3 throughput, float u, float step) {
    const AirNode node = air_node(u, step, way.rises);
    const float t = way.end * node.way;
    AirCandidate found;
    found.ray = ray_after(ray, t);
    const vec3 reaches = (way.end * node.weight) * throughput *
                         passes_from(air, ray, way, t, found.ray.height, found.ray.cosine);
    const vec3 density = air_densities(found.ray.height);
    found.rayleigh = reaches * air.rayleigh * density.x;
    found.mie = reaches * (air.mie * density.y);
    found.ground = vec3(0.0f);
    return found;
}

VX_FN AirCandidate ground_candidate(Air air, AirRay ray, AirWay way, vec3 throughput) {
    AirCandidate found;
    found.ray = ray_to_ground(ray, way);
    found.rayleigh = found.mie = vec3(0.0f);
    found.ground =
        air.ground_albedo * throughput * passes_from(air, ray, way, way.end, 0.0f, found.ray.cosine);
    return found;
}

// Sunlight that goes along the ray from there.
VX_FN vec3 sunlight_from(Air air, AirCandidate from) {
    const AirRay ray = from.ray;
    const vec3 turned = from.rayleigh * rayleigh_phase(ray.sun_angle) +
                        from.mie * mie_phase(air.mie_g, ray.sun_angle) +
                        from.ground * (kInversePi * max(ray.sun, 0.0f));
    return turned * transmittance_out(air, ray.height, ray.sun);
}

// Cosine of the angle by which air turns light, in proportion to rayleigh_phase.
VX_FN float rayleigh_cosine(float u) {
    const float a = 4.0f * u - 2.0f;
    const float root = pow(a + sqrt(a * a + 1.0f), 1.0f / 3.0f);
    return clamp(root - 1.0f / root, -1.0f, 1.0f);
}

// The same of aerosol, in proportion to the function of Henyey and Greenstein 1941, and its density.
VX_FN float henyey_cosine(float g, float u) {
    if (abs(g) < 1e-3f) return 2.0f * u - 1.0f;
    const float root = (1.0f - g * g) / (1.0f - g + 2.0f * g * u);
    return clamp((1.0f + g * g - root * root) / (2.0f * g), -1.0f, 1.0f);
}

VX_FN float henyey_phase(float g, float c) {
    if (abs(g) < 1e-3f) return 0.25f * kInversePi;
    const float d = max(1.0f + g * g - 2.0f * g * c, 1e-6f);
    return 0.25f * kInversePi * (1.0f - g * g) / (d * sqrt(d));
}

// The direction of a ray in the frame of its place: z up, the sun over the x axis.
VX_FN vec3 ray_direction(AirRay ray) {
    const float horizontal = sqrt(max(1.0f - ray.sun * ray.sun, 1e-8f));
    const float reach = sqrt(max(1.0f - ray.cosine * ray.cosine, 0.0f));
    const float x = clamp((ray.sun_angle - ray.cosine * ray.sun) / horizontal, -reach, reach);
    return vec3(x, sqrt(max(reach * reach - x * x, 0.0f)), ray.cosine);
}

// The ray from the same place in another direction of that frame.
VX_FN AirRay turned_ray(AirRay ray, vec3 direction) {
    const float horizontal = sqrt(max(1.0f - ray.sun * ray.sun, 0.0f));
    ray.cosine = clamp(direction.z, -1.0f, 1.0f);
    ray.sun_angle = clamp(direction.x * horizontal + direction.z * ray.sun, -1.0f, 1.0f);
    return ray;
}

// Sends the path on from a place in the air, whose throughput is the sum of the candidate's parts.
VX_FN AirPath scatter_path(Air air, AirPath path, AirCandidate from, vec3 u) {
    const float aerosol = sum_of(from.mie) / weight_of(from);
    const float c = u.x < aerosol ? henyey_cosine(air.mie_g, u.y) : rayleigh_cosine(u.y);
    const float s = sqrt(max(1.0f - c * c, 0.0f));
    const float turn = 2.0f * kPi * u.z;
    const Basis basis = basis_around(normalize(ray_direction(from.ray)));
    path.ray = turned_ray(from.ray, from_basis(basis, vec3(s * cos(turn), s * sin(turn), c)));
    const float pdf = (1.0f - aerosol) * rayleigh_phase(c) + aerosol * henyey_phase(air.mie_g, c);
    path.throughput = (from.rayleigh * rayleigh_phase(c) + from.mie * mie_phase(air.mie_g, c)) / pdf;
    return path;
}

VX_FN AirPath reflect_path(AirPath path, AirCandidate from, vec3 u) {
    path.ray = turned_ray(from.ray, cosine_hemisphere(vec2(u.y, u.z)));
    path.throughput = from.ground;
    return path;
}

// One of the candidates so far, and the sum of their weights.
struct AirChoice {
    AirCandidate chosen;
    float total;
};

VX_FN AirChoice choose_from(AirChoice choice, AirCandidate one, float u) {
    const float weight = weight_of(one);
    choice.total += weight;
    if (u * choice.total < weight) choice.chosen = one;
    return choice;
}

// Two numbers in [0, 1), and the path after them.
struct AirNumbers {
    AirPath path;
    vec2 u;
};

VX_FN AirNumbers draw_numbers(AirPath path) {
    AirNumbers drawn;
    drawn.u.x = stream_float(path.noise);
    path.noise = stream_after(path.noise);
    drawn.u.y = stream_float(path.noise);
    path.noise = stream_after(path.noise);
    drawn.path = path;
    return drawn;
}

// Marches the ray of a path, gathers sunlight, and chooses where the path goes on.
struct AirMarch {
    AirPath path;
    AirChoice choice;
};

VX_FN AirMarch march_path(Air air, AirPath path, AirWay way) {
    AirMarch march;
    const vec3 to_ground = way.is_ground ? path.throughput : vec3(0.0f);
    march.choice.chosen = ground_candidate(air, path.ray, way, to_ground);
    march.choice.total = weight_of(march.choice.chosen);
    path.light += sunlight_from(air, march.choice.chosen);
    const float step = 1.0f / float(kAirSteps);
    for (uint i = 0u; i < kAirSteps; ++i) {
        const AirNumbers drawn = draw_numbers(path);
        path = drawn.path;
        const AirCandidate one =
            air_candidate(air, path.ray, way, path.throughput, (float(i) + drawn.u.x) * step, step);
        path.light += sunlight_from(air, one);
        march.choice = choose_from(march.choice, one, drawn.u.y);
    }
    march.path = path;
    return march;
}

// The path in its next direction. Nothing is left of its throughput where it ends.
VX_FN AirPath path_after(Air air, AirMarch march) {
    const AirNumbers two = draw_numbers(march.path);
    const AirNumbers more = draw_numbers(two.path);
    const AirCandidate from = march.choice.chosen;
    AirPath path = more.path;
    path.throughput = vec3(0.0f);
    if (!(march.choice.total > 0.0f)) return path;
    const vec3 u = vec3(two.u.x, two.u.y, more.u.x);
    if (sum_of(from.ground) > 0.0f) {
        path = reflect_path(path, from, u);
    } else {
        path = scatter_path(air, path, from, u);
    }
    const vec3 carried = (march.choice.total / weight_of(from)) * path.throughput;
    const float most = max(carried.x, max(carried.y, carried.z));
    const float survival = min(most / kAirWorth, kAirSurvival);
    path.throughput = more.u.y < survival ? carried / survival : vec3(0.0f);
    return path;
}

VX_FN NoiseStream air_noise(SampleKey key, uint number) {
    NoiseStream noise;
    noise.state = hash4(key.seed, key.stream, key.index, kAirSalt + 2u * number);
    noise.increment = hash4(key.seed, key.stream, key.index, kAirSalt + 2u * number + 1u) | 1u;
    return noise;
}

// What comes along a ray from its first `length` kilometres, by one path.
VX_FN vec3 traced_light(Air air, AirRay ray, float length, NoiseStream noise) {
    AirPath path;
    path.ray = ray;
    path.throughput = vec3(1.0f);
    path.light = vec3(0.0f);
    path.noise = noise;
    AirWay way = cut_way(way_of(ray), length);
    for (uint i = 0u; i < kAirRays; ++i) {
        path = path_after(air, march_path(air, path, way));
        if (!(sum_of(path.throughput) > 0.0f)) break;
        way = way_of(path.ray);
    }
    return path.light;
}

// Radiance that comes from a unit direction, by one path: what sky_radiance looks up.
VX_FN vec3 traced_sky(SkyParams sky, vec3 direction, NoiseStream noise) {
    const float way = distance_to_air(sky.height, direction.z);
    if (way < 0.0f) return vec3(0.0f);
    const AirRay ray = ray_after(air_ray_of(sky, direction), way);
    return sky.irradiance * traced_light(sky.air, ray, kWholeRay, noise);
}

VX_END

#endif
