// On narrow screens the panels are sheets: from the bottom on phones, at the side on tablets and on phones held sideways. A
// bar of tabs opens them, one at a time, and the picture keeps the rest. On wide screens the same calls open the panels.
import { h, icon, iconButton, setText } from "../ui/dom";
import type { IconName } from "../ui/icons";

export type Place = "left" | "right" | "dock";

export interface Sheet {
    id: string;
    title: string;
    icon: IconName;
    /** The panel that it lies in. */
    place: Place;
    /** Brings it up within its panel. */
    show?(): void;
}

/** The same condition as in sheets.css. */
export const NARROW = "(max-width: 899.98px), (max-height: 499.98px)";
/** Height of a bottom sheet as a part of the window. */
const HEIGHT = { least: 0.2, usual: 0.42, most: 0.72 };
const KEY_STEP = 0.06;

export class Sheets {
    /** The bar of tabs, and the head of the open sheet. */
    readonly bar: HTMLElement;
    readonly head: HTMLElement;
    private readonly title = h("h2", {});
    private readonly buttons = new Map<string, HTMLButtonElement>();
    private readonly handle: HTMLElement;
    private readonly narrow = matchMedia(NARROW);
    private open: string | null = null;
    private height: number = HEIGHT.usual;

    constructor(private readonly sheets: readonly Sheet[]) {
        for (const sheet of sheets)
            this.buttons.set(
                sheet.id,
                h(
                    "button",
                    { type: "button", "aria-expanded": "false", onclick: () => this.toggle(sheet.id) },
                    icon(sheet.icon),
                    h("span", {}, sheet.title),
                ),
            );
        this.bar = h("nav", { class: "sheet-bar", "aria-label": "Panels" }, ...this.buttons.values());
        this.handle = h("div", {
            class: "sheet-handle",
            role: "separator",
            tabindex: 0,
            "aria-orientation": "horizontal",
            "aria-label": "Height of the sheet",
            "aria-valuemin": 100 * HEIGHT.least,
            "aria-valuemax": 100 * HEIGHT.most,
            onkeydown: (event: KeyboardEvent) => this.key(event),
        });
        this.head = h(
            "div",
            { class: "sheet-head" },
            this.title,
            this.handle,
            iconButton("close", "Close the sheet", () => this.close()),
        );
        this.dragged();
        this.resize(this.height);
        this.narrow.addEventListener("change", () => this.close());
    }

    isNarrow(): boolean {
        return this.narrow.matches;
    }

    /** On narrow screens: the sheet that is open. */
    get current(): string | null {
        return this.open;
    }

    show(id: string): void {
        const sheet = this.sheets.find((one) => one.id === id);
        if (sheet === undefined) return;
        sheet.show?.();
        if (sheet.place !== "dock") document.body.classList.remove(`no-${sheet.place}`);
        if (!this.isNarrow()) return;
        this.open = id;
        this.mark(sheet);
    }

    /** Brings it up within its panel, but opens no panel. */
    reveal(id: string): void {
        const sheet = this.sheets.find((one) => one.id === id),
            beside = this.sheets.find((one) => one.id === this.open);
        if (sheet === undefined) return;
        if (beside?.place === sheet.place) this.show(id);
        else sheet.show?.();
    }

    close(): void {
        const before = this.open;
        this.open = null;
        this.mark(null);
        if (before !== null && this.head.contains(document.activeElement)) this.buttons.get(before)?.focus();
    }

    toggle(id: string): void {
        if (this.open === id) this.close();
        else this.show(id);
    }

    private mark(sheet: Sheet | null): void {
        if (sheet === null) delete document.body.dataset.sheet;
        else document.body.dataset.sheet = sheet.place;
        setText(this.title, sheet?.title ?? "");
        for (const [id, button] of this.buttons) button.setAttribute("aria-expanded", String(id === sheet?.id));
    }

    private resize(height: number): void {
        this.height = Math.max(HEIGHT.least, Math.min(HEIGHT.most, height));
        document.documentElement.style.setProperty("--sheet", `${(100 * this.height).toFixed(2)}dvh`);
        this.handle.setAttribute("aria-valuenow", (100 * this.height).toFixed(0));
    }

    private key(event: KeyboardEvent): void {
        const by = { ArrowUp: KEY_STEP, ArrowDown: -KEY_STEP }[event.key];
        if (by === undefined) return;
        this.resize(this.height + by);
        event.preventDefault();
        event.stopPropagation();
    }

    /** A drag of the head changes the height; one far down closes the sheet. */
    private dragged(): void {
        let from: { y: number; height: number } | null = null;
        const head = this.head;
        head.addEventListener("pointerdown", (event) => {
            if ((event.target as Element).closest("button") !== null) return;
            from = { y: event.clientY, height: this.height };
            head.setPointerCapture(event.pointerId);
        });
        head.addEventListener("pointermove", (event) => {
            if (from === null) return;
            const wanted = from.height + (from.y - event.clientY) / window.innerHeight;
            if (wanted < HEIGHT.least / 2) {
                from = null;
                this.close();
            } else this.resize(wanted);
        });
        for (const name of ["pointerup", "pointercancel"] as const) head.addEventListener(name, () => (from = null));
    }
}
