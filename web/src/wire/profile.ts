// Where the time of the steps goes, as the gateway says it (docs/viewer-protocol.md).

/** Of the last second that was measured; `ticks` 0: nothing yet, or `why` says why not. */
export interface StepProfile {
    type: "profile";
    ticks: number;
    why?: string;
    stages?: { name: string; seconds: number }[];
    largest_island_robots?: number;
    most_contacts?: number;
    largest_part_robots?: number;
    iterations_per_tick_mean?: number;
    iterations_per_island_mean?: number;
    iterations_per_island_most?: number;
    residual_worst?: number | null;
    friction_solves?: number;
    friction_missed_share?: number;
    friction_error_worst?: number | null;
    friction_tolerance?: number;
}
