// Drive a robot by hand: up and down is forwards and back along its own x axis, left and right turns it. While the pad is
// held (or an arrow key on it), commands of the robot's own drive go out, or velocity orders where it has none; letting go
// stops the robot.
import { rotate } from "../kinematics/pose";
import { type Drive, driveOf, driveValues } from "../model/drive";
import type { RunLink } from "../model/run_link";
import type { ViewerState } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";
import type { OrderAction } from "../wire/messages";

/** Between two orders; a drive keeps its last command. */
const VELOCITY_INTERVAL_MS = 50;
const COMMAND_INTERVAL_MS = 100;
const TURN_MAX = 2;
const KEYS: Record<string, [number, number]> = {
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
};

/** Level and ahead by the robot's own x axis, whatever carries it. */
function velocityOrder(base: Float64Array | Float32Array, speed: number, turn: number): OrderAction {
    const ahead = rotate(base, [1, 0, 0]),
        flat = Math.hypot(ahead[0], ahead[1]) || 1;
    return {
        action: "velocity",
        linear: [(speed * ahead[0]) / flat, (speed * ahead[1]) / flat, 0],
        angular: [0, 0, turn],
    };
}

function words(drive: Drive | null): string {
    return drive === null
        ? "This robot has no drive of its own: velocity orders move its body."
        : `Drives by its command ${drive.channel.name}.`;
}

export function velocityPad(run: RunLink, state: ViewerState, robot: number): HTMLElement {
    const knob = h("div", { class: "knob" }),
        said = h("output", { class: "pad-text", "aria-live": "off" });
    const top = h(
        "select",
        { "aria-label": "Greatest speed" },
        ...["0.5", "1", "2", "5", "10"].map((value) => h("option", { value, selected: value === "1" }, `${value} m/s`)),
    );
    const pad = h(
        "div",
        {
            class: "pad",
            tabindex: 0,
            role: "application",
            "aria-label": "Velocity pad: hold an arrow key or drag to drive",
        },
        knob,
    );
    const world = state.world.value,
        drive = world === null ? null : driveOf(world.fleet.type(robot)),
        interval = drive === null ? VELOCITY_INTERVAL_MS : COMMAND_INTERVAL_MS;
    let x = 0,
        y = 0,
        timer = 0;
    const send = () => {
        if (world === null || world !== state.world.value) return;
        const base = world.history.drawn.base.subarray(robot * 7, robot * 7 + 7);
        const speed = y * Number(top.value),
            turn = -x * TURN_MAX;
        setText(said, `${fixed(speed, 2)} m/s, ${fixed(turn, 2)} rad/s`);
        void run.order(
            robot,
            drive === null
                ? velocityOrder(base, speed, turn)
                : { action: "command", name: drive.channel.name, values: driveValues(drive, speed, turn) },
        );
    };
    const go = (nextX: number, nextY: number) => {
        [x, y] = [Math.max(-1, Math.min(1, nextX)), Math.max(-1, Math.min(1, nextY))];
        knob.style.transform = `translate(${x * 40}px, ${-y * 40}px)`;
        if (timer !== 0) return;
        send();
        timer = window.setInterval(() => (pad.isConnected ? send() : stop()), interval);
    };
    const stop = () => {
        if (timer === 0) return;
        clearInterval(timer);
        timer = x = y = 0;
        knob.style.transform = "";
        send(); // also where the pad is gone: a drive would go on
        setText(said, "");
    };
    const drag = (event: PointerEvent) => {
        const box = pad.getBoundingClientRect();
        go((event.clientX - box.left - box.width / 2) / 40, -(event.clientY - box.top - box.height / 2) / 40);
    };
    pad.addEventListener("pointerdown", (event) => {
        pad.setPointerCapture(event.pointerId);
        drag(event);
    });
    pad.addEventListener("pointermove", (event) => timer !== 0 && event.buttons !== 0 && drag(event));
    for (const name of ["pointerup", "pointercancel", "blur"]) pad.addEventListener(name, stop);
    const held = new Set<string>();
    pad.addEventListener("keydown", (event) => {
        if (KEYS[event.key] === undefined) return;
        held.add(event.key);
        go(
            [...held].reduce((sum, key) => sum + KEYS[key][0], 0),
            [...held].reduce((sum, key) => sum + KEYS[key][1], 0),
        );
        event.preventDefault();
        event.stopPropagation();
    });
    pad.addEventListener("keyup", (event) => {
        held.delete(event.key);
        if (held.size === 0) stop();
        else
            go(
                [...held].reduce((sum, key) => sum + KEYS[key][0], 0),
                [...held].reduce((sum, key) => sum + KEYS[key][1], 0),
            );
    });
    return h(
        "div",
        { class: "pad-row" },
        pad,
        h(
            "div",
            { class: "pad-side" },
            h("label", {}, "At most ", top),
            said,
            h("p", { class: "hint" }, "Drag, or hold arrow keys. Letting go stops the robot."),
            h("p", { class: "hint" }, words(drive)),
        ),
    );
}
