// A gateway without a simulator: serves the page and speaks its protocol over a made-up city. The bench on which the page
// is built and tested: node .tests/mock/server.mjs --port 8090 --cars 50 --web dist
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { parseArgs } from "node:util";
import { type WebSocket, WebSocketServer } from "ws";
import { actingExtras } from "./acting";
import { MockRun } from "./run";
import { NO_TROUBLE, refusalText, troubleOf } from "./trouble";
import { FLAG_PREVIEW } from "../src/protocol";
import type { Watch } from "../src/wire/messages";
import { encodeRobots, encodeState, groupsOf, overlayReport, profileReport, robotReport } from "./reports";

const { values: options } = parseArgs({
    options: {
        port: { type: "string", default: "8090" },
        cars: { type: "string", default: "50" },
        web: { type: "string", default: "dist" },
        simulators: { type: "string", default: "4" },
        "no-journal": { type: "boolean", default: false },
        rate: { type: "string", default: "30" },
    },
});
const CONTENT: Record<string, string> = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
};
const POLICY =
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; media-src 'self' blob:";
const run = new MockRun(Number(options.cars), 1, Number(options.simulators), !options["no-journal"]);

let trouble = NO_TROUBLE;
/** Numbers of the pages that were dropped, with the code. */
const dropped = new Map<number, string>();
let lastPage = 0;

const http = createServer((request, response) => {
    const url = new URL(request.url ?? "/", "http://mock"),
        path = url.pathname,
        asked = troubleOf(url);
    if (asked !== null) {
        trouble = asked;
        if (trouble.over !== "") pages.forEach((page) => page.leave(trouble.over));
        if (trouble.drop !== "") pages.forEach((page) => page.drop(trouble.drop));
        response.writeHead(200).end("done");
        return;
    }
    if (path === "/ws") {
        const status = trouble.refuse === 0 ? 426 : trouble.refuse;
        response.writeHead(status, { "Content-Type": "text/plain" }).end(refusalText(status));
        return;
    }
    if (path === "/scene") {
        response.writeHead(200, { "Content-Type": "application/json" }).end(JSON.stringify(run.scene));
        return;
    }
    const name = normalize(path === "/" ? "/index.html" : path);
    readFile(join(options.web ?? "dist", name)).then(
        (text) =>
            response
                .writeHead(200, {
                    "Content-Type": CONTENT[extname(name)] ?? "application/octet-stream",
                    "Content-Security-Policy": POLICY,
                })
                .end(text),
        () => response.writeHead(404).end("not found"),
    );
});

class Page {
    private sent = new Map<number, Uint8Array>();
    private whole = true;
    private extras = JSON.stringify({ surfaces: [], bonds: [] });
    private watch: Watch = { robots: [], overlays: [], rate: 30 };

    private readonly number = ++lastPage;

    constructor(
        private readonly socket: WebSocket,
        before: number,
    ) {
        const code = dropped.get(before);
        this.tell({
            type: "hello",
            version: trouble.version,
            ...(code === undefined ? {} : { dropped: { why: "it does not read its replies", code } }),
            scene: run.scene.scene,
            world: run.scene.world,
            journal: run.journal,
            rate: 30,
            program: "mock gateway",
        });
        if (run.journal) this.tell(run.timeline());
        const self = { page: this.number, address: "127.0.0.1", user: "", role: "administer" };
        this.tell({ type: "roles", page: this.number, role: "administer", holder: self, asking: [] });
        this.status();
        socket.on(
            "message",
            (data, binary) => !binary && this.hear(JSON.parse(data.toString()) as Record<string, unknown>),
        );
    }

    leave(reason: string): void {
        this.tell({ type: "over", reason, failed: trouble.failed });
        this.socket.close(1001);
    }

    drop(code: string): void {
        dropped.set(this.number, code);
        this.socket.terminate();
    }

    status(): void {
        if (trouble.mute) return;
        const members = run.members.map((member) => ({ ...member, own_process: !trouble.foreign }));
        this.tell({ ...run.status(), members, ...(trouble.empty ? { simulators: 0 } : {}) });
    }

    tell(message: object): void {
        this.socket.send(JSON.stringify(message));
    }

