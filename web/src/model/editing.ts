// Changes of the world by hand: move, remove, copy, add; each can be taken back. Robots are known by their names here,
// because their numbers change with every robot that comes or goes.
import { ADDITION_BYTES_MAX } from "../protocol";
import { toRollPitchYaw } from "../kinematics/pose";
import type { Answer, OrderAction, PoseArray, Triple } from "../wire/messages";
import { freeName, modelNames } from "./names";
import { halfHeight, type NewShape, shapeSdf } from "./new_shape";
import type { Placement, Placing } from "./placing";
import type { RunLink } from "./run_link";
import type { Selection } from "./selection";
import { robotKey } from "./sight";
import { type Step, UndoStack } from "./undo";
import type { ViewerState, World } from "./viewer_state";

const ARRIVAL_MS = 15_000;

interface Copied {
    name: string;
    pose: PoseArray;
    reach: number;
}

/** "x y z roll pitch yaw", m and rad. */
export function poseText(pose: PoseArray): string {
    return [...pose.slice(0, 3), ...toRollPitchYaw(pose)].join(" ");
}

function few(names: readonly string[]): string {
    return names.length === 1 ? names[0] : `${names.length} robots`;
}

export class Editing {
    readonly undo = new UndoStack();
    private clipboard: Copied[] = [];

    constructor(
        private readonly state: ViewerState,
        private readonly run: RunLink,
        private readonly selection: Selection,
        private readonly placing: Placing,
    ) {
        // A reset or a rewind: what was done since then is not.
        state.status.follow((now, before) => {
            if (now !== null && before !== null && now.tick < before.tick) this.undo.clear();
        });
    }

    private get world(): World | null {
        return this.state.world.value;
    }

    private name(robot: number): string {
        return this.world?.fleet.name(robot) ?? "";
    }

    private say(text: string, bad = false): void {
        this.run.notice.set({ text, bad });
    }

    /** Puts robots where `after` says, and remembers where they were. */
    move(before: readonly Placement[], after: readonly Placement[]): void {
        const named = (list: readonly Placement[]) => list.map(({ robot, pose }) => ({ name: this.name(robot), pose })),
            [from, to] = [named(before), named(after)];
        const put = (list: { name: string; pose: PoseArray }[]) => () => {
            const found = list
                .map(({ name, pose }) => ({ robot: this.world?.fleet.find(name) ?? -1, pose }))
                .filter(({ robot }) => robot >= 0);
            this.placing.place(found);
            return Promise.resolve(found.length > 0);
        };
        this.placing.place(after);
        if (this.state.status.value?.paused === true)
            this.say(`The run is paused: ${few(to.map(({ name }) => name))} will be there with the next tick.`);
        this.undo.push({ name: `move ${few(to.map(({ name }) => name))}`, undo: put(from), redo: put(to) });
    }

    /** Gives a robot an order that another one takes back. */
    async order(robot: number, name: string, action: OrderAction, back: OrderAction): Promise<Answer> {
        const called = this.name(robot),
            answer = await this.run.order(robot, action);
        if (!answer.done) return answer;
        if (this.state.status.value?.paused === true)
            this.say(`The run is paused: ${called} obeys with the next tick.`);
        const give = (one: OrderAction) => async () => {
            const now = this.world?.fleet.find(called);
            return now !== undefined && (await this.run.order(now, one)).done;
        };
        this.undo.push({ name: `${name} of ${called}`, undo: give(back), redo: give(action) });
        return answer;
    }

    async remove(): Promise<void> {
        const locked = this.state.sight.locked.value,
            names = this.selection.robots
                .map((robot) => this.name(robot))
                .filter((name) => !locked.has(robotKey(name)));
        if (names.length === 0) {
            if (this.state.scenery.value !== null) this.say("Scenery cannot be removed during a run.", true);
            else if (this.selection.robots.length > 0) this.say("What is selected is locked.", true);
            return;
        }
        const before = this.selected();
        if (!(await this.changed(["remove", ...names])).done) return;
        this.pushed(before, {
            name: `remove ${few(names)}`,
            undo: async () => (await this.changed(["restore", ...names])).done,
            redo: async () => (await this.changed(["remove", ...names])).done,
        });
    }

    copy(): void {
        const world = this.world;
        if (world === null || this.selection.robots.length === 0) return;
        this.clipboard = this.selection.robots.map((robot) => ({
            name: this.name(robot),
            pose: this.placing.frame(robot),
            reach: world.fleet.type(robot).reach,
        }));
        this.say(`${few(this.clipboard.map(({ name }) => name))} copied: Ctrl V puts a copy where the pointer is.`);
    }

