#include "version.h"

#include <fmt/format.h>

#include "base/build_id.h"
#include "vk/device.h"

namespace voxilux {

std::string version_text() {
    return fmt::format("voxilux " VX_VERSION "\nbuild      {}, " VX_BUILT_BY
                       "\nvulkan     loader {}\nbuilt with " VX_BUILT_WITH,
                       build_id(), loader_version());
}

}  // namespace voxilux
