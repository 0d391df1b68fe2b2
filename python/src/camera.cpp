// Cameras that are no sensors: what many rays meet, and pictures.
#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>

#include <algorithm>
#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "roboss/core/thread_pool.h"
#include "roboss/math/array_rows.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

constexpr std::size_t kRaysOfTask = 4096;
constexpr double kNearest_m = 0.01;  // that pictures show

/// `rays`: rows of an origin (m) and a unit vector, world axes. `distances`: m, or infinity; `robots`: their
/// numbers, -1: scenery or nothing.
void look(const std::shared_ptr<Simulation>& simulation, const In& rays, double max_range, unsigned threads,
          const Out& distances, const nb::ndarray<std::int32_t, nb::c_contig, nb::device::cpu>& robots) {
    const std::span<const double> from = numbers(rays);
    const std::span<double> to = numbers(distances);
    ROBOSS_CHECK(from.size() == 6 * to.size() && robots.size() == to.size(),
                 "a distance and a robot for each ray");
    RunAccess& run = simulation->access();
    without_gil({simulation}, [&] {
        const RayScene& scene = run.shapes();
        ThreadPool pool(threads);
        const auto work = [&](std::size_t task, std::size_t) {
            const std::size_t first = task * kRaysOfTask, last = std::min(first + kRaysOfTask, to.size());
            std::vector<RayScene::Ray> wanted;
            for (std::size_t i = first; i < last; ++i)
                wanted.push_back({vec3_at(&from[6 * i]), vec3_at(&from[6 * i + 3]), max_range, {}, {}});
            std::vector<RayScene::Sight> sights(wanted.size());
            scene.look(wanted, sights);
            for (std::size_t i = first; i < last; ++i) {
                const RayScene::Sight& sight = sights[i - first];
                to[i] = sight.distance;
                robots.data()[i] = sight.robot.valid() ? static_cast<std::int32_t>(sight.robot.value) : -1;
            }
        };
        pool.run((to.size() + kRaysOfTask - 1) / kRaysOfTask, work);
    });
}

/// `places`: rows of a position (m) and the axes ahead, left and up, nine numbers, all in world axes.
/// `colours`: (places, rows, columns, 3).
void picture(const std::shared_ptr<Simulation>& simulation, const In& places, int columns, int rows,
             double fov, double far,
             const nb::ndarray<std::uint8_t, nb::c_contig, nb::device::cpu>& colours) {
    const std::span<const double> from = numbers(places);
    CameraOptics optics;
    optics.width = columns, optics.height = rows, optics.horizontal_fov = fov;
    optics.far = far, optics.near = std::fmin(kNearest_m, far / 2);
    const std::size_t size = 3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    ROBOSS_CHECK(from.size() % 12 == 0 && colours.size() == from.size() / 12 * size,
                 "a picture for each place");
    RunAccess& run = simulation->access();
    const Result<> done = without_gil({simulation}, [&]() -> Result<> {
        for (std::size_t i = 0; i < from.size() / 12; ++i) {
            const double* place = &from[12 * i];
            Transform X_WC;
            X_WC.p = vec3_at(place);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t r = 0; r < 3; ++r) X_WC.R(r, c) = place[3 + 3 * c + r];
            const Result<Image<std::uint8_t>> seen = run.picture(X_WC, optics);
            if (!seen) return seen.error();
            std::copy(seen.value().samples.begin(), seen.value().samples.end(), colours.data() + i * size);
        }
        return Ok{};
    });
    if (!done) raise("SensorError", done.error());
}

}  // namespace

void bind_camera(nb::module_& module) {
    module.def("look", &look, nb::arg("simulation"), nb::arg("rays"), nb::arg("max_range"),
               nb::arg("threads"), nb::arg("distances"), nb::arg("robots"));
    module.def("picture", &picture, nb::arg("simulation"), nb::arg("places"), nb::arg("columns"),
               nb::arg("rows"), nb::arg("fov"), nb::arg("far"), nb::arg("colours"));
}

}  // namespace roboss_python
