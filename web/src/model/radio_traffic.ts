// Who heard whom by radio lately: the links of the last reports, by age. They age with the clock of the wall while the
// simulated time that is drawn moves, so a paused picture keeps its links.
import type { RadioLinkReport, RadioReport, RadioSenderReport } from "../wire/radio";

/** s, after which a link is no longer drawn. */
export const LINK_SHOWN_S = 1.2;
/** s, in which a message is seen to go from one end to the other, and a sender's ring to grow. */
export const PULSE_S = 0.35;
/** dB above the noise floor, from which on a link counts as good. */
export const GOOD_MARGIN_DB = 30;
const LINKS_MAX = 2000;
/** s; a longer step is a page that slept. */
const STEP_MAX_S = 0.25;

interface Aged<T> {
    what: T;
    /** s */
    age: number;
}

export class RadioTraffic {
    private readonly shown = new Map<string, Aged<RadioLinkReport>>();
    private readonly sent = new Map<string, Aged<RadioSenderReport>>();
    private drawnTime = Number.NaN;
    private wall = Number.NaN;

    get links(): IterableIterator<Aged<RadioLinkReport>> {
        return this.shown.values();
    }
    get senders(): IterableIterator<Aged<RadioSenderReport>> {
        return this.sent.values();
    }
    get quiet(): boolean {
        return this.shown.size === 0 && this.sent.size === 0;
    }

    forget(): void {
        this.shown.clear();
        this.sent.clear();
    }

    take({ links, senders }: RadioReport): void {
        for (const link of links) put(this.shown, `${link.from} ${link.antenna} ${link.to} ${link.sensor}`, link);
        for (const sender of senders) put(this.sent, `${sender.robot} ${sender.sensor}`, sender);
    }

    /** `now`: s of the wall's clock. */
    advance(now: number, drawnTime: number): void {
        const moved = drawnTime !== this.drawnTime,
            step = Math.min(STEP_MAX_S, Math.max(0, now - this.wall));
        this.wall = now;
        this.drawnTime = drawnTime;
        if (!moved || Number.isNaN(step)) return;
        for (const [map, most] of [
            [this.shown, LINK_SHOWN_S],
            [this.sent, PULSE_S],
        ] as [Map<string, Aged<unknown>>, number][])
            for (const [key, one] of map) if ((one.age += step) > most) map.delete(key);
    }
}

/** The newest last; of too many the oldest go. */
function put<T>(map: Map<string, Aged<T>>, key: string, what: T): void {
    map.delete(key);
    map.set(key, { what, age: 0 });
    if (map.size > LINKS_MAX) map.delete(map.keys().next().value as string);
}

/** 0: at the noise floor, or below; 1: good. */
export function quality(margin: number | null): number {
    return Math.min(1, Math.max(0, (margin ?? 0) / GOOD_MARGIN_DB));
}
