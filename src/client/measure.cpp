// One reading by kind.
#include "client/measure.h"

#include "core/check.h"

namespace roboss {

Sample measure(const SensorQuery& at, const std::function<RayScene&()>& rays) {
    const SensorSpec& spec = at.model.type_of(at.robot).sensors[at.sensor].spec;
    switch (spec.kind) {
        case SensorKind::kLaser:
            return read_laser(at.model, at.robot, at.sensor, at.state, at.tick, at.seed, rays());
        case SensorKind::kGps:
            return read_gps(at.model, at.robot, at.sensor, at.state, at.tick, at.seed);
        case SensorKind::kCompass:
            return read_compass(at.model, at.robot, at.sensor, at.state, at.tick, at.seed);
        case SensorKind::kOdometer:
            return read_odometer(at.model, at.robot, at.sensor, at.state, at.tick, at.seed);
        case SensorKind::kUnsupported:
            break;
    }
    ROBOSS_CHECK(false, spec.name + " measures nothing");
    return {};
}

}  // namespace roboss
