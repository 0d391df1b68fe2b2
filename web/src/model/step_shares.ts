// What the profile of the steps says, as rows and words.
import { fixed, percent, short } from "../ui/numbers";
import type { StepProfile } from "../wire/profile";

export interface StageRow {
    name: string;
    /** Of the stepping time, 0 to 1. */
    share: number;
    /** Per tick, summed over threads and Simulators. */
    us: number;
}

/** In the order of a tick, without stages that took no time. */
export function stageRows(profile: StepProfile): StageRow[] {
    const stages = profile.stages ?? [];
    const all = stages.reduce((sum, stage) => sum + stage.seconds, 0);
    if (!(all > 0) || !(profile.ticks > 0)) return [];
    return stages
        .filter((stage) => stage.seconds > 0)
        .map(({ name, seconds }) => ({ name, share: seconds / all, us: (1e6 * seconds) / profile.ticks }));
}

function exponent(value: number | null | undefined): string {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    return value === 0 ? "0" : value.toExponential(1);
}

/** Values by the names of the panel's facts. */
export function solverFacts(profile: StepProfile): Record<string, string> {
    const robots = (count: number | undefined) =>
        count === undefined ? "–" : `${short(count)} ${count === 1 ? "robot" : "robots"}`;
    return {
        "Largest island": robots(profile.largest_island_robots),
        "Most contacts": short(profile.most_contacts),
        "Solved together": robots(profile.largest_part_robots),
        Iterations:
            profile.iterations_per_island_mean === undefined
                ? "–"
                : `${fixed(profile.iterations_per_island_mean, 1)} mean, ${short(profile.iterations_per_island_most)} most`,
        Residual: exponent(profile.residual_worst),
        "Friction off by": exponent(profile.friction_error_worst),
        "Friction missed": profile.friction_solves === undefined ? "–" : percent(profile.friction_missed_share),
        "A tick":
            profile.ticks > 0
                ? `${fixed(
                      stageRows(profile).reduce((sum, row) => sum + row.us, 0),
                      0,
                  )} µs`
                : "–",
    };
}

/** What stands in place of the bars; empty: nothing. */
export function emptyWords(profile: StepProfile | null): string {
    if (profile?.why !== undefined) return profile.why;
    return profile === null || !(profile.ticks > 0) ? "Measuring …" : "";
}
