// The summary as JSON and as the last lines of the output.
#include "app/output/summary.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/output/cannot_write.h"
#include "core/hash.h"

namespace roboss {

std::string to_json(const Summary& s) {
    nlohmann::ordered_json o;
    o["world"] = s.world;
    o["robots"] = s.robots;
    o["ticks"] = s.ticks;
    o["dt_s"] = s.dt_s;
    o["sim_time_s"] = s.sim_time_s;
    o["wall_time_s"] = s.wall_time_s;
    o["real_time_factor"] = s.real_time_factor;
    o["step_cpu_s"] = s.step_cpu_s;
    o["windows"] = s.windows;
    o["windows_repeated"] = s.windows_repeated;
    o["islands_mean"] = s.islands_mean;
    o["contacts_mean"] = s.contacts_mean;
    o["building_contacts_mean"] = s.building_contacts_mean;
    o["simulators"] = s.simulators;
    o["losses"] = s.losses;
    o["recoveries"] = s.recoveries;
    o["migrations"] = s.migrations;
    o["cuts"] = s.cuts;
    o["model_hash"] = to_hex(s.model_hash);
    o["state_hash"] = to_hex(s.state_hash);
    return o.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string to_text(const Summary& s) {
    return fmt::format(
        "world             {}\n"
        "robots            {}\n"
        "simulated         {:.3f} s ({} steps of {:g} ms), world time now {:.3f} s\n"
        "wall time         {:.2f} s, {:.1f} x real time\n"
        "stepping          {:.2f} s of CPU, {:.2f} us per robot and step\n"
        "windows           {} ({} repeated), {:.1f} islands on average\n"
        "contacts          {:.1f} points per step, {:.4f} of them with static models\n"
        "simulators        {} at the end, {} lost, {} robots migrated\n"
        "model hash        {}\n"
        "state hash        {}\n",
        s.world, s.robots, static_cast<double>(s.ticks) * s.dt_s, s.ticks, s.dt_s * 1e3, s.sim_time_s,
        s.wall_time_s, s.real_time_factor, s.step_cpu_s,
        s.ticks > 0 && s.robots > 0
            ? s.step_cpu_s * 1e6 / (static_cast<double>(s.ticks) * static_cast<double>(s.robots))
            : 0.0,
        s.windows, s.windows_repeated, s.islands_mean, s.contacts_mean, s.building_contacts_mean,
        s.simulators, s.losses, s.migrations, to_hex(s.model_hash), to_hex(s.state_hash));
}

Result<> write_json(const Summary& summary, const std::string& file) {
    std::ofstream out(file);
    out << to_json(summary);
    out.close();
    if (!out) return cannot_write(file, "the summary to ");
    return Ok{};
}

}  // namespace roboss
