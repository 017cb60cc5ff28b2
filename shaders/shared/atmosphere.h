// The air of a planet: what it is made of, and how much light it transmits. Model and coefficients: Hillaire
// 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", section 4, with the aerosol
// absorption of its reference code (0.444e-3/km; the table of the paper has a misprint).
//
// Unlike that paper we need no table of transmittances. The column of an exponential atmosphere along a
// ray is a Chapman function, which has a closed form that is accurate to 1e-6, and the ozone layer is a tent
// whose column two Gauss points integrate accurately enough. Transmittances are within 0.05 % of quadrature
// in double precision, even at the horizon, where tables are worst.
//
// Lengths are in kilometres. Heights h above the ground are used instead of radii: as a float, the radius
// has steps of 0.5 m, and differences of squared radii lose their significant bits near the horizon. Cosines
// are relative to the local vertical. Columns have x: air, y: aerosol, z: ozone, in kilometres of the density
// that the coefficients refer to.
#ifndef VX_ATMOSPHERE_H
#define VX_ATMOSPHERE_H

#include "limits.h"
#include "portable.h"

VX_BEGIN

VX_CONST(float, kGroundRadius, 6360.0f);
VX_CONST(float, kAirTop, 100.0f);        // where rays through the air end
VX_CONST(float, kRayleighHeight, 8.0f);  // over which densities fall by a factor of e
VX_CONST(float, kMieHeight, 1.2f);
VX_CONST(float, kOzoneHeight, 25.0f);  // the middle of its layer
VX_CONST(float, kOzoneReach, 15.0f);   // above and below

// Coefficients per km and colour: of air and aerosol at the ground, of ozone in the middle of its layer.
struct Air {
    vec3 rayleigh;         // scattering by air
    vec3 ozone;            // absorption
    float mie;             // scattering by aerosol
    float mie_extinction;  // the same and absorption
    float mie_g;           // mean cosine of scattering by aerosol (of Henyey and Greenstein's function)
    float ground_albedo;
};

VX_FN float ozone_density(float h) {
    return max(0.0f, 1.0f - abs(h - kOzoneHeight) / kOzoneReach);
}

VX_FN vec3 air_densities(float h) {
    return vec3(exp(-h / kRayleighHeight), exp(-h / kMieHeight), ozone_density(h));
}

VX_FN vec3 air_transmittance(Air air, vec3 columns) {
    return exp(-(air.rayleigh * columns.x + vec3(air.mie_extinction * columns.y) + air.ozone * columns.z));
}

// Height after a distance t along a ray.
VX_FN float height_after(float h, float cosine, float t) {
    const float r = kGroundRadius + h;
    const float gain = (2.0f * r * cosine + t) * t;  // added to the squared radius
    return max(h + gain / (r + sqrt(max(r * r + gain, 0.0f))), 0.0f);
}

// Distance along a ray to the farther of the two points where it is `rise` >= 0 higher.
VX_FN float distance_to_rise(float h, float cosine, float rise) {
    const float r = kGroundRadius + h;
    const float b = r * cosine;
    const float c = rise * (2.0f * r + rise);
    const float root = sqrt(b * b + c);
    return b > 0.0f ? c / (b + root) : root - b;
}

VX_FN bool hits_ground(float h, float cosine) {
    const float b = (kGroundRadius + h) * cosine;
    return cosine < 0.0f && b * b >= h * (2.0f * kGroundRadius + h);
}

// For a ray that hits the ground.
VX_FN float distance_to_ground(float h, float cosine) {
    const float b = (kGroundRadius + h) * cosine;
    const float c = h * (2.0f * kGroundRadius + h);
    return c / (sqrt(max(b * b - c, 0.0f)) - b);
}

// Height of the lowest point of a ray's line.
VX_FN float lowest_height(float h, float cosine) {
    return h - (kGroundRadius + h) * cosine * cosine / (1.0f + sqrt(max(1.0f - cosine * cosine, 0.0f)));
}

// Elevation of the tangents, seen from `drop` >= 0 above it, to the sphere of radius ground + h - drop: <= 0.
VX_FN float tangent_elevation(float h, float drop) {
    const float r = kGroundRadius + h;
    return -atan(sqrt(drop * (2.0f * r - drop)), r - drop);
}