    /** Copies of what is selected, beside it. */
    async duplicate(): Promise<void> {
        const kept = this.clipboard;
        this.copy();
        await this.paste(null);
        if (kept.length > 0) this.clipboard = kept;
    }

    /** Copies with the middle of the first one over the point; null: beside the originals. */
    async paste(at: Triple | null): Promise<void> {
        const fleet = this.world?.fleet,
            there = this.clipboard.filter(({ name }) => fleet?.find(name) !== undefined),
            first = there[0];
        if (fleet === undefined || first === undefined) return;
        const poses = there.map(({ pose }) => pose),
            wide = Math.max(...poses.map(([x]) => x)) - Math.min(...poses.map(([x]) => x)),
            step = wide + 2.2 * Math.max(0.05, ...there.map(({ reach }) => Math.min(reach, 5))),
            [dx, dy] = at === null ? [step, 0] : [at[0] - first.pose[0], at[1] - first.pose[1]];
        const used = new Set<string>(),
            words = there.flatMap(({ name, pose }) => {
                const [x, y, ...rest] = pose,
                    copy = freeName(name, (one) => used.has(one) || fleet.find(one) !== undefined);
                used.add(copy);
                return [name, copy, poseText([x + dx, y + dy, ...rest] as PoseArray)];
            });
        await this.add(["copy", ...words], `copy ${few(there.map(({ name }) => name))}`);
    }

    /** The models of a file, with the file's origin at the point. */
    async addFile(file: string, content: string, at: Triple): Promise<void> {
        const words = ["add", file, content, poseText([...at, 1, 0, 0, 0])],
            names = modelNames(content),
            fleet = this.world?.fleet,
            name = names.length === 1 ? freeName(names[0], (one) => fleet?.find(one) !== undefined) : "";
        const bytes = new TextEncoder().encode(JSON.stringify(words)).length + 200;
        if (bytes > ADDITION_BYTES_MAX) {
            const most = ADDITION_BYTES_MAX / 1024 / 1024;
            this.say(`${file} is larger than ${most} MiB: add it with \`roboss control add\`.`, true);
            return;
        }
        await this.add([...words, name], `add ${file}`);
    }

    async addShape(shape: NewShape, at: readonly number[]): Promise<void> {
        const fleet = this.world?.fleet,
            name = freeName(shape.kind, (one) => fleet?.find(one) !== undefined),
            pose = poseText([at[0], at[1], at[2] + halfHeight(shape), 1, 0, 0, 0]);
        await this.add(["add", `${name}.sdf`, shapeSdf(shape, name), pose, name], `add ${name}`);
    }

    private async add(words: string[], name: string): Promise<void> {
        const before = this.selected(),
            { done, names } = await this.changed(words);
        if (!done || names.length === 0) return;
        this.select(names);
        this.pushed(before, {
            name,
            undo: async () => (await this.changed(["remove", ...names])).done,
            redo: async () => (await this.changed(["restore", ...names])).done,
        });
    }

    /** Names of the robots that are selected, the primary one first. */
    private selected(): string[] {
        return this.selection.robots.map((robot) => this.name(robot));
    }

    private select(names: readonly string[]): void {
        const robots = names.map((name) => this.world?.fleet.find(name)).filter((robot) => robot !== undefined);
        this.selection.set(robots);
    }

    /**
     * A step that was just done. Undone it gives the selection of before the step back, and done again that of now; but
     * what a person has selected meanwhile stays selected.
     */
    private pushed(before: readonly string[], step: Step): void {
        const after = this.selected(),
            going = (go: () => Promise<boolean>, from: readonly string[], to: readonly string[]) => async () => {
                const own = String(this.selected()) !== String(from),
                    went = await go();
                if (went && !own) this.select(to);
                return went;
            };
        this.undo.push({
            name: step.name,
            undo: going(step.undo, after, before),
            redo: going(step.redo, before, after),
        });
    }

    /** A request that changes which robots there are; the names of those that are new when the page has the new scene. */
    private async changed(words: string[]): Promise<{ done: boolean; names: string[] }> {
        const before = this.world,
            known = new Set(before?.fleet.scene.robots.map(({ name }) => name)),
            answer = await this.run.control(...words);
        if (!answer.done) return { done: false, names: [] };
        const now = await this.nextWorld(before);
        return {
            done: true,
            names: now?.fleet.scene.robots.map(({ name }) => name).filter((name) => !known.has(name)) ?? [],
        };
    }

    private nextWorld(before: World | null): Promise<World | null> {
        return new Promise((resolve) => {
            let end = () => {};
            const timer = setTimeout(() => take(null), ARRIVAL_MS);
            const take = (world: World | null) => {
                clearTimeout(timer);
                resolve(world);
                queueMicrotask(() => end());
            };
            end = this.state.world.follow((world) => world !== before && take(world));
        });
    }
}
