// Light paths from the camera or from an emitter: where a ray goes next, and what mirrors and glass do to it.
// Include lib/address.glsl first.
//
// A point inside several glass spheres is in the smallest of them; outside of spheres it is in the glass
// of its voxel, or else in air with an index of refraction of 1. There is no surface between two regions of
// the same material. Voxels of glass are traversed cell by cell, everything else by the march.
#ifndef VX_PATH_GLSL
#define VX_PATH_GLSL

#include "lib/constants.glsl"
#include "lib/materials.glsl"
#include "lib/surface.glsl"
#include "shared/bsdf.h"
#include "shared/sppm.h"

VX_SPECIALIZED(uint, has_glass_voxels, 0u);
VX_SPECIALIZED(uint, start_anywhere, 0u);  // rays may start off surfaces
VX_SPECIALIZED(uint, has_rough, 0u);       // rough metal or rough glass

const uint kNoMedium = 0xFFFFFFFFu;

// How a ray ends. When it leaves glass voxels, the cell and face of `hit` are those of the last glass voxel,
// seen from inside, and `far_medium` describes the cell behind the face.
struct PathHit {
    Hit hit;
    vec3 normal;  // unit, on the side that the ray comes from
    bool leaves_medium;  // through a face of its glass voxels
    bool stays;          // no surface: the next voxel is of the same glass, or the ray starts in glass
    uint far_medium;     // material of the glass voxel behind the face, or kNoMedium
    float curvature;     // of the sphere that was hit
};

PathRay path_from(Hit hit, vec3 direction) {
    Ray ray = ray_from(hit, direction, kUnbounded);
    PathRay path;
    path.cell = ray.cell;
    path.fraction = ray.fraction;
    path.direction = direction;
    path.own = own_sphere(hit);
    path.medium = kNoMedium;
    return path;
}

PathHit no_hit() {
    PathHit found;
    found.hit.cell = ivec3(-1);
    found.hit.face = kFaceMiss;
    found.hit.fraction = vec3(0.0);
    found.hit.t = kUnbounded;
    found.hit.material = 0u;
    found.hit.sphere = kNoSphere;
    found.normal = vec3(0.0, 0.0, 1.0);
    found.leaves_medium = false;
    found.stays = false;
    found.far_medium = kNoMedium;
    found.curvature = 0.0;
    return found;
}

// The segment in one glass voxel: the face through which the ray leaves it.
struct CellExit {
    uint face;
    vec3 fraction;  // on that face
    float t;
};

CellExit exit_cell(PathRay path) {
    Ray ray;
    ray.cell = path.cell;
    ray.fraction = path.fraction;
    ray.direction = path.direction;
    ray.t_max = kUnbounded;
    MarchAxes axes = march_axes(ray);
    vec3 times = plane_times(axes, ivec3(1));
    int axis = first_crossing(times).axis;
    CellExit result;
    result.t = max(min(times.x, min(times.y, times.z)), 0.0);
    result.face = uint(direction_number(axes, axis));
    float on_face = float(result.face & 1u);
    vec3 fraction = clamp(path.fraction + result.t * path.direction, vec3(0.0), vec3(1.0));
    result.fraction = vec3(axis == 0 ? on_face : fraction.x, axis == 1 ? on_face : fraction.y,
                           axis == 2 ? on_face : fraction.z);
    return result;
}

bool is_glass(uint material) {
    return material_glass(material) > 0.0;
}

// Finds what is behind the glass voxel that a ray leaves. `probe` is a zero-length ray in the cell behind,
// `behind` its march.
void look_behind(PathRay path, CellExit way, Ray probe, MarchHit behind, inout PathHit found) {
    bool is_solid = behind.face == kFaceInside;
    found.hit.t = way.t;
    if (is_solid && !is_glass(behind.material)) {
        found.hit.cell = probe.cell;
        found.hit.face = way.face ^ 1u;
        found.hit.fraction = probe.fraction;
        found.hit.material = behind.material;
        return;
    }
    found.hit.cell = path.cell;
    found.hit.face = way.face;
    found.hit.fraction = way.fraction;
    found.hit.material = path.medium;
    found.leaves_medium = true;
    found.far_medium = is_solid ? behind.material : kNoMedium;
    found.stays = found.far_medium == path.medium;
}

uint march_steps = 0u;  // of the last march

