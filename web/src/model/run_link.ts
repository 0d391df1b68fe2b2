// Joins the connection to the viewer's state: States into the history, reports into signals, and what the person looks
// at into the one `watch` message that the gateway keeps.
import { Connection, type LinkState } from "../wire/connection";
import type { Probe } from "../wire/probe";
import { RATE_MAX, VERSION, WATCHED_CAMERAS_MAX, WATCHED_ROBOTS_MAX } from "../protocol";
import { OVERLAY_PARTS } from "../wire/overlay";
import type { Answer, Incoming, OrderAction, Watch } from "../wire/messages";
import { isPicture, readPicture } from "../wire/picture";
import { loadScene } from "../wire/scene_source";
import { readHeader, readState } from "../wire/state";
import { PlayClock } from "./play_clock";
import { droppedWords } from "./run_state";
import { Preview } from "./preview";
import { Signal } from "./signal";
import { type ViewerState, World } from "./viewer_state";

export class RunLink {
    readonly clock = new PlayClock();
    readonly notice = new Signal<{ text: string; bad: boolean } | null>(null);
    readonly connection: Connection;
    readonly preview: Preview;
    /** The run has a save to return to; null: not known. */
    saved: boolean | null = null;
    private loading = -1;
    private lastWatch = "";

    constructor(private readonly state: ViewerState) {
        this.connection = new Connection({
            state: (link, probe) => this.onLink(link, probe),
            binary: (data) => (isPicture(data) ? this.onPicture(data) : this.onState(data)),
            message: (message) => this.onMessage(message),
        });
        this.preview = new Preview(state, this.connection, (text) => this.notice.set({ text, bad: true }));
        for (const signal of [
            state.selected,
            state.overlays,
            state.colourBy,
            state.pinned,
            state.world,
            state.wantsProfile,
            state.wantsNumbers,
            state.cameras.wishes,
        ])
            (signal as Signal<unknown>).follow(() => this.sendWatch());
    }

    open(): void {
        this.connection.open();
    }

    retryNow(): void {
        this.connection.retryNow();
    }

    /** Control words; a refusal is shown. */
    async control(...words: string[]): Promise<Answer> {
        const answer = await this.connection.control(...words);
        if (words[0] === "save" && answer.done) this.saved = true;
        if (answer.code === "no-save") this.saved = false;
        if (!answer.done) this.notice.set({ text: answer.text, bad: true });
        return answer;
    }

    async order(robot: number, action: OrderAction): Promise<Answer> {
        const answer = await this.connection.order(robot, action);
        if (!answer.done) this.notice.set({ text: answer.text, bad: true });
        return answer;
    }

    private onLink(link: LinkState, probe: Probe | null): void {
        this.state.link.set({ state: link, probe });
        if (link !== "gone") return;
        this.state.status.set(null);
        this.state.profile.set(null);
        this.state.roles.set(null);
        this.state.timeline.set(null);
    }

    private onMessage(message: Incoming): void {
        switch (message.type) {
            case "hello":
                this.state.program.set(message.program);
                this.state.version.set(message.version);
                this.state.over.set(null);
                if (message.dropped !== undefined) this.notice.set({ text: droppedWords(message.dropped), bad: true });
                if (message.version !== VERSION) break;
                void this.load(message.scene);
                break;
            case "scene":
                void this.load(message.scene);
                break;
            case "over":
                this.state.over.set({ reason: message.reason, failed: message.failed === true });
                break;
            case "status":
                this.state.over.set(null);
                this.state.status.set(message);
                break;
            case "groups":
                if (message.scene === this.sceneNumber()) this.state.groups.set(message);
                break;
            case "robot":
                if (message.scene === this.sceneNumber()) this.state.report.set(message);
                break;
            case "numbers":
                if (message.scene === this.sceneNumber()) this.state.numbers.set(message);
                break;
            case "overlay":
                if (message.scene !== this.sceneNumber()) break;
                for (const part of OVERLAY_PARTS) if (message[part] !== undefined) this.state.overlayParts.add(part);
                this.state.overlayReport.set(message);
                break;
            case "profile":
                this.state.profile.set(message);
                break;
            case "extras":
                if (message.scene === this.sceneNumber()) this.state.extras.set(message);
                break;
            case "roles":
                this.state.roles.set(message);
                break;
            case "timeline":
                this.state.timeline.set(message);
                break;
            case "no_pictures":
                if (message.scene === this.sceneNumber()) this.state.cameras.trouble.set(message.text);
                break;
            case "notice":
                this.notice.set({ text: message.text, bad: false });
                break;
            case "answer":
                if (message.preview !== undefined) this.preview.heard(message.preview);
                break;
        }
    }

