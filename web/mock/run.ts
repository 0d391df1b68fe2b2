// The mock's run: time that is paused, stepped, hurried and rewound, members that are killed and come back, and the
// answers to control words and orders. The server only carries what is said here.
import type { MemberStatus, OrderAction, SceneInfo } from "../src/wire/messages";
import type { BookmarkInfo, Timeline } from "../src/wire/timeline";
import { makeCity } from "./city";
import { MockNumbers } from "./numbers";
import { advance, makeTraffic, obey, type Traffic } from "./traffic";

const KEPT_EVERY_S = 0.5;
const STEP_S = 0.02;

export class MockRun {
    readonly scene: SceneInfo;
    traffic: Traffic;
    paused = false;
    speed: number | "max" = 1;
    members: MemberStatus[] = [];
    losses = 0;
    migrations = 0;
    rtf = 0;
    private nextMember = 1;
    private kept: Traffic[] = [];
    private stepLeft = 0;
    branch = 1;
    serial = 1;
    private bookmarks: BookmarkInfo[] = [];
    readonly numbers: MockNumbers;

    constructor(
        cars: number,
        seed: number,
        simulators: number,
        readonly journal: boolean,
    ) {
        const { scene, half } = makeCity(cars, seed);
        this.scene = scene;
        this.numbers = new MockNumbers(scene);
        this.traffic = makeTraffic(scene, half, seed);
        for (let k = 0; k < simulators; ++k) this.join();
        this.keep();
    }

    private join(): void {
        const id = this.nextMember++;
        this.members.push({
            id,
            name: `simulator-${id}`,
            threads: 1,
            robots: 0,
            islands: 0,
            load: 0.7,
            step_us: 400,
            state: "active",
        });
    }

    private keep(): void {
        this.kept.push(structuredClone(this.traffic));
        if (this.kept.length > 2400) this.kept.shift();
    }

    /** Lets `seconds` of wall time pass. */
    advance(seconds: number): void {
        const factor = this.speed === "max" ? 12 : this.speed;
        let left = this.paused ? 0 : Math.min(0.5, seconds) * factor;
        if (this.stepLeft > 0) left = this.stepLeft;
        this.stepLeft = 0;
        this.rtf = left / seconds;
        while (left > 1e-9) {
            const dt = Math.min(left, STEP_S);
            advance(this.traffic, dt);
            left -= dt;
            if (this.traffic.time >= this.kept[this.kept.length - 1].time + KEPT_EVERY_S) this.keep();
        }
        this.wander();
    }

    alive(): MemberStatus[] {
        return this.members.filter((member) => member.state !== "lost");
    }

    private wander(): void {
        const t = performance.now() / 1000,
            alive = this.alive(),
            count = Math.max(1, alive.length);
        alive.forEach((member, k) => {
            member.robots =
                Math.floor(this.scene.robots.length / count) + (k < this.scene.robots.length % count ? 1 : 0);
            member.islands = Math.max(1, Math.round(member.robots * 0.85));
            member.load = this.paused
                ? 0
                : Math.min(1, 0.72 + 0.12 * Math.sin(t / 3 + k * 1.7) + 0.06 * Math.sin(t * 1.3 + k));
            const windows = this.paused ? 0 : 30 + 5 * Math.sin(t + k);
            member.messages = { in: windows, out: windows, bytes_in: windows * 60 * member.robots, bytes_out: 9000 };
            member.step_us = this.paused ? 0 : member.robots * 14 * (1 + 0.15 * Math.sin(t / 2 + k));
        });
    }

    control(words: string[]): { done: boolean; text: string } {
        const said = (text: string) => ({ done: true, text }),
            refused = (text: string) => ({ done: false, text });
        const [verb, first, second] = words,
            now = this.traffic.time.toFixed(6);
        switch (verb) {
            case "pause":
                this.paused = true;
                return said(`paused at ${now} s`);
            case "resume":
                this.paused = false;
                return said(`goes on at ${now} s`);
            case "step":
                this.paused = true;
                this.stepLeft = Number(first ?? 1) * this.scene.dt;
                return said(`steps ${first ?? 1}`);
            case "speed":
                if (first !== "max" && !(Number(first) > 0))
                    return refused(`'speed ${first}' is not understood: see \`roboss control --help\``);
                this.speed = first === "max" ? "max" : Number(first);
                return said(`speed ${first} from ${now} s`);
            case "rewind":
                return this.rewind(Number(first.replace(/^.*@/, "")));
            case "bookmark":
                return this.bookmark(first, second);
            case "reset":
                this.traffic = structuredClone(this.kept[0]);
                this.kept = this.journal ? this.kept : [structuredClone(this.traffic)];
                return said(`reset from ${now} s to the world's beginning`);
            case "simulators":
                return this.simulators(first, Number(second ?? 1));
            case "status":
                return said(JSON.stringify(this.status()));
            default:
                return refused(`'${words.join(" ")}' is not understood: see \`roboss control --help\``);
        }
    }