void find_voxel(PathRay path, inout PathHit found) {
    bool inside = has_glass_voxels != 0u && path.medium != kNoMedium;
    Ray ray;
    ray.cell = path.cell;
    ray.fraction = path.fraction;
    ray.direction = path.direction;
    ray.t_max = kUnbounded;
    CellExit way;
    if (has_glass_voxels != 0u) {
        way = exit_cell(path);
        Ray probe = spawn_ray(path.cell, way.face, way.fraction, path.direction, kProbeLength);
        ray.cell = inside ? probe.cell : ray.cell;
        ray.fraction = inside ? probe.fraction : ray.fraction;
        ray.t_max = inside ? probe.t_max : ray.t_max;
    }
    WorldEntry entry;
    entry.ray = ray;
    entry.t = 0.0;
    entry.enters = true;
    if (start_anywhere != 0u || sphere_count != 0u) entry = enter_world(ray, frame.chunks << kChunkLog2);
    if (entry.enters) {
        MarchHit met = march(entry.ray, frame.chunks);
        march_steps = met.steps;
        count(kFaultRayUnsound, met.fault == kMarchUnsound ? 1u : 0u);
        count(kFaultMarchExhausted, met.fault == kMarchExhausted ? 1u : 0u);
        if (inside) {
            look_behind(path, way, ray, met, found);
        } else if (met.face != kFaceMiss) {
            found.hit.cell = met.cell;
            found.hit.face = met.face;
            found.hit.fraction = hit_fraction(entry.ray, met);
            found.hit.t = entry.t + met.t;
            found.hit.material = met.material;
            found.far_medium = is_glass(met.material) ? met.material : kNoMedium;
            found.stays = met.face == kFaceInside && found.far_medium != kNoMedium;
        }
    }
}

void find_sphere(PathRay path, inout PathHit found) {
    vec3 origin = local_position(path.cell, path.fraction);
    NearestSphere nearest = nearest_sphere(origin, path.direction, found.hit.t, path.own);
    if (nearest.i == kNoSphere) return;
    found = no_hit();
    found.hit.t = nearest.t;
    SphereRecord sphere = spheres[nearest.i];
    found.curvature = sphere.shape.curvature;
    found.normal = place_on_sphere(found.hit, nearest.i, sphere, origin, path.direction);
}

// The first surface that a ray hits.
PathHit next_hit(PathRay path) {
    PathHit found = no_hit();
    if (has_voxels != 0u) {
        find_voxel(path, found);
        vec3 outward = face_normal(found.hit.face);
        found.normal = found.leaves_medium ? -outward : outward;
    }
    if (sphere_count != 0u) find_sphere(path, found);
    return found;
}

// The glass sphere that a point is in.
struct GlassAround {
    uint i;         // kNoSphere: in none
    uint material;  // kNoMedium: in none
    float curvature;
};

// The smallest glass sphere around a point, other than `but`; of equal ones the one with the higher index.
GlassAround glass_around(vec3 point, uint but) {
    GlassAround around;
    around.i = kNoSphere;
    around.material = kNoMedium;
    around.curvature = 0.0;
    if (has_sphere_tree) {
        if (glass_spheres == 0u) return around;
        EnclosingSphere inmost = enclosing_in_tree(point, glass_spheres, but);
        tree_steps += inmost.steps;
        around.i = inmost.i;
        if (inmost.i != kNoSphere) around.material = spheres[inmost.i].material;
        around.curvature = inmost.curvature;
        return around;
    }
    for (uint i = 0u; i < glass_spheres; ++i) {
        SphereRecord sphere = held_spheres[i];
        bool inner = i != but && sphere.shape.curvature >= around.curvature && is_in_sphere(sphere.shape, point);
        around.i = inner ? i : around.i;
        around.material = inner ? sphere.material : around.material;
        around.curvature = inner ? sphere.shape.curvature : around.curvature;
    }
    return around;
}

// Indices of refraction on the near side of a surface, where the ray comes from, and on the far side.
struct Interface {
    float near;
    float far;
    bool is_none;  // equal on both sides, or the border of a medium inside a smaller sphere
};

float ior_of(uint medium) {
    return medium == kNoMedium ? 1.0 : material_ior(medium);
}

