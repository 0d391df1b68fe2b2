// Any variable of any robot for a plot: choose the robot, then the variable. "New plot": it begins a plot of its own.
import type { Plotted } from "../model/plotted";
import { allReadings, type Reading } from "../model/readings";
import type { ViewerState } from "../model/viewer_state";
import { h } from "../ui/dom";
import type { RobotReport, TypeInfo } from "../wire/messages";

/** What can be plotted although no report has come: all but the fields of sensors. */
function blank(robot: number): RobotReport {
    return {
        type: "robot",
        scene: 0,
        robot,
        tick: 0,
        time: 0,
        pose: [0, 0, 0, 1, 0, 0, 0],
        linear: [0, 0, 0],
        angular: [0, 0, 0],
        joints: [],
        sensors: [],
        contacts: [],
        all_contacts: true,
    };
}

export function plotPicker(state: ViewerState, plotted: Plotted): HTMLElement {
    const names = h("datalist", { id: "plot-robots" }),
        robot = h("input", {
            type: "search",
            list: "plot-robots",
            placeholder: "Robot",
            "aria-label": "Robot to plot",
            autocomplete: "off",
        }),
        variable = h("select", { "aria-label": "Variable to plot" }),
        add = h("button", { type: "button", class: "small", onclick: () => take(false) }, "Add"),
        fresh = h("button", { type: "button", class: "small", onclick: () => take(true) }, "New plot");
    let found: Reading[] = [];
    const chosen = () => state.world.value?.fleet.find(robot.value);
    const fill = () => {
        const number = chosen(),
            type: TypeInfo | undefined = number === undefined ? undefined : state.world.value?.fleet.type(number),
            report = state.report.value?.robot === number ? state.report.value : null;
        found = type === undefined || number === undefined ? [] : allReadings(type, report ?? blank(number));
        const before = variable.value;
        variable.replaceChildren(...found.map((one) => h("option", { value: one.key }, one.label)));
        if (found.some((one) => one.key === before)) variable.value = before;
        variable.disabled = add.disabled = fresh.disabled = found.length === 0;
    };
    const take = (alone: boolean) => {
        const number = chosen(),
            reading = found.find((one) => one.key === variable.value);
        if (number === undefined || reading === undefined) return;
        if (alone) plotted.begin();
        if (!plotted.has(number, reading.key)) plotted.toggle(number, reading.key, reading.label, reading.unit);
        plotted.active.set(null);
    };
    robot.addEventListener("input", fill);
    variable.addEventListener("pointerdown", fill);
    state.world.follow((world) => {
        names.replaceChildren(
            ...(world?.fleet.scene.robots ?? []).slice(0, 2000).map((one) => h("option", { value: one.name })),
        );
        fill();
    });
    state.selected.follow((number) => {
        if (number === null) return;
        robot.value = state.world.value?.fleet.name(number) ?? "";
        fill();
    });
    return h(
        "div",
        { class: "plot-picker", role: "group", "aria-label": "Add a curve", "data-yields": 4 },
        robot,
        names,
        variable,
        add,
        fresh,
    );
}
