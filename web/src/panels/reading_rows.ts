// Rows of numbers that change with each report, each with a button that plots it.
import type { Plotted } from "../model/plotted";
import type { Reading } from "../model/readings";
import { h, iconButton, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";

export class ReadingRows {
    private readonly values = new Map<string, HTMLElement>();
    private readonly buttons = new Map<string, HTMLButtonElement>();

    constructor(
        private readonly robot: number,
        private readonly plotted: Plotted,
    ) {}

    /** `shown`: what the row says where its place already says the rest. */
    row(reading: Reading, shown = reading.label): HTMLElement {
        const value = h("span", { class: "value" }),
            button = this.button(reading);
        this.values.set(reading.key, value);
        return h(
            "div",
            { class: "reading" },
            h("span", { class: "label" }, shown),
            value,
            h("span", { class: "unit" }, reading.unit),
            button,
        );
    }

    /** Plots it, or no longer. */
    button(reading: Reading): HTMLButtonElement {
        const button = iconButton("plot", `Plot ${reading.label}`, () => {
            this.plotted.toggle(this.robot, reading.key, reading.label, reading.unit);
            this.mark();
        });
        this.buttons.set(reading.key, button);
        this.mark();
        return button;
    }

    show(list: readonly Reading[]): void {
        for (const reading of list) {
            const element = this.values.get(reading.key);
            if (element !== undefined)
                setText(
                    element,
                    fixed(reading.value, reading.unit !== "°" ? 3 : reading.key.startsWith("angle") ? 1 : 6),
                );
        }
    }

    mark(): void {
        for (const [key, button] of this.buttons)
            button.setAttribute("aria-pressed", String(this.plotted.has(this.robot, key)));
    }
}
