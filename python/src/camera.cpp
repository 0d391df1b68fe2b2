// Rays for pictures: what many rays meet, on all threads.
#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>

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

}  // namespace

void bind_camera(nb::module_& module) {
    module.def("look", &look, nb::arg("simulation"), nb::arg("rays"), nb::arg("max_range"),
               nb::arg("threads"), nb::arg("distances"), nb::arg("robots"));
}

}  // namespace roboss_python