VX_FN float horizon_elevation(float h) {
    return tangent_elevation(h, h);
}

// Chapman's function of x = radius / scale height and a cosine >= 0: the column of an exponential atmosphere
// upwards along a ray divided by that along the vertical. With heights to second order in the distance from
// the lowest point it is sqrt(pi x / 2) erfcx(y), y = cosine sqrt(x / 2); the next order adds 3/8 to 1 times
// 1/x of it. Both factors are polynomials in 1 / (1 + 0.45 y), fitted by us for y from 0 to 80: erfcx with a
// relative error of 7e-7, the other factor within 0.0013.
VX_FN float chapman(float x, float cosine) {
    const float t = 1.0f / (1.0f + 0.45f * cosine * sqrt(0.5f * x));
    float erfcx = -0.239837724f + t * 0.0662460664f;
    erfcx = 0.0342573889f + t * (0.211798090f + t * erfcx);
    erfcx = 0.226181424f + t * (0.193476188f + t * erfcx);
    erfcx = t * (0.253883345f + t * (0.253994522f + t * erfcx));
    const float part =
        1.0f + t * (-0.0455076849f + t * (0.298409830f + t * (-2.02758824f + t * 1.14846946f)));
    return sqrt(0.5f * kPi * x) * erfcx * (1.0f + part / x);
}

// Ozone column between two distances on the same side of the layer's middle. Heights along a ray are nearly
// quadratic in the distance, and two Gauss points are exact up to the third power.
VX_FN float ozone_column(float h, float cosine, float from, float to) {
    const float middle = 0.5f * (from + to);
    const float offset = 0.288675135f * (to - from);
    return 0.5f * (to - from) *
           (ozone_density(height_after(h, cosine, middle - offset)) +
            ozone_density(height_after(h, cosine, middle + offset)));
}

// Columns from a place upwards to infinity. cosine >= 0.
VX_FN vec3 columns_up(float h, float cosine) {
    const float r = kGroundRadius + h;
    const float low = distance_to_rise(h, cosine, max(kOzoneHeight - kOzoneReach - h, 0.0f));
    const float middle = distance_to_rise(h, cosine, max(kOzoneHeight - h, 0.0f));
    const float high = distance_to_rise(h, cosine, max(kOzoneHeight + kOzoneReach - h, 0.0f));
    return vec3(kRayleighHeight * exp(-h / kRayleighHeight) * chapman(r / kRayleighHeight, cosine),
                kMieHeight * exp(-h / kMieHeight) * chapman(r / kMieHeight, cosine),
                ozone_column(h, cosine, low, middle) + ozone_column(h, cosine, middle, high));
}

// Columns along a ray that misses the ground.
VX_FN vec3 columns_out(float h, float cosine) {
    const vec3 part = columns_up(h, abs(cosine));
    if (cosine >= 0.0f) return part;
    return 2.0f * columns_up(lowest_height(h, cosine), 0.0f) - part;
}

// Fraction of the light from beyond the air that reaches a place; none through the ground.
VX_FN vec3 transmittance_out(Air air, float h, float cosine) {
    if (hits_ground(h, cosine)) return vec3(0.0f);
    return air_transmittance(air, columns_out(h, cosine));
}

// Phase functions, per steradian: of the cosine of the angle by which light turns.

VX_FN float rayleigh_phase(float c) {
    return 3.0f / (16.0f * kPi) * (1.0f + c * c);
}

// Cornette and Shanks 1992.
VX_FN float mie_phase(float g, float c) {
    const float d = max(1.0f + g * g - 2.0f * g * c, 1e-6f);
    return 3.0f / (8.0f * kPi) * (1.0f - g * g) * (1.0f + c * c) / ((2.0f + g * g) * d * sqrt(d));
}

// How much of the light's variation over directions, in spherical harmonics of degree 0, 1 and 2, a
// scattering event preserves: the means of the Legendre polynomials over the phase function. Air preserves
// (1, 0, 1/10).
VX_FN vec3 mie_moments(float g) {
    const float scale = 1.5f / (2.0f + g * g);
    const float g2 = g * g;
    return vec3(1.0f, scale * g * (1.6f + 0.4f * g2),
                scale * (2.0f / 15.0f + 32.0f / 21.0f * g2 + 12.0f / 35.0f * g2 * g2));
}

VX_END

#endif
