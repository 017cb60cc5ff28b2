#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "film/film.h"
#include "formats/image.h"

namespace voxilux {

// A whole film on the host: all that its images are made from. Sums are fixed point (film.h) and exact, so
// that films of different samples can be added in any order.
struct FilmSums {
    int width = 0;
    int height = 0;
    bool is_independent = false;      // whether the samples of a pixel are
    std::vector<std::uint32_t> even;  // per row, samples with an even number: those in plane beauty_a
    std::vector<std::uint32_t> odd;   // those in beauty_b
    std::map<std::string, std::vector<std::int64_t>> sums;  // by film plane, [height][width][components]
    std::map<std::string, std::vector<float>> firsts;       // as seen by the first sample: position, depth

    bool operator==(const FilmSums&) const = default;
};

// Plane of the squares of the beauty, where there is one.
inline constexpr const char* kSquaresPlane = "squares";

// The two halves of the beauty with the sample counts of each pixel. The film must outlive them.
struct FilmHalves {
    std::vector<std::uint64_t> even;
    std::vector<std::uint64_t> odd;
    FilmHalf a;
    FilmHalf b;

    explicit FilmHalves(const FilmSums& film);
    FilmHalves(const FilmHalves&) = delete;
    FilmHalves& operator=(const FilmHalves&) = delete;
};

// Adds the samples of another film of the same size and planes. Where both have positions and depths, those
// of `film` stay.
void add_film(FilmSums& film, const FilmSums& more);

// Adds rows of another film of the same planes, which begin at row `first`; planes that `film` lacks are
// made. Sample counts, positions and depths are left as they are.
void add_rows(FilmSums& film, std::size_t first, const FilmSums& rows);
// Copies positions and depths from such rows.
void set_firsts(FilmSums& film, std::size_t first, const FilmSums& rows);

// The channels of film_image(), and for every other plane its mean over all samples, named PLANE.R .G .B or
// PLANE.Y; A for the coverage, which the beauty is multiplied by; N.X .Y .Z for normals; P.X .Y .Z and Z of
// the first sample. variance.R .G .B is the variance of the beauty by mean_variance(), too large where
// samples are not independent. bias.R .G .B is the error that the photons' radius adds to the beauty.
[[nodiscard]] Image picture_of(const FilmSums& film);
// The same, but each plane is freed once it is used, so that memory hardly ever holds a second copy.
[[nodiscard]] Image picture_of(FilmSums&& film);

// Moves the sums into the whole-number planes of an image: sums.PLANE.COMPONENT.lo and .hi (kSumsLayer).
// Planes are moved one by one, so that memory hardly ever holds a second copy.
void store_sums(FilmSums film, Image& image);

// The film that store_sums() and picture_of() put into an image, without the sample counts of its rows; or
// why there is none.
[[nodiscard]] Result<FilmSums> load_sums(const Image& image);

}  // namespace voxilux
