// The pose of a robot as six fields: they show what is measured, and Enter puts the robot where they say. The robot then
// rests there; its joints keep their positions.
import type { Editing } from "../model/editing";
import { quaternionOf, toRollPitchYaw } from "../kinematics/pose";
import type { Placing } from "../model/placing";
import { h, setText } from "../ui/dom";
import type { PoseArray, RobotReport } from "../wire/messages";

const NAMES = ["x", "y", "z", "roll", "pitch", "yaw"] as const;
const DEGREE = Math.PI / 180;

export class PoseFields {
    readonly element: HTMLElement;
    private readonly inputs: HTMLInputElement[];
    private readonly fault = h("p", { class: "fault", role: "alert" });
    private typed = false;

    constructor(
        private readonly robot: number,
        private readonly editing: Editing,
        private readonly placing: Placing,
        /** What plots each number. */
        plots: readonly HTMLElement[] = [],
    ) {
        this.inputs = NAMES.map((name, k) =>
            h("input", {
                type: "text",
                inputmode: "decimal",
                "aria-label": `${name} of the robot, ${k < 3 ? "m" : "degrees"}`,
                onfocus: (event: FocusEvent) => (event.target as HTMLInputElement).select(),
                oninput: () => this.mark(true),
                onkeydown: (event: KeyboardEvent) => this.key(event),
                onblur: () => !this.inputs.some((input) => input.matches(":focus")) && this.mark(false),
            }),
        );
        const why = placing.refusal(robot);
        for (const input of this.inputs) input.disabled = why !== "";
        this.element = h(
            "div",
            { class: "pose-fields", title: why === "" ? "Enter puts the robot there" : why },
            ...NAMES.map((name, k) =>
                h(
                    "label",
                    {},
                    h("span", { class: "pose-name" }, name, plots[k] ?? null),
                    this.inputs[k],
                    h("span", { class: "unit" }, k < 3 ? "m" : "°"),
                ),
            ),
            this.fault,
        );
    }

    private mark(typed: boolean): void {
        this.typed = typed;
        if (!typed) this.valid();
        this.element.classList.toggle("typed", typed);
    }

    private valid(): void {
        setText(this.fault, "");
        for (const input of this.inputs) input.removeAttribute("aria-invalid");
    }

    private key(event: KeyboardEvent): void {
        if (event.key === "Escape") {
            (event.target as HTMLElement).blur();
            this.mark(false);
        } else if (event.key === "Enter") this.send();
        else return;
        event.stopPropagation();
    }

    private send(): void {
        const numbers = this.inputs.map((input) => (input.value.trim() === "" ? NaN : Number(input.value)));
        this.inputs.forEach((input, k) => input.setAttribute("aria-invalid", String(!Number.isFinite(numbers[k]))));
        const wrong = NAMES.filter((_, k) => !Number.isFinite(numbers[k]));
        setText(this.fault, wrong.length > 0 ? `Not a number: ${wrong.join(", ")}.` : "");
        if (wrong.length > 0) return;
        const [x, y, z, roll, pitch, yaw] = numbers,
            q = quaternionOf(roll * DEGREE, pitch * DEGREE, yaw * DEGREE),
            pose: PoseArray = [x, y, z, ...q];
        this.editing.move([{ robot: this.robot, pose: this.placing.frame(this.robot) }], [{ robot: this.robot, pose }]);
        this.mark(false);
    }

    show(report: RobotReport): void {
        if (this.typed) return;
        const [roll, pitch, yaw] = toRollPitchYaw(report.pose);
        [...report.pose.slice(0, 3), roll / DEGREE, pitch / DEGREE, yaw / DEGREE].forEach((value, k) => {
            const text = (Math.abs(value) < 5e-5 ? 0 : value).toFixed(k < 3 ? 4 : 2);
            if (this.inputs[k] !== document.activeElement && this.inputs[k].value !== text) this.inputs[k].value = text;
        });
    }
}
