// The WebSocket to the gateway: parses what comes, numbers what is asked, and connects again by itself when the run is
// gone. It knows nothing of the page.
import { MESSAGES_A_SECOND_MAX, SUBPROTOCOL } from "../protocol";
import { type Probe, probe } from "./probe";
import type { Answer, Incoming, OrderAction, Watch } from "./messages";

export type LinkState = "connecting" | "open" | "gone";

export interface Listener {
    /** `probe`: what a request found, once it is known that the connection does not open. */
    state(state: LinkState, probe: Probe | null): void;
    binary(data: ArrayBuffer): void;
    message(message: Incoming): void;
}

const RETRY_MIN_MS = 500;
const RETRY_MAX_MS = 5000;
/** A refused page does not become welcome by asking again soon. */
const REFUSED_RETRY_MS = 30_000;
/** Below what the gateway calls a flood. */
const MESSAGES_A_SECOND = 0.75 * MESSAGES_A_SECOND_MAX;

/** The page's own token goes with every request. */
export function withToken(path: string): string {
    const token = new URLSearchParams(location.search).get("token");
    return token === null ? path : `${path}?token=${encodeURIComponent(token)}`;
}

export class Connection {
    private socket: WebSocket | null = null;
    private nextId = 1;
    private retryMs = RETRY_MIN_MS;
    private retryTimer = 0;
    private readonly waiting = new Map<number, (answer: Answer) => void>();
    private readonly sent: number[] = [];
    private probed: Probe | null = null;
    /** This page's number, as the gateway counts; 0: none yet. */
    private page = 0;

    constructor(private readonly listener: Listener) {}

    open(): void {
        clearTimeout(this.retryTimer);
        this.listener.state("connecting", this.probed);
        const url = new URL(withToken("ws"), document.baseURI);
        if (this.page > 0) url.searchParams.set("was", String(this.page));
        url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
        const socket = new WebSocket(url, SUBPROTOCOL);
        socket.binaryType = "arraybuffer";
        let opened = false;
        socket.onopen = () => {
            opened = true;
            this.retryMs = RETRY_MIN_MS;
            this.probed = null;
            this.listener.state("open", null);
        };
        socket.onmessage = (event: MessageEvent<ArrayBuffer | string>) => this.receive(event.data);
        socket.onclose = () => void this.lost(opened);
        this.socket = socket;
    }

    /** Tries at once instead of waiting for the next attempt. */
    retryNow(): void {
        if (this.socket !== null && this.socket.readyState <= WebSocket.OPEN) return;
        this.retryMs = RETRY_MIN_MS;
        this.open();
    }

    control(...words: string[]): Promise<Answer> {
        return this.ask({ type: "control", words });
    }

    /** Asks for an earlier moment, TIME or #BRANCH@TIME. */
    preview(moment: string): Promise<Answer> {
        return this.control("preview", moment);
    }

    order(robot: number, action: OrderAction): Promise<Answer> {
        return this.ask({ type: "order", robot, ...action });
    }

    /** Asks for control; the answer comes when that is decided. */
    askForControl(): Promise<Answer> {
        return this.ask({ type: "ask" });
    }

    /** Hands control to a page that asks for it, or to whoever asks next. */
    yieldControl(page?: number): Promise<Answer> {
        return this.ask({ type: "yield", ...(page === undefined ? {} : { page }) });
    }

    keepControl(page: number): Promise<Answer> {
        return this.ask({ type: "keep", page });
    }

    watch(watch: Watch): void {
        this.send({ type: "watch", ...watch });
    }

    askWhole(): void {
        this.send({ type: "whole" });
    }

    private ask(message: object): Promise<Answer> {
        const id = this.nextId++;
        return new Promise((resolve) => {
            this.waiting.set(id, resolve);
            const refusal = this.send({ id, ...message });
            if (refusal !== "") this.settle({ type: "answer", id, done: false, text: refusal });
        });
    }

    /** Empty if it went out; else why not. The gateway closes a connection that floods it, so this side keeps count. */
    private send(message: object): string {
        if (this.socket === null || this.socket.readyState !== WebSocket.OPEN) return "not connected to the run";
        const now = performance.now();
        while (this.sent.length > 0 && now - this.sent[0] > 1000) this.sent.shift();
        if (this.sent.length >= MESSAGES_A_SECOND) return "too many requests in one second";
        this.sent.push(now);
        this.socket.send(JSON.stringify(message));
        return "";
    }

    private receive(data: ArrayBuffer | string): void {
        if (typeof data !== "string") return this.listener.binary(data);
        const message = JSON.parse(data) as Incoming;
        if (message.type === "answer") this.settle(message);
        if (message.type === "roles") this.page = message.page;
        this.listener.message(message);
    }

    private settle(answer: Answer): void {
        this.waiting.get(answer.id)?.(answer);
        this.waiting.delete(answer.id);
    }

    private async lost(opened: boolean): Promise<void> {
        for (const [id, resolve] of [...this.waiting])
            resolve({ type: "answer", id, done: false, text: "the connection was lost" });
        this.waiting.clear();
        this.listener.state("gone", this.probed);
        const socket = this.socket;
        if (!opened) this.probed = await probe(withToken("ws"));
        if (socket !== this.socket) return; // somebody tried again meanwhile
        this.listener.state("gone", this.probed);
        const wait = this.probed?.kind === "refused" ? REFUSED_RETRY_MS : this.retryMs;
        this.retryTimer = window.setTimeout(() => this.open(), wait);
        this.retryMs = Math.min(RETRY_MAX_MS, this.retryMs * 1.6);
    }
}
