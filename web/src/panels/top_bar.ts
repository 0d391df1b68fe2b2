// The bar above: which world runs and how it does, the tools of the hand, the cameras, and what one takes away (picture,
// video, link).
import type { Capture } from "../capture";
import type { ViewerState } from "../model/viewer_state";
import { choice, h, iconButton, setText } from "../ui/dom";
import { percent, short } from "../ui/numbers";
import { moreMenu } from "../ui/overflow";

export interface TopBarActions {
    copyLink(): void;
    help(): void;
    palette(): void;
    home(): void;
    focus(): void;
    togglePanel(side: "left" | "right"): void;
}

export function topBar(
    state: ViewerState,
    capture: Capture,
    desk: HTMLElement,
    actions: TopBarActions,
): { element: HTMLElement; menu: HTMLElement } {
    const tools = choice(
        "Tool",
        [
            { value: "select", text: "Select", icon: "cursor", key: "V", words: "Select" },
            { value: "move", text: "Move a robot", icon: "move", key: "M", words: "Move" },
            { value: "push", text: "Push a robot", icon: "push", key: "P", words: "Push" },
            { value: "place", text: "Move by arrows", icon: "place", key: "G", words: "Arrows" },
            { value: "turn", text: "Turn by rings", icon: "turn", key: "O", words: "Rings" },
        ] as const,
        (tool) => state.tool.set(tool),
    );
    state.tool.follow(tools.show);
    const cameras = choice(
        "Camera",
        [
            { value: "orbit", text: "Orbit", key: "1" },
            { value: "fly", text: "Fly", key: "2" },
            { value: "follow", text: "Follow", key: "3" },
            { value: "chase", text: "Chase", key: "4" },
        ] as const,
        (mode) => state.cameraMode.set(mode),
    );
    state.cameraMode.follow(cameras.show);
    const record = iconButton("record", "Record a video", () => capture.toggleVideo(), "R", "Video");
    capture.recording.follow((on) => {
        record.classList.toggle("recording", on);
        record.setAttribute("aria-pressed", String(on));
    });
    tools.element.dataset.yields = "1";
    cameras.element.dataset.yields = "4";
    const theme = () => state.theme.set(state.theme.value === "dark" ? "light" : "dark");
    const bar = h(
        "header",
        { class: "top", role: "banner" },
        h(
            "div",
            { class: "side-button" },
            iconButton("left", "Robots panel", () => actions.togglePanel("left"), "["),
        ),
        h("h1", { class: "brand" }, "RoBOSS"),
        worldFacts(state),
        h("div", { class: "grow" }),
        desk,
        tools.element,
        cameras.element,
        group("View", 2, [
            iconButton("home", "Whole world", actions.home, "H", "All"),
            iconButton("focus", "Look at the selected robot", actions.focus, "F", "Robot"),
        ]),
        group("Take away", 5, [
            iconButton("camera", "Save a picture", () => capture.picture(), "X", "Picture"),
            record,
            iconButton("link", "Copy a link to this view", actions.copyLink, "L", "Link"),
        ]),
        group("Page", 3, [
            iconButton("theme", "Light or dark", theme, "T", "Theme"),
            iconButton("help", "Keys and help", actions.help, "?", "Help"),
        ]),
        h(
            "div",
            { class: "side-button" },
            iconButton("right", "Side panel", () => actions.togglePanel("right"), "]"),
        ),
    );
    bar.insertBefore(iconButton("command", "All commands", actions.palette, "Ctrl K"), tools.element);
    desk.dataset.yields = "2";
    const more = moreMenu(bar, "More", false);
    bar.append(more.button);
    // What a bar holds changes its width, too: who has control, what the run does.
    state.roles.follow(() => requestAnimationFrame(() => more.fit()));
    return { element: bar, menu: more.menu };
}

function group(label: string, yields: number, buttons: HTMLElement[]): HTMLElement {
    return h(
        "div",
        { class: "cluster-of-buttons", role: "group", "aria-label": label, "data-yields": yields },
        ...buttons,
    );
}

function worldFacts(state: ViewerState): HTMLElement {
    const dot = h("span", { class: "dot", "aria-hidden": "true" }),
        name = h("span", { class: "world-name" });
    const facts = h("span", { class: "facts" });
    const show = () => {
        const status = state.status.value,
            world = state.world.value;
        dot.dataset.state = state.link.value.state !== "open" ? "gone" : status?.paused === true ? "paused" : "running";
        setText(name, world?.fleet.scene.world ?? "");
        name.title = name.textContent ?? "";
        const parts =
            world === null ? [] : [`${short(world.fleet.count)} ${world.fleet.count === 1 ? "robot" : "robots"}`];
        if (status !== null) {
            parts.push(`${status.simulators} ${status.simulators === 1 ? "Simulator" : "Simulators"}`);
            if ((status.islands ?? 0) > 0)
                parts.push(`${short(status.islands)} ${status.islands === 1 ? "island" : "islands"}`);
            if (typeof status.efficiency === "number" && status.simulators > 1)
                parts.push(`efficiency ${percent(status.efficiency)}`);
        }
        setText(facts, parts.join("  ·  "));
    };
    state.link.follow(show);
    state.status.follow(show);
    state.world.follow(show);
    return h("div", { class: "world" }, dot, name, facts);
}
