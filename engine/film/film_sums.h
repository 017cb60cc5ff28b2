#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "film/film.h"
#include "formats/image.h"

namespace voxilux {

// A whole film on the host: all that its pictures are made from. Sums are fixed point (film.h) and exact, so
// that films of different samples can be added in any order.
struct FilmSums {
    int width = 0;
    int height = 0;
    bool is_independent = false;      // the samples of a pixel, of each other
    std::vector<std::uint32_t> even;  // per row, samples with an even number: those in plane beauty_a
    std::vector<std::uint32_t> odd;   // those in beauty_b
    std::map<std::string, std::vector<std::int64_t>> sums;  // by film plane, [height][width][components]
    std::map<std::string, std::vector<float>> firsts;       // as seen by the first sample: position, depth

    bool operator==(const FilmSums&) const = default;
};

// Plane of the squares of the beauty, where there is one.
inline constexpr const char* kSquaresPlane = "squares";

// The two halves of the beauty with the samples of each pixel. The film outlives them.
struct FilmHalves {
    std::vector<std::uint64_t> even;
    std::vector<std::uint64_t> odd;
    FilmHalf a;
    FilmHalf b;

    explicit FilmHalves(const FilmSums& film);
    FilmHalves(const FilmHalves&) = delete;
    FilmHalves& operator=(const FilmHalves&) = delete;
};

// Adds the samples of another film of the same size and planes. Where both have positions and depths those of
// `film` stay.
void add_film(FilmSums& film, const FilmSums& more);

// Adds rows of another film of the same planes, which begin at row `first`; planes that `film` lacks are
// made. The samples of rows are left as they are, and so are positions and depths.
void add_rows(FilmSums& film, std::size_t first, const FilmSums& rows);
// Takes positions and depths from such rows.
void set_firsts(FilmSums& film, std::size_t first, const FilmSums& rows);

// The pictures: those of film_image(), and for every other plane its mean over all samples, named
// PLANE.R .G .B or PLANE.Y; A for the coverage, which the beauty is multiplied by; N.X .Y .Z for normals; P.X
// .Y .Z and Z of the first sample. variance.R .G .B is the variance of the beauty by mean_variance(); above
// the truth where samples are not independent. bias.R .G .B is what the radius of the photons adds to the
// beauty.
[[nodiscard]] Image picture_of(const FilmSums& film);
// The same, with the planes gone one by one as they are used: there is hardly ever a second copy in memory.
[[nodiscard]] Image picture_of(FilmSums&& film);

// Moves the sums into the whole-number planes of an image: sums.PLANE.COMPONENT.lo and .hi (kSumsLayer).
// Planes leave the film one by one, so that there is hardly ever a second copy in memory.
void store_sums(FilmSums film, Image& image);

// The film that store_sums() and picture_of() put into an image, without the samples of its rows; or why
// there is none.
[[nodiscard]] Result<FilmSums> load_sums(const Image& image);

}  // namespace voxilux
