// How much of the disc around a visible point can receive photons: what lies behind other spheres cannot, and
// an estimate that divides by the whole disc is dark there. Each other sphere cuts the tangent plane of the
// point in a circle; the disc loses what is beyond the circle's nearest point, as if the circle were a line
// there. Cuts are taken as independent: the shares that they leave are multiplied.
#ifndef VX_PHOTON_AREA_H
#define VX_PHOTON_AREA_H

#include "limits.h"
#include "portable.h"
#include "sphere.h"

VX_BEGIN

// Share of a disc of radius 1 beyond a line at a distance x in [0, 1] from its centre.
VX_FN float disc_beyond(float x) {
    return (acos(x) - x * sqrt(1.0f - x * x)) * kInversePi;
}

// Share of a disc that another sphere takes away: the disc around a point, of a radius, across a unit normal.
// With q from the sphere's anchor, f(q) = k |q|^2 + 2 n.q is 0 on the sphere. Along the plane's direction
// towards it f falls to 0 at s with k s^2 - 2 g s + f = 0, g the gradient's half along the plane. From
// outside no more is taken than the circle holds, radius sqrt(g^2 - k f) / k. Nothing, where the sphere does
// not meet the plane or runs along it.
VX_FN float share_taken(Sphere sphere, vec3 point, vec3 normal, float radius) {
    VX_PRECISE vec3 q = point - sphere.anchor;
    VX_PRECISE float f = sphere.curvature * dot(q, q) + 2.0f * dot(q, sphere.normal);
    vec3 gradient = sphere.normal + sphere.curvature * q;
    vec3 along = gradient - dot(gradient, normal) * normal;
    float slope_squared = dot(along, along);
    VX_PRECISE float root_squared = slope_squared - sphere.curvature * f;
    if (!(slope_squared > kMinSlope * kMinSlope && root_squared >= 0.0f)) return 0.0f;
    float cut = abs(f) / (sqrt(slope_squared) + sqrt(root_squared));
    float taken = cut < radius ? disc_beyond(cut / radius) : 0.0f;
    float reach = sphere.curvature * radius;
    return f > 0.0f ? min(taken, root_squared / (reach * reach)) : taken;
}

VX_END

#endif
