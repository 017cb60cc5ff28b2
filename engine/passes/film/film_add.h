#pragma once

#include "passes/plane.h"
#include "plan/film_planes.h"

namespace voxilux {

// Adds a plane of the tile to the exact sums of a film plane.
void record_film_add(const RenderPlan& plan, const DispatchTile& tile, const FilmPlane& film,
                     const Plane& values, Recording& recording);

// Adds the squares of a plane of the tile. Sums that are full stay as they are.
void record_film_square(const RenderPlan& plan, const DispatchTile& tile, const FilmPlane& film,
                        const Plane& values, Recording& recording);

}  // namespace voxilux
