// C functions of the crate in this folder; src/lib.rs says what they do.
#pragma once

#include <cstdint>

extern "C" {
struct RapierSim;
RapierSim* rapier_new(const double* gravity, double dt, std::uint32_t iterations, bool ccd, bool sleeps,
                      double length_unit);
void rapier_free(RapierSim* sim);
std::uint32_t rapier_body(RapierSim* sim, double mass, const double* centre, const double* moments,
                          const double* frame, bool gravity, bool ccd);
void rapier_shape(RapierSim* sim, std::uint32_t body, std::uint32_t kind, const double* size,
                  const double* at, double friction, double restitution, std::uint32_t groups,
                  std::uint32_t robot, bool filter, const double* belt);
std::uint32_t rapier_joint(RapierSim* sim, std::uint32_t kind, std::uint32_t body1, std::uint32_t body2,
                           const double* frame1, const double* frame2, double lower, double upper);
void rapier_motor(RapierSim* sim, std::uint32_t joint, double position, double velocity, double stiffness,
                  double damping, double most);
void rapier_state(const RapierSim* sim, std::uint32_t body, double* out);
void rapier_set_state(RapierSim* sim, std::uint32_t body, const double* state);
void rapier_push(RapierSim* sim, std::uint32_t body, const double* impulse, const double* turn);
void rapier_step(RapierSim* sim);
}
