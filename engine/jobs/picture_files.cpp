#include "jobs/picture_files.h"

#include <cmath>
#include <utility>

#include "base/file.h"
#include "base/json.h"
#include "formats/png.h"
#include "jobs/report.h"
#include "scene/scene_camera.h"

namespace voxilux {
namespace {

// Transforms scene points to the camera's right, up and backward axes, as OpenEXR's worldToCamera.
glm::dmat4 world_to_camera(const Camera& camera) {
    const glm::dmat3 basis = camera_basis(camera);
    const glm::dmat3 axes(basis[0], basis[1], -basis[2]);
    glm::dmat4 matrix(glm::transpose(axes));
    matrix[3] = glm::dvec4(-(glm::transpose(axes) * camera.position), 1.0);
    return matrix;
}

// Transforms camera points: after division by w, x and y are in [-1, 1] over the image and z tends to 1 with
// distance. Orthographic: z is minus the distance. A panorama has no such matrix.
std::optional<glm::dmat4> camera_to_ndc(const Camera& camera, glm::ivec2 size) {
    if (camera.projection == Projection::orthographic) {
        glm::dmat4 scaled(1.0);
        for (int axis = 0; axis < 2; ++axis)
            scaled[axis][axis] = 2.0 * camera.pixels_per_voxel / static_cast<double>(size[axis]);
        return scaled;
    }
    if (camera.projection != Projection::perspective) return std::nullopt;
    const double up = 1.0 / std::tan(glm::radians(camera.fov_y_deg) / 2.0);
    glm::dmat4 matrix(0.0);
    matrix[0][0] = up * static_cast<double>(size.y) / static_cast<double>(size.x);
    matrix[1][1] = up;
    matrix[2][2] = -1.0;
    matrix[2][3] = -1.0;
    matrix[3][2] = -1.0;  // the near plane, z = -1, is one voxel away
    return matrix;
}

ExrOptions exr_options(const PictureFiles& pictures, const Scene& scene, const RenderPlan& plan) {
    const Camera camera = on_pixel_grid(camera_of(scene), glm::dvec2(plan.image_size));
    const glm::dmat4 to_camera = world_to_camera(camera);
    const std::optional<glm::dmat4> to_ndc = camera_to_ndc(camera, plan.image_size);
    return {.window = {plan.first_pixel.x, plan.first_pixel.y, plan.image_size.x, plan.image_size.y},
            .reproducible = pictures.reproducible,
            .software = "voxilux " VX_VERSION,
            .comments = pictures.scene_name,
            .background = scene.background.shown == Backdrop::color ? std::optional(scene.background.radiance)
                                                                    : std::nullopt,
            .world_to_camera = glm::mat4(to_camera),
            .world_to_ndc = to_ndc ? std::optional(glm::mat4(*to_ndc * to_camera)) : std::nullopt};
}

nlohmann::ordered_json report_of_picture(const PictureFiles& pictures, const Scene& scene,
                                         const RenderOutcome& outcome) {
    return pictures.reproducible ? reproducible_report_json(scene, outcome) : report_json(scene, outcome);
}

// In linear light, because premultiplied colours are added.
Image laid_over(Image image, glm::vec3 background) {
    const std::vector<float>& alpha = image.channels.at("A").pixels;
    for (const std::string prefix : {"", "denoised."}) {
        for (int c = 0; c < 3; ++c) {
            const auto channel = image.channels.find(prefix + "RGB"[c]);
            if (channel == image.channels.end()) continue;
            std::vector<float>& pixels = channel->second.pixels;
            for (std::size_t i = 0; i < pixels.size(); ++i)
                pixels[i] += (1.0f - alpha[i]) * background[c];
        }
    }
    image.channels.erase("A");
    return image;
}

}  // namespace

bool is_exr(const std::filesystem::path& file) {
    return has_ending(file, ".exr");
}

bool is_png(const std::filesystem::path& file) {
    return has_ending(file, ".png");
}

void write_picture(const std::filesystem::path& file, const Image& exr, const ExrOptions& options,
                   const Image& png, const ToneMapOptions& tone, WriteFaults& faults) {
    if (is_exr(file)) {
        const bool is_laid = options.background && exr.channels.contains("A");
        const WriteReport written = is_laid ? write_exr(file, laid_over(exr, *options.background), options)
                                            : write_exr(file, exr, options);
        faults["exr_clamped"] += written.clamped;
        faults["exr_non_finite"] += written.non_finite;
    } else {
        ToneMapOptions laid = tone;
        laid.background = options.background;
        const DisplayImage display = to_display(png, laid);
        faults["png_nan"] += display.nan;
        write_png(file, display.image);
    }
}

ToneMapOptions tone_of(const PictureFiles& pictures, const std::optional<float>& exposure_ev) {
    ToneMapOptions tone = pictures.tone;
    if (exposure_ev && !tone.is_exposure_given) tone.exposure_ev = exposure_ev;
    return tone;
}

void write_pictures(const PictureFiles& pictures, const Scene& scene, RenderOutcome& outcome) {
    outcome.image.attributes[kReportAttribute] = json_text(report_of_picture(pictures, scene, outcome));
    const Image part = pictures.is_part ? image_of(part_to_write(pictures, scene, outcome)) : Image{};
    if (outcome.denoised) add_denoised(*outcome.denoised, outcome.image);
    const Image shown = outcome.denoised ? shown_picture(*outcome.denoised, outcome.image) : Image{};
    const ToneMapOptions tone = tone_of(pictures, scene.exposure_ev);
    for (const std::string& file : pictures.files)
        write_picture(file, pictures.is_part ? part : outcome.image,
                      exr_options(pictures, scene, outcome.plan), outcome.denoised ? shown : outcome.image,
                      tone, outcome.statistics.faults);
}

FilmPart part_to_write(const PictureFiles& pictures, const Scene& scene, RenderOutcome outcome) {
    nlohmann::ordered_json report = report_of_picture(pictures, scene, outcome);
    const ExrOptions file = exr_options(pictures, scene, outcome.plan);
    return part_of(scene, std::move(outcome), std::move(report), file, pictures.spp);
}

}  // namespace voxilux
