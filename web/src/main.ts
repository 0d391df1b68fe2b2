// Puts the page together. Everything hangs on ViewerState; the parts do not know each other.
import { Capture } from "./capture";
import { Director } from "./camera/director";
import { CameraPointer } from "./camera/pointer";
import { ViewKeeper } from "./camera/view_keeper";
import { Views } from "./camera/views";
import { FrameLoop } from "./frame_loop";
import { EditHand } from "./hands/edit_hand";
import { HandMark } from "./hands/hand_mark";
import { Actions } from "./model/actions";
import { Address } from "./model/address";
import { Bonding } from "./model/bonding";
import { waitsOf } from "./model/picture_waits";
import { Plotted } from "./model/plotted";
import { RunLink } from "./model/run_link";
import { applyAddress, copyViewLink, keepTheme, startTheme } from "./model/view_link";
import { ViewerState, type World } from "./model/viewer_state";
import { LabelLayer } from "./overlays/labels";
import { pageActions, robotActions } from "./page_actions";
import { CameraPanel } from "./panels/camera_panel";
import { ClusterPanel } from "./panels/cluster_panel";
import { controlDesk } from "./panels/control_desk";
import { helpCard } from "./panels/help";
import { legend } from "./panels/legend";
import { firstHints } from "./panels/hints";
import { Inspector } from "./panels/inspector";
import { notices } from "./panels/notices";
import { overPicture } from "./panels/over_picture";
import { Palette } from "./panels/palette";
import { PlotsDock } from "./panels/plots_dock";
import { ScenePanel } from "./panels/scene_panel";
import { sceneryInfo } from "./panels/scenery_info";
import { type Sheet, Sheets } from "./panels/sheets";
import { runBanner } from "./panels/run_banner";
import { sideTabs, type Tab } from "./panels/side_tabs";
import { timeBar } from "./panels/time_bar";
import { topBar } from "./panels/top_bar";
import { viewActions, viewBar } from "./panels/view_bar";
import { viewFrames } from "./panels/view_frames";
import { viewOptions } from "./panels/view_options";
import { pictureLayers } from "./picture_layers";
import { SceneEditing } from "./scene_editing";
import { h } from "./ui/dom";
import { Colouring } from "./view/colouring";
import { Effort } from "./view/effort";
import { FrameTimes } from "./view/frame_times";
import { Stage } from "./view/stage";

const LOW_INTERVAL_MS = 45;

const address = new Address(location.search, location.hash);
const state = new ViewerState();
state.theme.set(startTheme(address));
const run = new RunLink(state);
const views = new Views();
const times = new FrameTimes();

const canvas = h("canvas", {
    tabindex: 0,
    role: "application",
    "aria-label": "The world in three dimensions. Robots can also be chosen in the list.",
});
const quality = (["low", "high"] as const).find((word) => word === address.get("quality")) ?? "auto";
const view = h("main", { class: "view" }, canvas);
document.body.append(view);
const stage = new Stage(canvas, quality);
const labels = new LabelLayer(stage);
const director = new Director(stage, state, views, address);
const said = notices(run);
const capture = new Capture(
    stage,
    () =>
        `${state.world.value?.fleet.scene.world ?? "roboss"}_${state.drawnTime.value.toFixed(2)}s`.replace(/\s+/g, "_"),
    said.say,
);
const mark = new HandMark(labels);
const bonding = new Bonding(state, run);
const colouring = new Colouring(stage, state),
    scene = new SceneEditing(stage, state, run, views, labels, colouring);
const hand = new EditHand(
    scene,
    stage,
    state,
    run,
    mark,
    bonding,
    (robot) => director.followRobot(robot),
    (robot) => {
        state.selected.set(robot);
        sheets.show("inspector");
    },
);
let hurried = false;
window.addEventListener("keydown", (event) => (hurried = event.shiftKey));
window.addEventListener("keyup", (event) => (hurried = event.shiftKey));
const pointer = new CameraPointer(
    canvas,
    views,
    hand,
    () => state.cameraMode.value,
    () => director.letGo(),
    stage,
);

const plotted = new Plotted(state, (text) => said.say(text, true), address.get("plots"));
const list = new ScenePanel(
    state,
    scene.selection,
    (robot) => director.focus(robot),
    (robot) => bonding.take(robot),
    scene.bar,
);
const time = timeBar(state, run);
const desk = controlDesk(state, run);
const cameras = new CameraPanel(state, state.cameras, () => sheets.isNarrow() && sheets.close());
const sideTabList: Tab[] = [
    {
        id: "inspector",
        title: "Robot",
        icon: "robot",
        content: h(
            "div",
            {},
            new Inspector(state, run, plotted, scene, (robot) => {
                state.selected.set(robot);
                state.cameraMode.set("follow");
            }).element,
            sceneryInfo(state),
        ),
    },
    { id: "cameras", title: "Cameras", icon: "camera", content: cameras.element },
    { id: "cluster", title: "Cluster", icon: "cluster", content: new ClusterPanel(state, run).element },
    { id: "view", title: "View", icon: "eye", content: viewOptions(state) },
];
const tabs = sideTabs(sideTabList);
const dock = new PlotsDock(state, plotted);
const sheets = new Sheets([
    { id: "robots", title: "Robots", icon: "list", place: "left" },
    ...sideTabList.map(({ id, title, icon }): Sheet => ({
        id,
        title,
        icon,
        place: "right",
        show: () => tabs.open(id),
    })),
    { id: "plots", title: "Plots", icon: "plot", place: "dock", show: () => dock.open() },
]);

