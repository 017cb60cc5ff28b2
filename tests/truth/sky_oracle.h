#pragma once

// Radiances that another program has traced in double precision, without tables: sky_truth.cpp of the shared
// data.

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "scene/atmosphere.h"
#include "support/shared_data.h"

namespace voxilux::test {

inline const nlohmann::json& sky_oracle() {
    static const nlohmann::json data = [] {
        const std::vector<std::byte> bytes =
            read_file(shared_data() / "oracle" / "sky_expected.json", std::size_t{1} << 24);
        return nlohmann::json::parse(reinterpret_cast<const char*>(bytes.data()),
                                     reinterpret_cast<const char*>(bytes.data()) + bytes.size());
    }();
    return data;
}

inline glm::dvec3 colour_of(const nlohmann::json& list) {
    return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

inline gpu::SkyParams sky_at(double altitude_km, double sun_deg) {
    Scene scene;
    scene.sky.model = SkyModel::atmosphere;
    scene.sky.altitude_m = static_cast<float>(altitude_km * 1000.0);
    scene.sun.azimuth_deg = 0.0f;
    scene.sun.elevation_deg = static_cast<float>(sun_deg);
    scene.sun.irradiance = glm::vec3(1.0f);
    return sky_params(scene);
}

}  // namespace voxilux::test