// `own_ior` is that of the material that was hit.
Interface interface_at(PathRay path, PathHit found, float own_ior) {
    bool on_sphere = is_on_sphere(found.hit);
    uint sphere = on_sphere ? found.hit.sphere : kNoSphere;
    GlassAround around = glass_around(local_position(found.hit.cell, found.hit.fraction), sphere);
    uint voxel_medium = has_glass_voxels != 0u ? path.medium : kNoMedium;
    uint outer_medium = around.material != kNoMedium ? around.material : voxel_medium;
    Interface between;
    between.near = 1.0;
    between.far = 1.0;
    between.is_none = true;
    if (on_sphere) {
        bool leaves = found.hit.face == kFaceSphereInside;
        float outside = ior_of(outer_medium);
        bool is_inner = around.i != kNoSphere && (around.curvature > found.curvature ||
                                                  (around.curvature == found.curvature && around.i > sphere));
        between.is_none = is_inner || outer_medium == found.hit.material;
        between.near = leaves ? own_ior : outside;
        between.far = leaves ? outside : own_ior;
    } else if (has_glass_voxels != 0u) {
        between.is_none = found.stays || around.i != kNoSphere;
        between.near = ior_of(path.medium);
        between.far = ior_of(found.far_medium);
    }
    return between;
}

const uint kEventDiffuse = 0u;  // the path ends at a diffuse surface
const uint kEventPass = 1u;     // the ray goes on as if there were no surface
const uint kEventMirror = 2u;
const uint kEventRefract = 3u;
const uint kEventRough = 4u;  // the path ends at rough metal or rough glass

struct BsdfSample {
    uint kind;
    vec3 albedo;     // of the surface
    vec3 direction;  // in which the path goes on
    float eta;       // far index of refraction / near one
    float alpha;     // of a rough surface, whose eta is 0 for metal
    uint gain_row;   // likewise
};

// Which lobe of the material a ray takes, and its new direction. `u` are two numbers in [0, 1): for the
// choice of the lobe and for Fresnel's choice. Lobes are chosen with the probability of their weight, and
// reflection with the reflectance, so that the albedo is the only remaining factor.
BsdfSample path_event(PathRay path, PathHit found, vec2 u) {
    SurfaceMaterial material = load_material(found.hit.material);
    bool from_inside = found.leaves_medium || found.stays || found.hit.face == kFaceSphereInside;
    bool is_glass_here = material.glass > 0.0 && (from_inside || u.x < material.glass);
    bool is_mirror_here = !is_glass_here && u.x < material.glass + material.mirror;
    BsdfSample event;
    event.kind = is_mirror_here ? kEventMirror : kEventDiffuse;
    event.albedo = material.albedo;
    event.eta = 1.0;
    event.alpha = material.alpha;
    event.gain_row = material.metal_row;
    event.direction = mirror_direction(path.direction, found.normal);
    if (has_rough != 0u && is_mirror_here && is_rough(material.alpha, 0.0)) {
        event.kind = kEventRough;
        event.eta = 0.0;
    }
    if (is_glass_here) {
        Interface between = interface_at(path, found, material.ior);
        event.eta = between.far / between.near;
        Dielectric surface = dielectric(-dot(path.direction, found.normal), event.eta);
        bool reflects = u.y < surface.reflectance || surface.is_total;
        event.kind = reflects ? kEventMirror : kEventRefract;
        if (has_rough != 0u && is_rough(material.alpha, event.eta)) {
            event.kind = kEventRough;
            event.gain_row = material.glass_row + (event.eta < 1.0 ? 1u : 0u);
        }
        if (between.is_none) event.kind = kEventPass;
        if (!reflects) event.direction = refracted_direction(path.direction, found.normal, event.eta, surface);
        if (between.is_none) event.direction = path.direction;
    }
    return event;
}

// The ray after an event that is not diffuse.
PathRay path_after(PathRay path, PathHit found, BsdfSample event) {
    PathRay next;
    next.direction = event.direction;
    next.medium = path.medium;
    next.own = kNoSphere;
    bool crosses = event.kind == kEventRefract || event.kind == kEventPass;
    if (is_on_sphere(found.hit)) {
        next.cell = found.hit.cell;
        next.fraction = found.hit.fraction;
        next.own = found.hit.sphere;
        return next;
    }
    // The hit's cell is on the near side only when the ray leaves glass.
    bool stays_in_cell = found.leaves_medium != crosses;
    Ray ray = spawn_ray(found.hit.cell, found.hit.face, found.hit.fraction, event.direction, kUnbounded);
    next.cell = stays_in_cell ? found.hit.cell : ray.cell;
    next.fraction = stays_in_cell ? found.hit.fraction : ray.fraction;
    next.medium = crosses ? found.far_medium : path.medium;
    return next;
}

#endif
