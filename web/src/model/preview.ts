// Earlier moments in the picture. A page asks for one at a time: of those that are wanted meanwhile only the newest
// counts. A moment that takes long comes in steps, each nearer to it. The run goes on; nothing of it changes.
import type { PreviewInfo } from "../wire/timeline";
import { readHeader, readState } from "../wire/state";
import type { Answer } from "../wire/messages";
import { Signal } from "./signal";
import { Snapshot } from "./snapshot";
import type { Moment } from "./timeline";
import type { ViewerState, World } from "./viewer_state";

/** What is seen instead of the present. */
export interface Shown extends PreviewInfo {
    /** The robots' poses of that moment. */
    snapshot: Snapshot;
    world: World;
    /** By robot: 1 where it did not exist. */
    hidden: Uint8Array;
}

interface Asking {
    preview(moment: string): Promise<Answer>;
}

export class Preview {
    /** The moment that the person chose or points at; null: the present. */
    readonly wanted = new Signal<Moment | null>(null);
    /** It stays when the pointer leaves. */
    readonly pinned = new Signal(false);
    private underWay = false;
    private info: PreviewInfo | null = null;

    constructor(
        private readonly state: ViewerState,
        private readonly asking: Asking,
        private readonly refused: (text: string) => void,
    ) {
        state.world.follow(() => this.again());
        state.link.follow(({ state: link }) => link !== "open" && this.leave());
    }

    /** Shows the moment; `pin`: until leave(), else until unpoint(). */
    show(moment: Moment, pin: boolean): void {
        this.pinned.set(pin);
        this.wanted.set(moment);
        this.ask();
    }

    /** The pointer has left: what was pinned before is not shown again, for it was replaced. */
    unpoint(): void {
        if (!this.pinned.value) this.leave();
    }

    /** Back to the present. */
    leave(): void {
        this.wanted.set(null);
        this.pinned.set(false);
        if (this.state.shown.value !== null) this.state.shown.set(null);
    }

    /** The scene is another one: the same moment, in the robots of that one. */
    private again(): void {
        this.state.shown.set(null);
        if (this.wanted.value !== null) this.ask();
    }

    private ask(): void {
        const moment = this.wanted.value;
        if (moment === null || this.underWay) return;
        this.underWay = true;
        const place = moment.time.toFixed(9);
        void this.asking.preview(moment.branch > 0 ? `#${moment.branch}@${place}` : place).then((answer) => {
            this.underWay = false;
            const same = this.wanted.value === moment;
            if (answer.done && (same ? answer.preview?.exact === true : this.wanted.value === null)) return;
            if (answer.done || !same || answer.code === "superseded") return this.ask();
            if (answer.code === "scene-changed") return void setTimeout(() => this.ask(), 300);
            this.refused(answer.text);
            this.leave();
        });
    }

    /** The answer to a request; its State follows. */
    heard(info: PreviewInfo): void {
        this.info = info;
    }

    take(data: DataView, world: World): void {
        const info = this.info;
        if (info === null || this.wanted.value === null || readHeader(data).tick !== info.tick) return;
        const snapshot = new Snapshot(world.fleet);
        readState(data, world.fleet, snapshot);
        this.state.shown.set({ ...info, snapshot, world, hidden: snapshot.moved.map((there) => 1 - there) });
    }
}
