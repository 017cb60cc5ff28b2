#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "embedded.h"
#include "vk/program.h"

namespace voxilux {

// A dispatch with everything that is looked up before recording starts.
struct PreparedDispatch {
    const Dispatch* dispatch = nullptr;
    const Program* program = nullptr;
    VkPipeline pipeline = VK_NULL_HANDLE;
    std::array<std::uint32_t, 3> groups{};  // zeros when a buffer gives them
};

// The programs and pipelines of an executor, created on first use. The destructor stores the pipeline cache.
class ProgramStore {
  public:
    ProgramStore(const DeviceState& device, std::span<const EmbeddedShader> shaders,
                 std::array<std::uint32_t, 2> group_size, std::filesystem::path cache_dir);
    ProgramStore(const ProgramStore&) = delete;
    ProgramStore& operator=(const ProgramStore&) = delete;
    ~ProgramStore();

    // Throws InternalError when there is no shader of that name.
    [[nodiscard]] const Program& at(std::string_view name);

    // Checks the dispatch against its shader (see Executor::run) and makes its pipeline.
    [[nodiscard]] PreparedDispatch prepare(const Dispatch& dispatch, bool is_indirect);

    [[nodiscard]] std::uint64_t pipelines_created() const { return created_; }

  private:
    Program& find(std::string_view name);

    const DeviceState* device_;
    std::span<const EmbeddedShader> shaders_;
    std::array<std::uint32_t, 2> group_size_;
    std::filesystem::path cache_dir_;
    UniquePipelineCache cache_;
    std::map<std::string, Program, std::less<>> programs_;
    std::uint64_t created_ = 0;
};

}  // namespace voxilux
