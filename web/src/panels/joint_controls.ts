// One joint axis a block: where it is between its limits, what its motor does, and a slider that orders it about.
import type { Reading } from "../model/readings";
import { axisUnit } from "../model/readings";
import type { RunLink } from "../model/run_link";
import { h, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";
import { throttled } from "../ui/throttle";
import type { JointInfo, MotorReport, RobotReport, TypeInfo } from "../wire/messages";
import type { ReadingRows } from "./reading_rows";

const modes = ["velocity", "position", "effort", "passive"] as const;
type Mode = (typeof modes)[number];
const ORDER_INTERVAL_MS = 50;

/** From where to where the slider goes in a mode. */
export function sliderRange(joint: JointInfo, axis: number, mode: Mode): [number, number] {
    const lower = joint.lower[axis] ?? null,
        upper = joint.upper[axis] ?? null,
        length = axisUnit(joint, axis) === "m";
    if (mode === "position") return [lower ?? (length ? -1 : -Math.PI), upper ?? (length ? 1 : Math.PI)];
    const most =
        (mode === "velocity" ? joint.max_velocity[axis] : joint.max_effort[axis]) ??
        (mode === "velocity" ? (length ? 1 : 20) : 10);
    return [-most, most];
}

class AxisControl {
    readonly element: HTMLElement;
    private readonly bar = h("div", { class: "limit-mark" });
    private readonly motor = h("span", { class: "motor" });
    private readonly slider = h("input", { type: "range", step: "any" });
    private readonly target = h("output", { class: "value" });
    private readonly modes: HTMLSelectElement;
    private touched = false;

    constructor(
        private readonly robot: number,
        private readonly number: number,
        private readonly axis: number,
        private readonly joint: JointInfo,
        private readonly run: RunLink,
        rows: HTMLElement[],
    ) {
        const name = joint.axes > 1 ? `${joint.name} ${axis + 1}` : joint.name;
        this.modes = h(
            "select",
            { "aria-label": `Motor mode of ${name}`, onchange: () => this.changeMode() },
            ...modes.map((mode) => h("option", { value: mode }, mode)),
        );
        this.slider.setAttribute("aria-label", `Target of ${name}`);
        const send = throttled(ORDER_INTERVAL_MS, () => this.order());
        this.slider.addEventListener("input", () => {
            this.touched = true;
            setText(this.target, fixed(this.slider.valueAsNumber, 2));
            send();
        });
        const limited = (joint.lower[axis] ?? null) !== null && (joint.upper[axis] ?? null) !== null;
        if (limited) this.modes.value = "position";
        this.element = h(
            "div",
            { class: "joint" },
            h(
                "div",
                { class: "joint-head" },
                h("span", { class: "joint-name" }, name),
                h("span", { class: "kind" }, joint.kind),
                this.motor,
            ),
            limited
                ? h(
                      "div",
                      { class: "limits" },
                      h("span", {}, fixed(joint.lower[axis], 2)),
                      h("div", { class: "limit-track" }, this.bar),
                      h("span", {}, fixed(joint.upper[axis], 2)),
                  )
                : null,
            ...rows,
            h("div", { class: "joint-order" }, this.modes, this.slider, this.target),
        );
        this.fit();
    }

    private fit(): void {
        const [from, to] = sliderRange(this.joint, this.axis, this.modes.value as Mode);
        this.slider.min = String(from);
        this.slider.max = String(to);
        this.slider.disabled = this.modes.value === "passive";
    }

    private changeMode(): void {
        this.fit();
        this.touched = true;
        if (this.modes.value === "velocity" || this.modes.value === "effort") this.slider.value = "0";
        setText(this.target, fixed(this.slider.valueAsNumber, 2));
        this.order();
    }

    private order(): void {
        void this.run.order(this.robot, {
            action: "joint",
            joint: this.number,
            axis: this.axis,
            mode: this.modes.value,
            target: this.modes.value === "passive" ? 0 : this.slider.valueAsNumber,
        });
    }

    show(report: RobotReport): void {
        const told = report.joints[this.number],
            motor = told?.motors?.[this.axis],
            position = told?.position[this.axis];
        const lower = this.joint.lower[this.axis] ?? null,
            upper = this.joint.upper[this.axis] ?? null;
        if (position !== undefined && lower !== null && upper !== null && upper > lower)
            this.bar.style.left = `${100 * Math.max(0, Math.min(1, (position - lower) / (upper - lower)))}%`;
        const unit = axisUnit(this.joint, this.axis),
            units: Record<string, string> = {
                velocity: `${unit}/s`,
                position: unit,
                effort: unit === "m" ? "N" : "N m",
            };
        setText(
            this.motor,
            motor === undefined
                ? "no motor"
                : motor.mode === "passive"
                  ? "passive"
                  : `${motor.mode} → ${fixed(motor.target, 2)} ${units[motor.mode] ?? ""}`,
        );
        if (!this.touched) this.copy(motor, position);
    }

    /** Until a hand takes it, the slider stands where the motor's target is, or the joint itself where no motor acts. */
    private copy(motor: MotorReport | undefined, position: number | undefined): void {
        const acts = motor !== undefined && motor.mode !== "passive";
        if (acts && this.modes.value !== motor.mode && modes.includes(motor.mode as Mode)) {
            this.modes.value = motor.mode;
            this.fit();
        }
        const value = acts ? motor.target : this.modes.value === "position" ? (position ?? 0) : 0;
        if (document.activeElement !== this.slider) this.slider.value = String(value);
        setText(this.target, fixed(value, 2));
    }
}

export class JointControls {
    readonly element = h("div", { class: "joints" });
    private readonly controls: AxisControl[] = [];

    constructor(robot: number, type: TypeInfo, run: RunLink, rows: ReadingRows, all: readonly Reading[]) {
        type.joints.forEach((joint, number) => {
            for (let axis = 0; axis < joint.axes; ++axis) {
                const key = `joint.${joint.name}.${axis}.`;
                const mine = all
                    .filter((reading) => reading.key.startsWith(key))
                    .map((reading) => rows.row(reading, reading.key.slice(key.length)));
                const control = new AxisControl(robot, number, axis, joint, run, mine);
                this.controls.push(control);
                this.element.append(control.element);
            }
        });
    }

    show(report: RobotReport): void {
        for (const control of this.controls) control.show(report);
    }
}
