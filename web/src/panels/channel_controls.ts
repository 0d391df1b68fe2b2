// One command of a robot's on-board controllers a block: its values with units, what was commanded last and when, and
// fields and sliders to command something else.
import type { RunLink } from "../model/run_link";
import { h, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";
import type { RobotReport, TypeInfo } from "../wire/messages";
import type { ChannelInfo, ChannelReport } from "../wire/onboard";

/** How far a slider goes at first, by unit; a number may be larger. */
const SLIDER_MOST: Record<string, number> = {
    "m/s": 2,
    "rad/s": 3,
    rad: Math.PI,
    m: 2,
    N: 50,
    "N m": 10,
};

/** "3.20 s", of the last command; "never". */
export function lastText(told: ChannelReport | undefined, dt: number): string {
    return told === undefined || told.tick < 0 ? "no command yet" : `last at ${fixed(told.tick * dt, 2)} s`;
}

/** Numbers between spaces, commas and line ends; null: something is none. */
export function numbersOf(text: string): number[] | null {
    const words = text.split(/[\s,;]+/).filter((word) => word !== ""),
        numbers = words.map(Number);
    return numbers.every(Number.isFinite) ? numbers : null;
}

/** Rows of a list, a line each. */
export function rowsText(values: readonly (number | null)[], width: number): string {
    const rows: string[] = [];
    for (let k = 0; k < values.length; k += Math.max(1, width))
        rows.push(
            values
                .slice(k, k + width)
                .map((value) => value ?? 0)
                .join(" "),
        );
    return rows.join("\n");
}

/** What a person sets: the values of one command. */
interface Fields {
    element: HTMLElement;
    /** null: something is not a number. */
    values(): number[] | null;
    set(values: readonly (number | null)[]): void;
}

function valueRow(
    channel: ChannelInfo,
    k: number,
    touched: () => void,
): { element: HTMLElement; number: HTMLInputElement; set: (value: number) => void } {
    const { name, unit } = channel.values[k],
        most = SLIDER_MOST[unit] ?? 1,
        label = `${name} of ${channel.name}`;
    const slider = h("input", {
            type: "range",
            min: -most,
            max: most,
            step: most / 100,
            "aria-label": `${label}, slider`,
        }),
        number = h("input", { type: "number", step: "any", value: "0", "aria-label": label });
    const fit = (value: number) => {
        const reach = Math.max(Number(slider.max), Math.abs(value));
        slider.min = String(-reach);
        slider.max = String(reach);
        slider.value = String(value);
    };
    slider.value = "0";
    slider.addEventListener("input", () => {
        number.value = String(Number(slider.valueAsNumber.toFixed(4)));
        touched();
    });
    number.addEventListener("input", () => {
        if (Number.isFinite(number.valueAsNumber)) fit(number.valueAsNumber);
        touched();
    });
    const set = (value: number) => {
        number.value = String(Number(value.toFixed(6)));
        fit(value);
    };
    return {
        element: h(
            "div",
            { class: "command-value" },
            h("span", { class: "label", title: name }, name),
            slider,
            number,
            h("span", { class: "unit" }, unit),
        ),
        number,
        set,
    };
}

function rowsOf(channel: ChannelInfo, touched: () => void): Fields {
    const rows = channel.values.map((_, k) => valueRow(channel, k, touched));
    return {
        element: h("div", { class: "command-values" }, ...rows.map((row) => row.element)),
        values: () => {
            const values = rows.map((row) => row.number.valueAsNumber);
            return values.every(Number.isFinite) ? values : null;
        },
        set: (values) => rows.forEach((row, k) => row.set(values[k] ?? 0)),
    };
}

function listOf(channel: ChannelInfo, touched: () => void): Fields {
    const columns = channel.values.map(({ name, unit }) => (unit === "" ? name : `${name} in ${unit}`)).join(", "),
        text = h("textarea", {
            rows: 3,
            spellcheck: "false",
            "aria-label": `Rows of ${channel.name}`,
            oninput: touched,
        });
    return {
        element: h("div", { class: "command-values" }, h("p", { class: "hint" }, `A row each: ${columns}`), text),
        values: () => numbersOf(text.value),
        set: (values) => (text.value = rowsText(values, channel.values.length)),
    };
}

class ChannelControl {
    readonly element: HTMLElement;
    private readonly last = h("span", { class: "motor" });
    private readonly fault = h("p", { class: "fault", role: "status" });
    private readonly fields: Fields;
    private touched = false;
    private shownTick = -2;

    constructor(
        private readonly robot: number,
        private readonly channel: ChannelInfo,
        private readonly dt: number,
        private readonly run: RunLink,
    ) {
        const touched = () => {
            this.touched = true;
            setText(this.fault, "");
        };
        this.fields = channel.list ? listOf(channel, touched) : rowsOf(channel, touched);
        this.element = h(
            "div",
            { class: "joint command" },
            h(
                "div",
                { class: "joint-head" },
                h("span", { class: "joint-name", title: channel.name }, channel.name),
                this.last,
            ),
            this.fields.element,
            h(
                "div",
                { class: "command-buttons" },
                this.fault,
                channel.list || channel.values.length > 0
                    ? h(
                          "button",
                          { type: "button", class: "small", onclick: () => this.zero() },
                          channel.list ? "Clear" : "Zero",
                      )
                    : null,
                h(
                    "button",
                    {
                        type: "button",
                        class: "small",
                        "aria-label": `Send ${channel.name}`,
                        onclick: () => this.send(),
                    },
                    "Send",
                ),
            ),
        );
        this.element.addEventListener("keydown", (event) => {
            if (event.key === "Enter" && event.target instanceof HTMLInputElement) this.send();
        });
    }

    private zero(): void {
        this.fields.set(this.channel.list ? [] : this.channel.values.map(() => 0));
        this.send();
    }

    private send(): void {
        const values = this.fields.values();
        if (values === null) return setText(this.fault, "Give numbers.");
        void this.run.order(this.robot, { action: "command", name: this.channel.name, values }).then((answer) => {
            if (answer.done) this.touched = false;
            setText(this.fault, answer.done ? "" : answer.text);
        });
    }

    /** Until a hand changes them, the fields say what was commanded last. */
    show(told: ChannelReport | undefined): void {
        setText(this.last, lastText(told, this.dt));
        if (told === undefined || this.touched || told.tick === this.shownTick) return;
        if (this.element.contains(document.activeElement) && document.activeElement instanceof HTMLInputElement) return;
        this.shownTick = told.tick;
        this.fields.set(told.values);
    }
}

export class ChannelControls {
    readonly element = h("div", { class: "joints" });
    private readonly controls: ChannelControl[];

    constructor(robot: number, type: TypeInfo, dt: number, run: RunLink) {
        this.controls = (type.channels ?? []).map((channel) => new ChannelControl(robot, channel, dt, run));
        this.element.append(...this.controls.map((control) => control.element));
    }

    show(report: RobotReport): void {
        this.controls.forEach((control, k) => control.show(report.channels?.[k]));
    }
}