    private sceneNumber(): number {
        return this.state.world.value?.fleet.scene.scene ?? -1;
    }

    /** Fetches the scene; a newer one may come meanwhile. The robot selected stays so, by its name. */
    private async load(wanted: number): Promise<void> {
        this.loading = wanted;
        try {
            const loaded = await loadScene();
            if (this.loading !== wanted) return;
            const before = this.state.world.value?.fleet,
                selected = this.state.selected.value,
                others = this.state.others.value.map((robot) => before?.name(robot) ?? "");
            const world = new World(loaded);
            if (loaded.unreadable > 0)
                this.notice.set({ text: `${loaded.unreadable} pictures cannot be shown: plain colours`, bad: true });
            this.state.groups.set(null);
            this.state.extras.set(null);
            this.state.attaching.set(null);
            this.state.selected.set(null);
            this.state.sight.begin(loaded.scene.world);
            this.state.cameras.clear();
            this.state.world.set(world);
            if (before !== undefined && selected !== null) {
                this.state.selected.set(world.fleet.find(before.name(selected)) ?? null);
                this.state.others.set(
                    others.map((name) => world.fleet.find(name)).filter((robot) => robot !== undefined),
                );
            }
            this.connection.askWhole();
            this.lastWatch = "";
            this.sendWatch();
        } catch (error) {
            this.notice.set({ text: `the scene could not be loaded: ${String(error)}`, bad: true });
        }
    }

    private onState(data: ArrayBuffer): void {
        const world = this.state.world.value;
        if (world === null) return;
        const view = new DataView(data);
        try {
            const header = readHeader(view);
            if (header.scene !== this.sceneNumber()) return;
            if (header.preview) return this.preview.take(view, world);
            if (!header.whole && world.history.latest === null) return;
            readState(view, world.fleet, world.history.next());
            world.history.take();
            this.clock.heard(header.time, performance.now() / 1000);
        } catch (error) {
            this.notice.set({ text: String(error), bad: true });
            this.connection.askWhole();
        }
    }

    private onPicture(data: ArrayBuffer): void {
        try {
            const picture = readPicture(data);
            if (picture.scene === this.sceneNumber()) void this.state.cameras.take(picture).catch(() => undefined);
        } catch (error) {
            this.notice.set({ text: String(error), bad: true });
        }
    }

    /** Of RGB-D cameras the gateway wants to know which picture; the others have one. */
    private cameras(): Watch["cameras"] {
        const fleet = this.state.world.value?.fleet;
        return this.state.cameras.wishes.value
            .slice(0, WATCHED_CAMERAS_MAX)
            .map(({ robot, sensor, shows, columns }) => ({
                robot,
                sensor,
                columns,
                depth: shows === "depth" && fleet?.type(robot).sensors[sensor]?.kind === "rgbd camera",
            }));
    }

    private sendWatch(): void {
        if (this.state.world.value === null || this.state.link.value.state !== "open") return;
        const overlays: string[] = [],
            on = this.state.overlays.value,
            colour = this.state.colourBy.value;
        for (const name of ["contacts", "radio", "bounds"] as const) if (on.has(name)) overlays.push(name);
        if (on.has("islands") || colour === "island" || colour === "simulator") overlays.push("groups");
        if (this.state.wantsProfile.value) overlays.push("profile");
        const robots = new Set<number>(this.state.pinned.value);
        if (this.state.selected.value !== null) robots.add(this.state.selected.value);
        const watch: Watch = { robots: [...robots].slice(0, WATCHED_ROBOTS_MAX), overlays, rate: RATE_MAX },
            cameras = this.cameras();
        if (cameras !== undefined && cameras.length > 0) watch.cameras = cameras;
        if (this.state.wantsNumbers.value !== null) watch.numbers = this.state.wantsNumbers.value;
        const text = JSON.stringify(watch);
        if (text === this.lastWatch) return;
        this.lastWatch = text;
        this.connection.watch(watch);
    }
}
