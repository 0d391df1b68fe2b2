// The page's own actions. What belongs to one part of the page may be added by that part instead (Actions.add).
import type { Capture } from "./capture";
import type { Director } from "./camera/director";
import type { Action } from "./model/actions";
import { type CameraMode, OVERLAYS, type Tool, type ViewerState } from "./model/viewer_state";
import { COLOURS, WORDS } from "./panels/view_options";
import type { TimeBar } from "./panels/time_bar";
import type { IconName } from "./ui/icons";

export interface PageParts {
    state: ViewerState;
    director: Director;
    capture: Capture;
    time: TimeBar;
    findRobot(): void;
    togglePanel(side: "left" | "right"): void;
    copyLink(): void;
    help(): void;
    palette(): void;
    openSheet(id: string): void;
}

function timeActions({ time }: PageParts): Action[] {
    const group = "Time";
    return [
        { id: "time.play", title: "Play or pause", group, keys: [" "], icon: "play", run: () => time.playOrPause() },
        {
            id: "time.step",
            title: "One tick",
            group,
            keys: ["."],
            icon: "step",
            repeats: true,
            run: () => time.step(1),
        },
        { id: "time.faster", title: "Faster", group, keys: ["+", "="], run: () => time.faster(1) },
        { id: "time.slower", title: "Slower", group, keys: ["-"], run: () => time.faster(-1) },
        {
            id: "time.rewind",
            title: "Rewind: look at an earlier moment",
            group,
            icon: "branches",
            words: "timeline back history",
            run: time.rewind,
        },
        {
            id: "time.reset",
            title: "Reset to the beginning or the last save",
            group,
            icon: "reset",
            destructive: true,
            run: time.reset,
        },
        { id: "time.bookmark", title: "Bookmark this moment", group, keys: ["B"], icon: "flag", run: time.bookmark },
        {
            id: "time.branches",
            title: "Branches and bookmarks",
            group,
            keys: ["K"],
            icon: "branches",
            run: time.toggleBranches,
        },
        { id: "time.now", title: "Back to now", group, run: () => void time.backToNow() },
    ];
}

function toolActions({ state, time }: PageParts): Action[] {
    const group = "Tools",
        tool = (value: Tool, title: string, key: string, icon: IconName): Action => ({
            id: `tool.${value}`,
            title,
            group,
            keys: [key],
            icon,
            run: () => state.tool.set(value),
            on: () => state.tool.value === value,
        });
    const letGo = () => {
        if (time.backToNow()) return;
        if (state.attaching.value !== null) state.attaching.set(null);
        else if (state.tool.value !== "select") state.tool.set("select");
        else if (state.adding.value !== null) state.adding.set(null);
        else {
            state.selected.set(null);
            state.scenery.set(null);
        }
    };
    return [
        tool("select", "Select", "V", "cursor"),
        tool("move", "Move a robot", "M", "move"),
        tool("push", "Push a robot", "P", "push"),
        { id: "tool.let_go", title: "Back to now, let go", group, keys: ["Escape"], run: letGo },
    ];
}

function cameraActions({ state, director }: PageParts): Action[] {
    const group = "Camera",
        mode = (value: CameraMode, title: string, key: string): Action => ({
            id: `camera.${value}`,
            title,
            group,
            keys: [key],
            words: "camera",
            run: () => state.cameraMode.set(value),
            on: () => state.cameraMode.value === value,
        });
    const focus = () => state.selected.value !== null && director.focus(state.selected.value);
    return [
        mode("orbit", "Orbit", "1"),
        mode("fly", "Fly", "2"),
        mode("follow", "Follow the selected robot", "3"),
        mode("chase", "Chase the selected robot", "4"),
        { id: "camera.home", title: "Whole world", group, keys: ["H"], icon: "home", run: () => director.home() },
        {
            id: "camera.focus",
            title: "Look at the selected robot",
            group,
            keys: ["F"],
            icon: "focus",
            run: focus,
            enabled: () => state.selected.value !== null,
        },
    ];
}

function ownActions(parts: PageParts): Action[] {
    const group = "Page",
        { state, capture } = parts;
    const theme = () => state.theme.set(state.theme.value === "dark" ? "light" : "dark");
    return [
        { id: "page.find", title: "Find a robot", group, keys: ["/"], icon: "search", run: parts.findRobot },
        {
            id: "page.left",
            title: "Robots panel",
            group,
            keys: ["["],
            icon: "left",
            run: () => parts.togglePanel("left"),
        },
        {
            id: "page.right",
            title: "Side panel",
            group,
            keys: ["]"],
            icon: "right",
            run: () => parts.togglePanel("right"),
        },
        { id: "page.theme", title: "Light or dark", group, keys: ["T"], icon: "theme", run: theme },
        {
            id: "page.picture",
            title: "Save a picture",
            group,
            keys: ["X"],
            icon: "camera",
            run: () => capture.picture(),
        },
        {
            id: "page.video",
            title: "Record a video",
            group,
            keys: ["R"],
            icon: "record",
            run: () => capture.toggleVideo(),
            on: () => capture.recording.value,
        },
        { id: "page.link", title: "Copy a link to this view", group, keys: ["L"], icon: "link", run: parts.copyLink },
        { id: "page.help", title: "Keys and help", group, keys: ["?"], icon: "help", run: parts.help },
    ];
}

function viewActions({ state }: PageParts): Action[] {
    const colours = COLOURS.map(([value, name, words]): Action => ({
        id: `colour.${value}`,
        title: `Colour by ${name}`,
        group: "Colours",
        words: `color ${words}`,
        icon: "eye",
        run: () => state.colourBy.set(value),
        on: () => state.colourBy.value === value,
    }));
    const overlays = OVERLAYS.map((overlay): Action => ({
        id: `overlay.${overlay}`,
        title: WORDS[overlay][0],
        group: "Show",
        words: WORDS[overlay][1],
        icon: "eye",
        run: () => state.toggle(overlay),
        on: () => state.overlays.value.has(overlay),
    }));
    return [...colours, ...overlays];
}

function sheetActions({ openSheet, palette }: PageParts): Action[] {
    const sheets: [string, string, IconName][] = [
        ["robots", "Open the robots", "list"],
        ["inspector", "Open the robot's panel", "robot"],
        ["cluster", "Open the cluster's panel", "cluster"],
        ["view", "Open the view's panel", "eye"],
        ["plots", "Open the plots", "plot"],
    ];
    return [
        ...sheets.map(([id, title, icon]): Action => ({
            id: `sheet.${id}`,
            title,
            group: "Panels",
            icon,
            run: () => openSheet(id),
        })),
        {
            id: "page.palette",
            title: "All commands",
            group: "Page",
            keys: ["Mod+K"],
            icon: "command",
            everywhere: true,
            run: palette,
        },
    ];
}

/** Each robot by its name: chosen and looked at. */
export function robotActions({ state, director }: Pick<PageParts, "state" | "director">): Action[] {
    return (state.world.value?.fleet.scene.robots ?? []).map((robot, k) => ({
        id: `robot.${robot.name}`,
        title: robot.name,
        group: "Robots",
        icon: "robot",
        run: () => director.focus(k),
    }));
}

export function pageActions(parts: PageParts): Action[] {
    return [
        ...timeActions(parts),
        ...toolActions(parts),
        ...cameraActions(parts),
        ...ownActions(parts),
        ...sheetActions(parts),
        ...viewActions(parts),
    ];
}
