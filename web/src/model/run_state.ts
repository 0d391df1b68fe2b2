// What is true of the run as far as the page knows, in words, each with its remedy. One pure function, so that a test goes
// through all of it.
import type { LinkState } from "../wire/connection";
import type { Over } from "./viewer_state";
import type { Probe } from "../wire/probe";

export interface RunFacts {
    link: LinkState;
    /** What a request found after the connection could not be opened; null: not asked. */
    probe: Probe | null;
    /** Connected at least once. */
    seen: boolean;
    /** Why the run is over, as it said itself; null: it said nothing. */
    over: Over | null;
    /** There is a world to show. */
    world: boolean;
    /** Versions of the protocol, of the page and of the run. */
    versions: { page: number; run: number } | null;
    /** Simulators at work; null: not known. */
    simulators: number | null;
    /** s: since the last status, or since the connection opened. */
    quiet_s: number;
    host: string;
}

export interface RunWords {
    /** Stays the same over versions; for styles and tests. */
    kind:
        | "connecting"
        | "version"
        | "refused"
        | "full"
        | "ended"
        | "failed"
        | "gone"
        | "nobody"
        | "no-world"
        | "quiet"
        | "no-simulators";
    text: string;
    remedy: string;
    /** The page tries again by itself. */
    retries: boolean;
    button: "Try now" | "Reload" | null;
}

/** s without a word after which it is said. */
export const QUIET_S = 5;
const NO_WORLD_S = 2;

/** A failure comes with its remedy on a line of its own. */
function overWords({ reason, failed }: Over): Pick<RunWords, "kind" | "text" | "remedy"> {
    const [first, ...more] = reason.split("\n").map((line) => line.trim().replace(/\.$/, "")),
        told = more.filter((line) => line !== "").map((line) => line.charAt(0).toUpperCase() + line.slice(1));
    return {
        kind: failed ? "failed" : "ended",
        text: `${failed ? "The run has failed" : "The run has ended"}: ${first}.`,
        remedy: [...told, "The picture shows its last moment"].map((words) => `${words}.`).join(" "),
    };
}

function whileOpen(facts: RunFacts): RunWords | null {
    if (facts.over !== null) {
        const words = overWords(facts.over);
        return { ...words, remedy: `${words.remedy} This page waits for the next run.`, retries: false, button: null };
    }
    if (!facts.world && facts.quiet_s >= NO_WORLD_S)
        return {
            kind: "no-world",
            text: "Connected, but the run has no world to show yet.",
            remedy: "Its Controller waits for Simulators or Clients: start them (roboss simulator, roboss client).",
            retries: true,
            button: null,
        };
    if (facts.simulators === 0)
        return {
            kind: "no-simulators",
            text: "The run waits: it has no Simulator.",
            remedy: "Add one in the Cluster panel, or start one: roboss simulator.",
            retries: true,
            button: null,
        };
    if (facts.world && facts.quiet_s >= QUIET_S)
        return {
            kind: "quiet",
            text: `No news from the Controller for ${Math.floor(facts.quiet_s)} s.`,
            remedy: "It computes a very long step, or it was killed or cut off. The picture shows the last moment known.",
            retries: true,
            button: null,
        };
    return null;
}

function refusal(probe: Probe | null): RunWords | null {
    if (probe?.kind === "refused")
        return {
            kind: "refused",
            text: `The run refuses this page: ${probe.text}.`,
            remedy: "Open the address that the run printed at its start, or use the token that you were given.",
            retries: false,
            button: "Try now",
        };
    if (probe?.kind === "full")
        return {
            kind: "full",
            text: "The run has as many pages open as it allows.",
            remedy: "Close another page of this run. This one tries again every few seconds.",
            retries: true,
            button: "Try now",
        };
    return null;
}

/** What to say; null: all is well. */
export function wordsOf(facts: RunFacts): RunWords | null {
    const { versions } = facts;
    if (versions !== null && versions.page !== versions.run)
        return {
            kind: "version",
            text: `The page speaks version ${versions.page} of the protocol, the run version ${versions.run}.`,
            remedy: "Reload the page; if that does not help, build program and page from the same sources.",
            retries: false,
            button: "Reload",
        };
    if (facts.link === "open") return whileOpen(facts);
    const refused = refusal(facts.probe);
    if (refused !== null) return refused;
    if (facts.over !== null) {
        const words = overWords(facts.over);
        return {
            ...words,
            remedy: `${words.remedy} Start it again, and this page connects by itself.`,
            retries: true,
            button: "Try now",
        };
    }
    if (facts.seen)
        return {
            kind: "gone",
            text: "The run is gone without a farewell: it was killed, or the network is interrupted.",
            remedy: "The picture shows its last moment. Start it again; with the same --journal it resumes.",
            retries: true,
            button: "Try now",
        };
    // An ordinary start connects at once: nothing to say about it.
    if (facts.probe === null) return null;
    return {
        kind: facts.probe.kind === "unreachable" ? "nobody" : "connecting",
        text: facts.probe.kind === "unreachable" ? `No run answers at ${facts.host}.` : "Connecting to the run…",
        remedy: "Start one (roboss run WORLD); this page connects by itself.",
        retries: true,
        button: "Try now",
    };
}

/** Why the gateway disconnected this page a moment ago, with the remedy. */
export function droppedWords(dropped: { why: string; code: string }): string {
    const slow = dropped.code === "slow" || dropped.code === "timeout";
    return slow
        ? `This page was disconnected because it was too slow (${dropped.why}). ` +
              "Close other tabs, switch overlays off, or open it with ?quality=low."
        : `The run disconnected this page: ${dropped.why}.`;
}
