// Puts robots where a hand, a field or an undo says: by pose orders, with orders that stop a free base. While the run is
// paused, orders wait for its next tick; until then the picture shows where they will put the robots.
import { composed, inverse } from "../kinematics/pose";
import type { PoseArray, TypeInfo } from "../wire/messages";
import type { RunLink } from "./run_link";
import { robotKey } from "./sight";
import type { ViewerState } from "./viewer_state";

const TURN_MS = 50;
/** Each robot takes two orders; a page may send 200 messages per second, and others want some. */
const ROBOTS_A_TURN = 3;

export interface Placement {
    robot: number;
    /** Of its robot (SDF model) frame. */
    pose: PoseArray;
}

/** The pose of the base that puts the robot's own frame there, as SetPose does. */
export function basePose(type: TypeInfo, pose: PoseArray): PoseArray {
    return type.free_base ? (composed(pose, inverse(type.origin)) as PoseArray) : pose;
}

/** Where the robot's own frame is when its base is there. */
export function framePose(type: TypeInfo, base: ArrayLike<number>): PoseArray {
    const at = Array.from(base) as PoseArray;
    return type.free_base ? (composed(at, type.origin) as PoseArray) : at;
}

export class Placing {
    private readonly waiting = new Map<number, PoseArray>();
    private timer = 0;
    private shownAt = -1;

    constructor(
        private readonly state: ViewerState,
        private readonly run: RunLink,
    ) {
        state.status.follow((status) => {
            if (this.shownAt < 0 || (status?.paused === true && status.tick === this.shownAt)) return;
            this.shownAt = -1;
            const history = state.world.value?.history;
            for (const robot of history?.shownAhead ?? []) history?.show(robot, null);
        });
        state.world.follow(() => this.waiting.clear());
    }

    /** Where the robot's own frame is drawn. */
    frame(robot: number): PoseArray {
        const world = this.state.world.value;
        if (world === null) return [0, 0, 0, 1, 0, 0, 0];
        return framePose(world.fleet.type(robot), world.history.drawn.base.subarray(robot * 7, robot * 7 + 7));
    }

    /** Why the robot cannot be placed; empty: it can. */
    refusal(robot: number): string {
        const fleet = this.state.world.value?.fleet;
        if (fleet?.type(robot).static === true)
            return `${fleet.name(robot)} is static: scenery cannot be moved during a run.`;
        if (this.state.sight.locked.value.has(robotKey(fleet?.name(robot) ?? "")))
            return `${fleet?.name(robot) ?? ""} is locked: open its lock in the scene tree first.`;
        return "";
    }

    /** Robots that cannot be placed are left out. */
    place(placements: readonly Placement[]): void {
        for (const { robot, pose } of placements) {
            if (this.refusal(robot) !== "") continue;
            this.waiting.set(robot, pose);
            this.show(robot, pose);
        }
        if (this.timer === 0) this.send();
    }

    private show(robot: number, pose: PoseArray): void {
        const world = this.state.world.value,
            status = this.state.status.value;
        if (world === null || status?.paused !== true) return;
        this.shownAt = status.tick;
        world.history.show(robot, basePose(world.fleet.type(robot), pose));
    }

    private send(): void {
        this.timer = 0;
        const world = this.state.world.value;
        if (world === null) return;
        for (const [robot, pose] of [...this.waiting].slice(0, ROBOTS_A_TURN)) {
            this.waiting.delete(robot);
            void this.run.order(robot, { action: "pose", pose });
            if (world.fleet.type(robot).free_base)
                void this.run.order(robot, { action: "velocity", linear: [0, 0, 0], angular: [0, 0, 0] });
        }
        if (this.waiting.size > 0) this.timer = window.setTimeout(() => this.send(), TURN_MS);
    }
}
