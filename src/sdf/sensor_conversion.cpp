// Sensors: laser (ray, lidar and their gpu_ names), gps, and our odometer and gyrocompass.
#include <cmath>

#include "sdf/conversion.h"

namespace roboss::sdf_import {
namespace {

/// <noise type="gaussian"> or, as older files write it, <noise><type>gaussian</type>.
NoiseSpec read_noise(const Element& noise, const Import& import) {
    NoiseSpec spec;
    if (!noise) return spec;
    std::string type = noise.node.attribute("type").value();
    if (type.empty()) type = noise.text("type");
    if (type == "none") return spec;
    if (!type.empty() && type != "gaussian" && type != "gaussian_quantized") {
        import.diagnostics().warning(noise.where(), "noise",
                                     "noise of type '" + type + "' is not known; there is none",
                                     "Use gaussian or gaussian_quantized.");
        return spec;
    }
    const ElementReader& reader = import.reader;
    spec.mean = reader.number(noise, "mean", 0);
    spec.stddev = reader.number(noise, "stddev", 0);
    spec.bias_mean = reader.number(noise, "bias_mean", 0);
    spec.bias_stddev = reader.number(noise, "bias_stddev", 0);
    if (type == "gaussian_quantized") spec.precision = reader.number(noise, "precision", 0);
    if (reader.number(noise, "dynamic_bias_stddev", 0) != 0) {
        import.diagnostics().note(noise.where(), "noise",
                                  "a bias that drifts (<dynamic_bias_stddev>) is still to come");
    }
    return spec;
}

struct Scan {
    int samples = 1;
    double min_angle = 0, max_angle = 0;
};

Scan read_scan(const Element& scan, const Import& import) {
    Scan result;
    if (!scan) return result;
    result.samples = import.reader.integer(scan, "samples", 1);
    result.min_angle = import.reader.angle(scan, "min_angle", 0);
    result.max_angle = import.reader.angle(scan, "max_angle", 0);
    if (result.samples < 1) {
        import.diagnostics().error(
            scan.where(), "bad-value",
            "<samples> is " + std::to_string(result.samples) + "; a laser needs at least 1",
            "Write the number of beams.");
        result.samples = 1;
    }
    if (import.reader.number(scan, "resolution", 1) != 1) {
        import.diagnostics().note(
            scan.where(), "scan-resolution",
            "<resolution> of a scan is ignored: every one of the <samples> is a beam of its own");
    }
    return result;
}

void read_laser(const Element& sensor, const Import& import, SensorSpec& spec) {
    const Element ray = sensor.child("lidar") ? sensor.child("lidar") : sensor.child("ray");
    if (!ray) {
        import.diagnostics().warning(sensor.where(), "sensor",
                                     "laser '" + spec.name + "' has no <lidar> (or <ray>) element",
                                     "Add <lidar> with <scan> and <range>.");
        spec.kind = SensorKind::kUnsupported;
        return;
    }
    const Scan horizontal = read_scan(ray.child("scan").child("horizontal"), import);
    const Scan vertical = read_scan(ray.child("scan").child("vertical"), import);
    spec.samples = horizontal.samples;
    spec.min_angle = horizontal.min_angle;
    spec.max_angle = horizontal.max_angle;
    spec.vertical_samples = vertical.samples;
    spec.vertical_min_angle = vertical.min_angle;
    spec.vertical_max_angle = vertical.max_angle;
    const Element range = ray.child("range");
    spec.range_min = import.reader.number(range, "min", 0);
    spec.range_max = import.reader.number(range, "max", 0, Finite::kInfinityAllowed);
    spec.range_resolution = import.reader.number(range, "resolution", 0);
    if (!(spec.range_min >= 0 && spec.range_max > spec.range_min)) {
        import.diagnostics().error(range ? range.where() : ray.where(), "bad-value",
                                   "the range of laser '" + spec.name + "' is from " +
                                       std::to_string(spec.range_min) + " to " +
                                       std::to_string(spec.range_max) + " m: it sees nothing",
                                   "Write <range> with 0 <= <min> < <max>.");
    }
    spec.noise = read_noise(ray.child("noise"), import);
}

void read_gps(const Element& sensor, const Import& import, SensorSpec& spec) {
    const Element gps = sensor.child("navsat") ? sensor.child("navsat") : sensor.child("gps");
    const Element position = gps.child("position_sensing"), velocity = gps.child("velocity_sensing");
    spec.position_horizontal_noise = read_noise(position.child("horizontal").child("noise"), import);
    spec.position_vertical_noise = read_noise(position.child("vertical").child("noise"), import);
    spec.velocity_horizontal_noise = read_noise(velocity.child("horizontal").child("noise"), import);
    spec.velocity_vertical_noise = read_noise(velocity.child("vertical").child("noise"), import);
}

void read_odometer(const Element& sensor, const std::string& scope, const Import& import, SensorSpec& spec) {
    for (const auto joint : sensor.node.children("joint")) spec.joints.push_back(scope + joint.text().get());
    spec.wheel_radius = import.reader.number(sensor, "wheel_radius", 0);
    if (spec.joints.empty()) {
        import.diagnostics().error(sensor.where(), "sensor", "odometer '" + spec.name + "' names no joint",
                                   "Add <joint>NAME</joint> for every wheel it counts.");
    }
}

bool is_laser(const std::string& type) {
    return type == "ray" || type == "lidar" || type == "gpu_ray" || type == "gpu_lidar";
}

}  // namespace

SensorSpec convert_sensor(const Element& sensor, const Pose& X_LS, const std::string& scope,
                          const Import& import) {
    SensorSpec spec;
    spec.name = sensor.name();
    spec.sdf_type = sensor.node.attribute("type").value();
    spec.where = sensor.where();
    spec.X_LS = X_LS;
    spec.update_rate_hz = import.reader.number(sensor, "update_rate", 0);
    const bool ours = std::string(sensor.node.name()) == "roboss:sensor";
    if (!ours && is_laser(spec.sdf_type)) {
        spec.kind = SensorKind::kLaser;
        read_laser(sensor, import, spec);
    } else if (!ours && (spec.sdf_type == "gps" || spec.sdf_type == "navsat")) {
        spec.kind = SensorKind::kGps;
        read_gps(sensor, import, spec);
    } else if (ours && spec.sdf_type == "odometer") {
        spec.kind = SensorKind::kOdometer;
        read_odometer(sensor, scope, import, spec);
        spec.noise = read_noise(sensor.child("noise"), import);
    } else if (ours && spec.sdf_type == "gyrocompass") {
        spec.kind = SensorKind::kCompass;
        spec.noise = read_noise(sensor.child("noise"), import);
        spec.gyro_noise = read_noise(sensor.child("gyro").child("noise"), import);
    } else if (ours) {
        import.diagnostics().error(
            sensor.where(), "sensor",
            "<roboss:sensor> '" + spec.name + "' has the type '" + spec.sdf_type + "', which is not known",
            "Use odometer or gyrocompass, or a <sensor> of SDFormat.");
    } else {
        import.diagnostics().warning(
            sensor.where(), "sensor-to-come",
            "sensors of type '" + spec.sdf_type + "' are still to come; they measure nothing");
    }
    return spec;
}

}  // namespace roboss::sdf_import
