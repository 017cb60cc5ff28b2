// The Python module voxilux: the subcommands render, voxelize, compare and convert on values in memory.

#include <pybind11/pybind11.h>

#include <mutex>
#include <optional>

#include "base/file.h"
#include "command_line.h"
#include "compare/compare.h"
#include "exit_message.h"
#include "formats/vox_read.h"
#include "formats/vox_write.h"
#include "parse_values.h"
#include "python/numpy_values.h"
#include "python/render_in_memory.h"
#include "voxelize/voxelize.h"
#include "voxelize/voxelize_report.h"
#include "voxelizer/import_voxels.h"
#include "voxelizer/vox_output.h"

namespace py = pybind11;

namespace voxilux {
namespace {

// The functions of Vulkan are loaded once for the process, so renders of several threads take turns.
std::mutex& device_mutex() {
    static std::mutex mutex;
    return mutex;
}

py::tuple render(const py::object& scene, const py::kwargs& flags) {
    RenderCommand command;
    std::vector<std::string> words = words_of(flags);
    std::optional<VoxFile> voxels;
    if (is_path(scene))
        words.insert(words.end(), {"--", path_of(scene)});
    else if (py::isinstance<py::dict>(scene))
        voxels = vox_file_of(py::reinterpret_borrow<py::dict>(scene), "voxels");
    else
        refuse("a scene is a path or a dict of voxels");
    parse_words(words, [&](Flags& all) { add_render_flags(all, command); });
    if (voxels) command.scene.input = "voxels";
    if (voxels) command.scene.voxels = &*voxels;
    command.report.quiet = true;  // the report tells what a command line prints
    std::atomic<bool> is_interrupted{false};
    std::optional<py::error_already_set> raised;  // by Ctrl-C
    const auto look_for_signals = [&](const Progress&) {
        const py::gil_scoped_acquire lock;
        if (raised || PyErr_CheckSignals() == 0) return;
        raised.emplace();
        is_interrupted = true;
    };
    RenderedInMemory rendered;
    {
        const py::gil_scoped_release unlock;
        const std::lock_guard turn(device_mutex());
        rendered = render_in_memory(command, is_interrupted, look_for_signals);
    }
    if (raised) throw *raised;
    return py::make_tuple(planes_of(std::move(rendered.image)), object_of(rendered.report));
}

py::tuple voxelize_file(const py::object& mesh, const py::kwargs& flags) {
    VoxelizeCommand command;
    std::vector<std::string> words = words_of(flags);
    words.insert(words.end(), {"--", path_of(mesh)});
    parse_words(words, [&](Flags& all) { add_voxelize_flags(all, command); });
    if (!command.output.empty() || !command.report.json.empty())
        refuse("output and json: voxelize returns what these files would hold");
    VoxFile file;
    nlohmann::ordered_json report;
    {
        const py::gil_scoped_release unlock;
        StepTimes times;
        const Voxelized made = voxelize(command, times);
        file = vox_file_of(made.set, made.palette, made.mesh, "voxels");
        const VoxOutput written{.models = file.models.size(), .voxels = made.set.surface + made.set.interior};
        report = report_json(
            {command, made.mesh, made.set, made.palette, written, times, made.warnings, command.output});
    }
    report.erase("output");
    report.erase("bytes");
    return py::make_tuple(voxels_of(file), object_of(report));
}

py::object compare(const py::object& ref, const py::object& test, const py::object& mask,
                   const py::object& box) {
    Image reference = image_of(ref), tested = image_of(test);
    std::optional<Image> masked;
    if (!mask.is_none()) masked = image_of(mask);
    std::optional<PixelBox> pixels;
    if (!box.is_none()) {
        const auto corners = py::cast<std::array<int, 4>>(box);
        pixels = parse_pixel_box("box", fmt::format("{}", fmt::join(corners, ",")));
    }
    nlohmann::ordered_json metrics;
    {
        const py::gil_scoped_release unlock;
        metrics = metrics_json(compare_images(std::move(reference), std::move(tested),
                                              {.box = pixels, .mask = masked ? &*masked : nullptr}));
    }
    return object_of(metrics);
}

py::dict read_vox_file(const py::object& path) {
    const std::string file = path_of(path);
    VoxFile voxels;
    {
        const py::gil_scoped_release unlock;
        voxels = has_ending(file, ".vox") ? load_vox(file) : import_voxels(file, {}).file;
    }
    return voxels_of(voxels);
}

void write_vox_file(const py::object& path, const py::dict& voxels) {
    const std::string file = path_of(path);
    if (!has_ending(file, ".vox")) refuse(fmt::format("{}: voxels are written as .vox", file));
    const VoxFile content = vox_file_of(voxels, std::filesystem::path(file).stem().string());
    const py::gil_scoped_release unlock;
    write_file_atomically(file, write_vox(content));
}

// Sets voxilux.Error with the line and the exit code of the command line.
void set_error(const std::exception& error) {
    const ExitMessage message = exit_message_of(error);
    const py::object type = py::module_::import("voxilux").attr("Error");
    py::object value = type(message.text);
    value.attr("code") = static_cast<int>(message.code);
    PyErr_SetObject(type.ptr(), value.ptr());
}

void translate(std::exception_ptr thrown) {
    try {
        if (thrown) std::rethrow_exception(thrown);
    } catch (const py::builtin_exception&) {
        throw;
    } catch (const std::exception& error) {
        set_error(error);
    }
}

}  // namespace
}  // namespace voxilux

PYBIND11_MODULE(voxilux, module) {
    using namespace voxilux;
    module.doc() =
        "Renders voxel scenes. Flags of the command line are keyword arguments: see docs/python.md.";
    module.attr("Error") = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
        "voxilux.Error", "What failed, in one line; code is the exit code of the command line.",
        PyExc_RuntimeError, nullptr));
    py::register_local_exception_translator(translate);
    module.def(
        "render", render, py::arg("scene"),
        "Renders a scene file, a .vox file, any file that is converted to voxels, or a dict of voxels.\n\n"
        "Returns (channels, report): the channels of an EXR as float32 arrays [height][width] in linear\n"
        "light (\"R\", \"albedo.R\", \"error.Y\", ...), and the report of --json as a dict. Keyword\n"
        "arguments are the flags of `voxilux render`: size=(640, 360), spp=64, error=\"1%\".");
    module.def("voxelize", voxelize_file, py::arg("mesh"),
               "Voxelizes a mesh file. Returns (voxels, report). Keyword arguments are the flags of\n"
               "`voxilux voxelize`: resolution=256, solid=True.");
    module.def(
        "compare", compare, py::arg("ref"), py::arg("test"), py::kw_only(), py::arg("mask") = py::none(),
        py::arg("box") = py::none(),
        "Metrics between two pictures as a dict. A picture is a path (EXR or PNG), an array of floats\n"
        "[height][width][3] in linear light, or the channels that render returns. Pixels that are black\n"
        "in mask, or outside box = (x0, y0, x1, y1), are left out.");
    module.def(
        "read_vox", read_vox_file, py::arg("path"),
        "The voxels of a .vox file, or of a file that is converted to it: a dict with \"voxels\", palette\n"
        "indices [x][y][z] as uint8 (0 is empty), \"palette\", [256][4] sRGB codes by index, \"low\", the\n"
        "cell of voxels[0, 0, 0], and \"materials\", MATL attributes by index.");
    module.def("write_vox", write_vox_file, py::arg("path"), py::arg("voxels"),
               "Writes a .vox file of a dict as read_vox returns it; all but \"voxels\" may be missing.");
}
