#include "vk/program_store.h"

#include <algorithm>

#include "vk/pipeline_cache.h"

namespace voxilux {

ProgramStore::ProgramStore(const DeviceState& device, std::span<const EmbeddedShader> shaders,
                           std::array<std::uint32_t, 2> group_size, std::filesystem::path cache_dir)
    : device_(&device),
      shaders_(shaders),
      group_size_(group_size),
      cache_dir_(std::move(cache_dir)),
      cache_(load_pipeline_cache(device, cache_dir_)) {}

ProgramStore::~ProgramStore() {
    if (created_ > 0 && !cache_dir_.empty()) save_pipeline_cache(*device_, cache_.get(), cache_dir_);
}

const Program& ProgramStore::at(std::string_view name) {
    return find(name);
}

Program& ProgramStore::find(std::string_view name) {
    const auto known = programs_.find(name);
    if (known != programs_.end()) return known->second;
    const auto shader = std::ranges::find(shaders_, name, &EmbeddedShader::name);
    if (shader == shaders_.end())
        throw InternalError(fmt::format("internal error: there is no shader '{}'", name));
    return programs_.emplace(std::string(name), create_program(*device_, *shader)).first->second;
}

PreparedDispatch ProgramStore::prepare(const Dispatch& dispatch, bool is_indirect) {
    Program& program = find(dispatch.shader);
    check_fits(program, dispatch);
    const std::vector<std::uint32_t> constants = resolve_constants(program, dispatch, group_size_);
    const std::array<std::uint32_t, 3> size = local_size(*device_, program, constants);
    PreparedDispatch prepared{.dispatch = &dispatch, .program = &program};
    if (!is_indirect)
        prepared.groups = group_counts(program.name, dispatch.extent, size, device_->info.limits.max_groups);
    auto made = program.pipelines.find(constants);
    if (made == program.pipelines.end()) {
        UniquePipeline pipeline = create_pipeline(*device_, program, constants, cache_.get());
        made = program.pipelines.emplace(constants, std::move(pipeline)).first;
        ++created_;
    }
    prepared.pipeline = made->second.get();
    return prepared;
}

}  // namespace voxilux
