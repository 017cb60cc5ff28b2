#include "estimators/film_error.h"

#include "estimators/bias_estimate.h"

namespace voxilux {

ErrorEstimate error_of(const FilmSums& film) {
    const FilmHalves halves(film);
    const auto squares = film.sums.find(kSquaresPlane);
    const bool has_squares = film.is_independent && squares != film.sums.end();
    const ErrorEstimate noise = estimate_error(film.width, film.height, halves.a, halves.b,
                                               has_squares ? FilmSquares(squares->second) : FilmSquares{});
    if (!film.sums.contains("bias_a")) return noise;
    return with_bias(noise, estimate_bias(film.width, film.height, halves.a, halves.b, film.sums.at("bias_a"),
                                          film.sums.at("bias_b")));
}

}  // namespace voxilux