stage.overlays.add(mark.group);
const marks = pictureLayers({ stage, state, labels, colouring, scene });
const loop = new FrameLoop({
    stage,
    state,
    run,
    views,
    director,
    pointer,
    times,
    hurried: () => hurried,
    interval_ms: quality === "low" ? LOW_INTERVAL_MS : 0,
    flowing: () => marks.flows.any,
    effort: quality === "auto" ? new Effort((level) => stage.lower(level)) : null,
    layers: [...marks.layers, () => labels.update()],
});

function togglePanel(side: "left" | "right"): void {
    if (sheets.isNarrow()) return sheets.toggle(side === "left" ? "robots" : "inspector");
    document.body.classList.toggle(`no-${side}`);
}

const copyLink = () => void copyViewLink(state, views, plotted.words()).then((words) => said.say(words));

const actions = new Actions(),
    help = helpCard(actions),
    palette = new Palette(actions);
actions.add(
    ...pageActions({
        state,
        director,
        capture,
        time,
        findRobot: () => {
            sheets.show("robots");
            list.search.focus();
        },
        togglePanel,
        copyLink,
        help: () => help.open(),
        palette: () => palette.open(),
        openSheet: (id) => sheets.show(id),
    }),
);
actions.add(...scene.actions());
actions.addSource(() => robotActions({ state, director }));
actions.add(...viewActions(director));
actions.listen();

const top = topBar(state, capture, desk.element, {
    copyLink,
    help: () => help.open(),
    palette: () => palette.open(),
    home: () => director.home(),
    focus: () => director.focusSelected(),
    togglePanel,
});
document.body.prepend(top.element, top.menu);
const over = overPicture({
    messages: [runBanner(state, run), desk.question],
    bar: viewBar(state, views, director),
    left: [...scene.bars(), legend(state)],
});
labels.avoid(over);
view.append(hand.frame, scene.dialogOver(view));
view.append(viewFrames(state, views), labels.element, over, cameras.over, said.element);
document.body.append(
    sheets.head,
    list.element,
    tabs.element,
    dock.element,
    time.element,
    sheets.bar,
    help.element,
    palette.element,
);
firstHints(address, view, tabs.element);
if (address.get("hide") === "panels") document.body.classList.add("bare");

state.theme.follow((theme, before) => {
    document.documentElement.dataset.theme = theme;
    stage.paint(theme);
    if (theme !== before) keepTheme(theme);
});
let named: number | null = null;
state.world.follow((world: World | null) => {
    stage.show(world);
    if (world === null) return;
    document.title = `${world.fleet.scene.world} · RoBOSS`;
    named = address.get("panel") === null ? null : (world.fleet.find(address.get("select") ?? "") ?? null);
    if (state.selected.value === null) state.selected.set(world.fleet.find(address.get("select") ?? "") ?? null);
    if (state.overlays.value.has("collisions")) stage.showCollisions(world, true);
});
state.overlays.follow(
    (on) => state.world.value !== null && stage.showCollisions(state.world.value, on.has("collisions")),
);
// A robot that is chosen is shown; the one that the address names leaves the panel that it names, too.
state.selected.follow((robot) => robot !== null && robot !== named && sheets.reveal("inspector"));
state.scenery.follow((model) => model !== null && sheets.reveal("inspector"));
if (address.get("panel") !== null) sheets.show(address.get("panel") as string);
loop.wakeAt(...state.shows, views.count, views.active, ...scene.shows);
state.attaching.follow((attaching) => document.body.classList.toggle("attaching", attaching !== null));
for (const name of ["pointerdown", "pointermove", "keydown", "resize"])
    window.addEventListener(name, () => loop.wake());
applyAddress(address, state);

// For tests, pictures and measurements; the page itself never reads it.
const hooks = {
    state,
    views,
    director,
    times,
    stage,
    run,
    scene,
    far: marks.far,
    /** What a picture of the page still misses, in words; empty: nothing. */
    waits: () =>
        waitsOf(state, {
            drawn: document.body.dataset.ready === "true",
            veiled: document.body.classList.contains("gone"),
            arrived: views.arrived,
            panel: address.get("panel"),
        }),
    /** The robot that a click at this place of the window would meet; null: none. */
    robotAt: (left: number, top: number) => scene.robotAt(left, top),
};
export type Hooks = typeof hooks; // `window.roboss`
Object.assign(window, { roboss: hooks });
window.addEventListener("hashchange", () => location.reload());
new ViewKeeper(views, state, () => plotted.words()).start();
run.open();
loop.start();