    /** The traffic as it was; null: nothing of that time is kept. */
    at(time: number): Traffic | null {
        const before = this.kept.filter((one) => one.time <= time + 1e-9);
        if (!this.journal || before.length === 0) return null;
        const then = structuredClone(before[before.length - 1]);
        while (then.time < time - 1e-9) advance(then, Math.min(STEP_S, time - then.time));
        return then;
    }

    /** Branches are not remembered: the present one has all that is kept. */
    timeline(): Timeline {
        const { id, name } = { id: this.branch, name: "mock" },
            first = this.kept[0].time;
        const branches = [{ id, parent: 0, begin_s: first, first_s: first, end_s: this.traffic.time, reason: name }];
        return { type: "timeline", serial: this.serial, branch: id, branches, bookmarks: this.bookmarks };
    }

    private bookmark(name: string, at: string): { done: boolean; text: string } {
        ++this.serial;
        if (name === "remove") this.bookmarks = this.bookmarks.filter((mark) => mark.id !== Number(at));
        else {
            const time_s = Number(at?.replace(/^.*@/, "") ?? this.traffic.time);
            this.bookmarks = [...this.bookmarks, { id: this.serial, branch: this.branch, time_s, name }];
        }
        return { done: true, text: `bookmark ${name}` };
    }

    private rewind(time: number): { done: boolean; text: string } {
        if (!this.journal) return { done: false, text: "no journal is kept: start the run with --journal" };
        const before = this.kept.filter((one) => one.time <= time + 1e-9),
            then = this.at(time);
        if (then === null) return { done: false, text: `the journal begins at ${this.kept[0].time.toFixed(3)} s` };
        this.kept = before;
        this.traffic = then;
        ++this.branch;
        ++this.serial;
        return { done: true, text: `rewound to ${time.toFixed(6)} s, branch ${this.branch}` };
    }

    private simulators(what: string, which: number): { done: boolean; text: string } {
        if (what === "add") {
            for (let k = 0; k < which; ++k) this.join();
            return { done: true, text: `${which} more` };
        }
        const at = this.members.findIndex((member) => member.id === which && member.state !== "lost");
        if (what !== "kill" || at < 0) return { done: false, text: `there is no Simulator ${which}` };
        if (this.alive().length === 1) return { done: false, text: "the last Simulator of a run is not killed" };
        this.members[at].state = "lost";
        ++this.losses;
        this.migrations += this.members[at].robots;
        Object.assign(this.members[at], { robots: 0, islands: 0, load: 0, step_us: 0 });
        return { done: true, text: `Simulator ${which} killed` };
    }

    order(robot: number, action: OrderAction): { done: boolean; text: string } {
        if (this.scene.robots[robot] === undefined) return { done: false, text: `there is no robot ${robot}` };
        const refusal =
            this.numbers.obey(robot, action) ??
            obey(this.traffic, robot, action, Math.round(this.traffic.time / this.scene.dt));
        return {
            done: refusal === "",
            text: refusal === "" ? `applied at ${this.traffic.time.toFixed(3)} s` : refusal,
        };
    }

    status(): object {
        const time = this.traffic.time;
        return {
            type: "status",
            world: this.scene.world,
            time_s: time,
            tick: Math.round(time / this.scene.dt),
            paused: this.paused,
            speed: String(this.speed),
            simulators: this.alive().length,
            windows: Math.round(time / 0.06),
            islands: Math.round(this.scene.robots.length * 0.85),
            window_ticks: 30,
            windows_repeated: Math.floor(time / 7),
            efficiency: 0.9 + 0.04 * Math.sin(time / 5),
            model_hash: "8f0c2a6d51e37b94",
            state_hash: "1b7e4490cd25aa03",
            branch: this.branch,
            timeline: this.serial,
            journal: this.journal ? { first_s: this.kept[0].time, last_s: time } : null,
            members: this.members,
            messages: this.members.reduce(
                (sum, { messages }) => ({
                    in: sum.in + (messages?.in ?? 0),
                    out: sum.out + (messages?.out ?? 0),
                    bytes_in: sum.bytes_in + (messages?.bytes_in ?? 0),
                    bytes_out: sum.bytes_out + (messages?.bytes_out ?? 0),
                }),
                { in: 0, out: 0, bytes_in: 0, bytes_out: 0 },
            ),
            losses: this.losses,
            migrations: this.migrations,
            recoveries: this.losses,
            rtf: this.rtf,
            viewers: 1,
            sent_bytes: 0,
        };
    }
}