    private hear(message: Record<string, unknown>): void {
        const answer = (found: { done: boolean; text: string }) =>
            this.tell({ type: "answer", id: message.id, ...found });
        if (message.type === "control" && (message.words as string[])[0] === "preview")
            this.preview(message.id as number, (message.words as string[])[1]);
        else if (message.type === "control") answer(run.control(message.words as string[]));
        else if (message.type === "order") answer(run.order(message.robot as number, message as never));
        else if (message.type === "ask" || message.type === "yield" || message.type === "keep")
            answer({ done: true, text: "done" });
        else if (message.type === "watch") this.watch = message as never;
        else if (message.type === "whole") {
            this.whole = true;
            this.extras = "";
        }
    }

    private preview(id: number, at: string): void {
        const then = run.at(Number(at.replace(/^.*@/, "")));
        if (then === null) return this.tell({ type: "answer", id, done: false, text: "no journal is kept" });
        const { scene, branch } = run,
            tick = Math.round(then.time / scene.dt);
        const info = { branch, tick, time_s: then.time, exact: true, gone: 0, absent: 0 };
        this.tell({ type: "answer", id, done: true, text: "", preview: info });
        const bytes = encodeState(scene.scene, then.time, scene.dt, true, encodeRobots(then).values(), false);
        bytes[1] |= FLAG_PREVIEW;
        this.socket.send(bytes);
    }

    /** Only what changed since this page's last State, and nothing while it has not taken that one. */
    state(entries: Map<number, Uint8Array>): void {
        if (this.socket.bufferedAmount > 1 << 20) return;
        const changed = [...entries].filter(
            ([robot, entry]) => this.whole || Buffer.compare(entry, this.sent.get(robot) ?? new Uint8Array()) !== 0,
        );
        this.socket.send(
            encodeState(
                run.scene.scene,
                run.traffic.time,
                run.scene.dt,
                this.whole,
                changed.map(([, entry]) => entry),
                changed.length === 0,
            ),
        );
        this.whole = false;
        this.sent = entries;
    }

    reports(): void {
        const extras = actingExtras(run.traffic.acting),
            text = JSON.stringify(extras);
        if (text !== this.extras) this.tell({ type: "extras", scene: run.scene.scene, tick: 0, ...extras });
        this.extras = text;
        for (const robot of this.watch.robots)
            if (run.scene.robots[robot] !== undefined)
                this.tell({ ...robotReport(run.traffic, run.scene, robot), ...run.numbers.own(robot) });
        if (this.watch.numbers !== undefined) this.tell(run.numbers.report(this.watch.numbers));
        if (this.watch.overlays.includes("groups"))
            this.tell({ type: "groups", scene: run.scene.scene, ...groupsOf(run.traffic, run.scene, run.alive()) });
        if (this.watch.overlays.includes("profile")) this.tell(profileReport(run.traffic));
        if (this.watch.overlays.some((name) => name !== "groups" && name !== "profile"))
            this.tell(overlayReport(run.traffic, run.scene, this.watch.overlays));
    }
}

const pages = new Set<Page>();
new WebSocketServer({
    server: http,
    path: "/ws",
    handleProtocols: () => "roboss.1",
    verifyClient: (_: object, decide: (welcome: boolean, status?: number) => void) =>
        decide(trouble.refuse === 0, trouble.refuse),
}).on("connection", (socket, request) => {
    const before = new URL(request.url ?? "/", "http://mock").searchParams.get("was");
    const page = new Page(socket, Number(before ?? 0));
    pages.add(page);
    socket.on("close", () => pages.delete(page));
});

let last = performance.now();
setInterval(
    () => {
        const now = performance.now();
        run.advance((now - last) / 1000);
        last = now;
        const entries = encodeRobots(run.traffic);
        for (const page of pages) page.state(entries);
    },
    1000 / Number(options.rate),
);
setInterval(() => pages.forEach((page) => page.reports()), 100);
let serial = run.serial;
setInterval(() => {
    if (run.journal && serial !== run.serial) pages.forEach((page) => page.tell(run.timeline()));
    serial = run.serial;
    pages.forEach((page) => page.status());
}, 500);
http.listen(Number(options.port), "127.0.0.1", () => {
    const address = http.address();
    console.log(
        `listening on http://127.0.0.1:${typeof address === "object" && address !== null ? address.port : options.port}/`,
    );
});
