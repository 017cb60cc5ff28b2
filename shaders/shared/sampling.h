// Directions from points of the unit square. Cosine and cone both start from the concentric map of the square
// to the disk, which keeps neighbours together and therefore keeps the stratification of the sequence. Every
// float that decides the result is precise and the sine is our own polynomial: CPU and device agree to the
// bit where sqrt and division are correctly rounded (as on the CPU and llvmpipe).
#ifndef VX_SAMPLING_H
#define VX_SAMPLING_H

#include "limits.h"
#include "portable.h"

VX_BEGIN

// Faces of a cell: -x, +x, -y, +y, -z, +z.
VX_CONST(uint, kFaceCount, 6u);

// Outward unit normal of a face 0..5.
VX_FN vec3 face_normal(uint face) {
    float s = (face & 1u) == 0u ? -1.0f : 1.0f;
    uint axis = face >> 1u;
    return vec3(axis == 0u ? s : 0.0f, axis == 1u ? s : 0.0f, axis == 2u ? s : 0.0f);
}

// Sine and cosine of (pi/4) s for s in [-1, 1], within 2 ulp. Taylor series to the 9th and 10th power: the
// first term left out is below 2e-9.
VX_FN vec2 sin_cos_eighth(float s) {
    VX_PRECISE float x = s * (0.25f * kPi);
    VX_PRECISE float x2 = x * x;
    VX_PRECISE float sine = 2.75573192e-6f;
    sine = sine * x2 - 1.98412698e-4f;
    sine = sine * x2 + 8.33333333e-3f;
    sine = sine * x2 - 0.166666667f;
    sine = x + x * (x2 * sine);
    VX_PRECISE float cosine = -2.75573192e-7f;
    cosine = cosine * x2 + 2.48015873e-5f;
    cosine = cosine * x2 - 1.38888889e-3f;
    cosine = cosine * x2 + 4.16666667e-2f;
    cosine = cosine * x2 - 0.5f;
    cosine = 1.0f + x2 * cosine;
    return vec2(sine, cosine);
}

// Uniform point of the unit disk and its radius: xy and z. The radius lies strictly in (0, 1), because u, a
// multiple of 2^-24, is moved to the centre of its lattice cell, which is exact and avoids both centre and
// rim. Source: Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
VX_FN vec3 concentric_disk(vec2 u) {
    VX_PRECISE float a = (2.0f * u.x - 1.0f) + kUnitStep;
    VX_PRECISE float b = (2.0f * u.y - 1.0f) + kUnitStep;
    bool a_is_longer = abs(a) > abs(b);
    VX_PRECISE float radius = a_is_longer ? a : b;
    VX_PRECISE float part = (a_is_longer ? b : a) / radius;
    vec2 angle = sin_cos_eighth(part);
    VX_PRECISE float along = radius * angle.y;
    VX_PRECISE float across = radius * angle.x;
    return vec3(a_is_longer ? along : across, a_is_longer ? across : along, abs(radius));
}

// Cosine-weighted direction around +z, density z / pi. z is at least 2^-12, the length is 1 within
// kUnitLengthError. Source: Malley's method, Pharr et al., "Physically Based Rendering", 4th edition, section
// A.5.3.
VX_FN vec3 cosine_hemisphere(vec2 u) {
    vec3 disk = concentric_disk(u);
    VX_PRECISE float z2 = (1.0f - disk.z) * (1.0f + disk.z);
    return vec3(disk.x, disk.y, sqrt(z2));
}

// A direction around +z as one around the normal of a face 0..5 of a cell.
VX_FN vec3 off_face(uint face, vec3 local) {
    float out_of_face = (face & 1u) == 0u ? -local.z : local.z;
    uint axis = face >> 1u;
    if (axis == 0u) return vec3(out_of_face, local.x, local.y);
    if (axis == 1u) return vec3(local.y, out_of_face, local.x);
    return vec3(local.x, local.y, out_of_face);
}

// Cosine-weighted direction off a face 0..5 of a cell; the component along the face normal is at least 2^-12.
VX_FN vec3 cosine_on_face(uint face, vec2 u) {
    return off_face(face, cosine_hemisphere(u));
}

// Right-handed orthonormal axes; cross(tangent, bitangent) = normal.
struct Basis {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

// A basis around a unit vector, for every unit vector, -z and -0 included.
// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1), listing 3.
VX_FN Basis basis_around(vec3 n) {
    VX_PRECISE float s = n.z >= 0.0f ? 1.0f : -1.0f;
    VX_PRECISE float a = -1.0f / (s + n.z);
    VX_PRECISE float b = n.x * n.y * a;
    VX_PRECISE float tx = 1.0f + s * (n.x * n.x * a);
    VX_PRECISE float by = s + n.y * n.y * a;
    Basis basis;
    basis.tangent = vec3(tx, s * b, -s * n.x);
    basis.bitangent = vec3(b, by, -n.y);
    basis.normal = n;
    return basis;
}

// The vector with coordinates `local` in the basis.
VX_FN vec3 from_basis(Basis basis, vec3 local) {
    VX_PRECISE vec3 across = basis.tangent * local.x + basis.bitangent * local.y;
    VX_PRECISE vec3 v = across + basis.normal * local.z;
    return v;
}

// Cosine-weighted direction around a unit normal; its length is 1 within kUnitLengthError, its component
// along the normal at least 2^-13.
VX_FN vec3 cosine_about(vec3 normal, vec2 u) {
    return from_basis(basis_around(normal), cosine_hemisphere(u));
}

// 1 - cos(half_angle), as 2 sin^2(half_angle / 2): no cancellation, so a sun of 0.265 degrees keeps all bits.
// half_angle in radians, [0, pi].
VX_FN float cone_height(float half_angle) {
    float s = sin(0.5f * half_angle);
    return 2.0f * s * s;
}

// Solid angle of a cone in steradians.
VX_FN float cone_solid_angle(float height) {
    return (2.0f * kPi) * height;
}

// Whether a unit direction is in the cone of cone_height `height` around a unit axis: by the chord between
// them, because 1 - cos of a sun of 0.05 degrees is below the step of a float near 1.
VX_FN bool is_in_cone(vec3 direction, vec3 axis, float height) {
    VX_PRECISE vec3 chord = direction - axis;
    return dot(chord, chord) <= 2.0f * height;
}

// Uniform direction in the cone of cone_height `height` around a unit direction, density 1 /
// cone_solid_angle. Height 0 gives exactly the direction. The concentric map keeps areas, and the height of a
// cap is proportional to its area (Archimedes), so 1 - cos = height r^2 and sin = r sqrt(height (2 - height
// r^2)).
VX_FN vec3 uniform_cone(vec3 direction, float height, vec2 u) {
    vec3 disk = concentric_disk(u);
    VX_PRECISE float h = height * (disk.z * disk.z);
    VX_PRECISE float sin_over_r = sqrt(height * (2.0f - h));
    VX_PRECISE vec3 local = vec3(disk.x * sin_over_r, disk.y * sin_over_r, 1.0f - h);
    return from_basis(basis_around(direction), local);
}

VX_END

#endif
