// Which robots are selected. One of them is the primary one (state.selected): the inspector and the cameras follow it.
// The others are in state.others; whoever sets state.selected alone deselects them.
import type { ViewerState } from "./viewer_state";

/** As many are moved, copied or removed at once. */
export const SELECTED_MAX = 300;

export class Selection {
    private own = false;

    constructor(private readonly state: ViewerState) {
        state.selected.follow((robot, before) => {
            if (robot !== null) state.scenery.set(null);
            if (!this.own && robot !== before) state.others.set([]);
        });
    }

    /** The primary one first. */
    get robots(): number[] {
        const { selected, others } = this.state;
        return selected.value === null ? [] : [selected.value, ...others.value];
    }

    has(robot: number): boolean {
        return this.state.selected.value === robot || this.state.others.value.includes(robot);
    }

    /** The first one becomes the primary one, unless the primary one is among them. */
    set(robots: readonly number[]): void {
        const chosen = [...new Set(robots)].slice(0, SELECTED_MAX),
            now = this.state.selected.value,
            primary = now !== null && chosen.includes(now) ? now : (chosen[0] ?? null);
        this.own = true;
        this.state.others.set(chosen.filter((robot) => robot !== primary));
        this.state.selected.set(primary);
        this.own = false;
        if (robots.length > 0) this.state.scenery.set(null);
    }

    only(robot: number | null): void {
        this.set(robot === null ? [] : [robot]);
    }

    /** Adds it, as the primary one, or takes it away. */
    toggle(robot: number): void {
        const rest = this.robots.filter((one) => one !== robot);
        if (this.has(robot)) return this.set(rest);
        this.own = true;
        this.state.others.set(rest.slice(0, SELECTED_MAX - 1));
        this.state.selected.set(robot);
        this.own = false;
    }

    add(robots: readonly number[]): void {
        this.set([...this.robots, ...robots]);
    }

    /** A model of the scenery instead of robots. */
    scenery(model: string | null): void {
        this.only(null);
        this.state.scenery.set(model);
    }
}
