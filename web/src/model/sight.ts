// What is hidden in the picture and what is locked against the pointer, by keys of the scene tree. Kept in this browser
// for each world, so that a reload shows the same.
import { Signal } from "./signal";

type Keys = ReadonlySet<string>;
/** Where it is kept; localStorage, or something like it in tests. */
export type Store = Pick<Storage, "getItem" | "setItem" | "removeItem">;

export const robotKey = (robot: string): string => `robot:${robot}`;
export const linkKey = (robot: string, link: string): string => `link:${robot}\n${link}`;
export const sceneryKey = (model: string): string => `scenery:${model}`;
export const lightKey = (light: string): string => `light:${light}`;

const KEPT_MAX = 5000;

export class Sight {
    readonly hidden = new Signal<Keys>(new Set<string>());
    readonly locked = new Signal<Keys>(new Set<string>());
    private world = "";

    constructor(private readonly store: Store | null) {}

    /** Another world: what was kept for it. */
    begin(world: string): void {
        if (world === this.world) return;
        this.world = world;
        const { hidden, locked } = this.kept();
        this.hidden.set(new Set(hidden));
        this.locked.set(new Set(locked));
    }

    private kept(): { hidden: string[]; locked: string[] } {
        try {
            const found = JSON.parse(this.store?.getItem(this.place) ?? "{}") as Record<string, unknown>;
            const texts = (value: unknown) =>
                Array.isArray(value) ? value.filter((one): one is string => typeof one === "string") : [];
            return { hidden: texts(found.hidden), locked: texts(found.locked) };
        } catch {
            return { hidden: [], locked: [] };
        }
    }

    private get place(): string {
        return `roboss.sight.${this.world}`;
    }

    hide(keys: readonly string[], on: boolean): void {
        this.change(this.hidden, keys, on);
    }

    lock(keys: readonly string[], on: boolean): void {
        this.change(this.locked, keys, on);
    }

    private change(signal: Signal<Keys>, keys: readonly string[], on: boolean): void {
        const next = new Set(signal.value);
        for (const key of keys) {
            if (on) next.add(key);
            else next.delete(key);
        }
        signal.set(next);
        const hidden = [...this.hidden.value].slice(0, KEPT_MAX),
            locked = [...this.locked.value].slice(0, KEPT_MAX);
        try {
            if (hidden.length + locked.length === 0) this.store?.removeItem(this.place);
            else this.store?.setItem(this.place, JSON.stringify({ hidden, locked }));
        } catch {
            // The browser keeps nothing (private window, full): it lasts as long as the page.
        }
    }
}
