// The summary as JSON and as the last lines of the output.
#include "app/output/summary.h"

#include <fmt/format.h>

#include <numeric>

#include <nlohmann/json.hpp>

#include "app/output/cannot_write.h"
#include "app/output/output_file.h"
#include "core/hash.h"

namespace roboss {

namespace {

double seconds(std::uint64_t ns) {
    return 1e-9 * static_cast<double>(ns);
}

/// How long each stage took, summed over threads.
std::string stage_table(const StageTimes& times, double ticks, double robot_ticks) {
    const auto row = [&](const char* name, std::uint64_t ns) {
        const double s = seconds(ns), all_s = seconds(times.sum());
        return fmt::format("{:<19}{:>10.1f}{:>13.3f}{:>20.3f}{:>9.1f}\n", name, s * 1e3,
                           ticks > 0 ? s * 1e6 / ticks : 0.0, robot_ticks > 0 ? s * 1e6 / robot_ticks : 0.0,
                           all_s > 0 ? 100 * s / all_s : 0.0);
    };
    std::string text = "stage                total ms   us per tick   us per robot-tick  share %\n";
    for (std::size_t i = 0; i < kStages; ++i) text += row(stage_name(Stage(i)), times.ns[i]);
    return text + row("all", times.sum());
}

double ratio(double part, double all) {
    return all > 0 ? part / all : 0.0;
}

/// "newton 97.2 %, at_rest 2.8 %" of the parts that were solved.
std::string methods_text(const SolveCounts& counts) {
    const auto all = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
    std::string text;
    for (std::size_t m = 0; m < kSolveMethods; ++m)
        if (counts[m] > 0)
            text += fmt::format("{}{} {:.3g} %", text.empty() ? "" : ", ", kSolveMethodNames[m],
                                100 * static_cast<double>(counts[m]) / all);
    return text.empty() ? "none" : text;
}

nlohmann::ordered_json methods_json(const SolveCounts& counts) {
    nlohmann::ordered_json o = nlohmann::ordered_json::object();
    for (std::size_t m = 0; m < kSolveMethods; ++m)
        if (counts[m] > 0) o[kSolveMethodNames[m]] = counts[m];
    return o;
}

/// What the solver did, for people.
std::string solver_text(const SolverProfile& p, double ticks, double tolerance) {
    const auto islands = static_cast<double>(p.islands), iterations = static_cast<double>(p.iterations);
    return fmt::format(
        "solver            largest contact island {} robots ({} contacts), {} at most solved together\n"
        "iterations        {:.1f} a step; {:.2f} a contact island on average, {} at most\n"
        "balance           of momentum, worst relative residual {:.1e}\n"
        "friction          off by more than {:g} in {:.2f} % of {} solves, by {:.1e} at most\n"
        "velocities by     {}\n"
        "displacements by  {}\n",
        p.largest_island, p.most_contacts, p.largest_part, ratio(iterations, ticks),
        ratio(iterations, islands), p.iterations_most, p.residual, tolerance,
        100 * ratio(static_cast<double>(p.friction_misses), static_cast<double>(p.friction_solves)),
        p.friction_solves, p.friction_error, methods_text(p.velocities), methods_text(p.displacements));
}

nlohmann::ordered_json solver_json(const SolverProfile& p, double ticks) {
    const auto islands = static_cast<double>(p.islands), iterations = static_cast<double>(p.iterations);
    return {{"largest_island_robots", p.largest_island},
            {"most_contacts", p.most_contacts},
            {"largest_part_robots", p.largest_part},
            {"iterations_per_tick_mean", ratio(iterations, ticks)},
            {"iterations_per_island_mean", ratio(iterations, islands)},
            {"iterations_per_island_most", p.iterations_most},
            {"residual_worst", p.residual},
            {"friction_solves", p.friction_solves},
            {"friction_missed_share",
             ratio(static_cast<double>(p.friction_misses), static_cast<double>(p.friction_solves))},
            {"friction_error_worst", p.friction_error},
            {"velocities_by_method", methods_json(p.velocities)},
            {"displacements_by_method", methods_json(p.displacements)}};
}

}  // namespace

std::string to_json(const Summary& s) {
    nlohmann::ordered_json o;
    o["world"] = s.world;
    o["robots"] = s.robots;
    o["ticks"] = s.ticks;
    o["dt_s"] = s.dt_s;
    o["sim_time_s"] = s.sim_time_s;
    o["wall_time_s"] = s.wall_time_s;
    o["paused_time_s"] = s.paused_time_s;
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
    if (!s.journal.empty()) o["journal"] = {{"file", s.journal}, {"bytes", s.journal_bytes}};
    if (s.replayed)
        o["checkpoints"] = {{"compared", s.replayed->equal + (s.replayed->differs ? 1 : 0)},
                            {"equal", s.replayed->equal}};
    o["model_hash"] = to_hex(s.model_hash);
    o["state_hash"] = to_hex(s.state_hash);
    if (s.profile) {
        for (std::size_t i = 0; i < kStages; ++i)
            o["stage_times_s"][stage_name(Stage(i))] = seconds(s.profile->stages.ns[i]);
        o["solver"] = solver_json(s.profile->solver, static_cast<double>(s.ticks));
    }
    return o.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string to_text(const Summary& s) {
    const auto ticks = static_cast<double>(s.ticks), robot_ticks = ticks * static_cast<double>(s.robots);
    std::string text = fmt::format(
        "world             {}\n"
        "robots            {}\n"
        "simulated         {:.3f} s ({} steps of {:g} ms), world time now {:.3f} s\n"
        "wall time         {:.2f} s, {}{:.1f} x real time\n"
        "stepping          {:.2f} s of CPU, {:.2f} us per robot and step\n"
        "windows           {} ({} repeated), {:.1f} islands on average\n"
        "contacts          {:.1f} points per step, {:.1f} with static models other than planes\n"
        "simulators        {} at the end, {} lost, {} robots migrated\n"
        "model hash        {}\n"
        "state hash        {}\n",
        s.world, s.robots, ticks * s.dt_s, s.ticks, s.dt_s * 1e3, s.sim_time_s, s.wall_time_s,
        s.paused_time_s > 0.005 ? fmt::format("paused for {:.2f} s of them, ", s.paused_time_s) : "",
        s.real_time_factor, s.step_cpu_s, robot_ticks > 0 ? s.step_cpu_s * 1e6 / robot_ticks : 0.0, s.windows,
        s.windows_repeated, s.islands_mean, s.contacts_mean, s.building_contacts_mean, s.simulators, s.losses,
        s.migrations, to_hex(s.model_hash), to_hex(s.state_hash));
    if (s.replayed)
        text += s.replayed->differs
                    ? fmt::format("checkpoints       {} equal, the next one differs\n", s.replayed->equal)
                : s.replayed->equal > 0
                    ? fmt::format("checkpoints       {} compared, all equal\n", s.replayed->equal)
                    : "checkpoints       none to compare behind the start\n";
    if (!s.journal.empty())
        text += fmt::format("journal           {}, {:.1f} MB (--journal-keep limits it)\n", s.journal,
                            1e-6 * static_cast<double>(s.journal_bytes));
    if (s.profile)
        text += solver_text(s.profile->solver, ticks, s.friction_tolerance) +
                stage_table(s.profile->stages, ticks, robot_ticks);
    return text;
}

Result<> write_json(const Summary& summary, const std::string& file) {
    const std::string text = to_json(summary);
    OutputFile out = open_output(file);
    const bool written = out && std::fwrite(text.data(), 1, text.size(), out.get()) == text.size();
    if (!out || std::fclose(out.release()) != 0 || !written) return cannot_write(file, "the summary to ");
    return Ok{};
}

}  // namespace roboss
