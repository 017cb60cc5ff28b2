// How much of the kernel around a visible point can receive photons: the part behind other spheres cannot,
// and an estimate that divides by the whole disc is too dark there. Each other sphere cuts the tangent plane
// of the point in a circle; the disc loses what is beyond the circle's nearest point, as if the circle were a
// line there. Cuts are assumed independent: the fractions that they leave are multiplied.
#ifndef VX_PHOTON_AREA_H
#define VX_PHOTON_AREA_H

#include "limits.h"
#include "portable.h"
#include "sphere.h"

VX_BEGIN

// Fraction of a disc of radius 1 beyond a line at a distance x in [0, 1] from its centre.
VX_FN float disc_beyond(float x) {
    return (acos(x) - x * sqrt(1.0f - x * x)) * kInversePi;
}

// Fraction of a disc about a point, across a unit normal, that another sphere cuts off. With q from the
// sphere's anchor, f(q) = k |q|^2 + 2 n.q is 0 on the sphere. In the plane towards the sphere f falls to 0 at
// s with k s^2 - 2 g s + f = 0, g half of the gradient along the plane. From outside, the cut is at most the
// area of the circle, of radius sqrt(g^2 - k f) / k. Nothing is cut where the sphere does not meet the plane
// or is tangent to it.
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
