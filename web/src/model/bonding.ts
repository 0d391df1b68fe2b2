// Attaching robots by hand: the holder is chosen first, then the robot that it shall hold.
import type { RunLink } from "./run_link";
import type { ViewerState } from "./viewer_state";

/** What is known of a bond before the other robot is chosen. */
export interface Attaching {
    holder: number;
    link: number;
    /** m: how far the two robots may be apart. */
    reach: number;
    /** N: beyond, it lets go; null: never. */
    max_force: number | null;
}

export const REACH_M = 0.1;

export class Bonding {
    constructor(
        private readonly state: ViewerState,
        private readonly run: RunLink,
    ) {}

    /** A robot was chosen while another waits for one to hold. False: none waits. */
    take(robot: number, link = 0): boolean {
        const wanted = this.state.attaching.value;
        if (wanted === null) return false;
        if (robot === wanted.holder) return true;
        this.state.attaching.set(null);
        this.attach(wanted, robot, link);
        return true;
    }

    /** The selected robot takes hold of this one. False: no other robot is selected. */
    takeBySelected(robot: number, link = 0): boolean {
        const holder = this.state.selected.value;
        if (holder === null || holder === robot) return false;
        this.attach({ holder, link: 0, reach: REACH_M, max_force: null }, robot, link);
        return true;
    }

    private attach(wanted: Attaching, other: number, other_link: number): void {
        const { holder, link, reach, max_force } = wanted;
        void this.run
            .order(holder, {
                action: "attach",
                link,
                other,
                other_link,
                reach,
                ...(max_force === null ? {} : { max_force }),
            })
            .then((answer) => answer.done && this.watch(holder, other));
    }

    /** An order to attach does nothing where the robots are out of reach: that is said after a moment. */
    private watch(holder: number, other: number): void {
        const fleet = this.state.world.value?.fleet;
        setTimeout(() => {
            if (fleet === undefined || fleet !== this.state.world.value?.fleet) return;
            if (this.state.status.value?.paused === true) return;
            const bonds = this.state.extras.value?.bonds ?? [];
            if (bonds.some((bond) => bond.robot === holder && bond.other === other)) return;
            const names = `${fleet.name(holder)} does not hold ${fleet.name(other)}`;
            this.run.notice.set({ text: `${names}: it is out of reach, or the bond has let go.`, bad: true });
        }, UNSEEN_MS);
    }
}

const UNSEEN_MS = 1500;
