// The inspector of the selected robot: where it is and how it moves, its commands, joints and motors with their controls,
// sensors, bonds and contacts. Rows are made once a robot; each report changes only their numbers.
import type { Plotted } from "../model/plotted";
import { readings } from "../model/readings";
import type { Editing } from "../model/editing";
import type { Placing } from "../model/placing";
import type { RunLink } from "../model/run_link";
import type { ViewerState, World } from "../model/viewer_state";
import { h } from "../ui/dom";
import { fixed } from "../ui/numbers";
import type { RobotReport } from "../wire/messages";
import type { SurfaceMotion } from "../wire/onboard";
import { BondControls } from "./bond_controls";
import { ChannelControls } from "./channel_controls";
import { JointControls } from "./joint_controls";
import { NumberControls } from "./number_controls";
import { PoseFields } from "./pose_fields";
import { ReadingRows } from "./reading_rows";
import { SensorViews } from "./sensor_views";
import { velocityPad } from "./velocity_pad";

function section(title: string, ...content: (Node | null)[]): HTMLDetailsElement {
    return h("details", { class: "section", open: true }, h("summary", {}, title), ...content);
}

/** "0.50 m/s", "2.00 rad/s": how a surface moves. */
function motionText({ linear, angular, belt }: SurfaceMotion): string {
    const parts: string[] = [],
        speed = Math.hypot(...linear) + Math.hypot(...(belt ?? [0, 0, 0])),
        turn = Math.hypot(...angular);
    if (speed > 0) parts.push(`${fixed(speed, 2)} m/s`);
    if (turn > 0) parts.push(`${fixed(turn, 2)} rad/s`);
    return parts.join(", ");
}

/** Of the base's readings: the fields show them. */
const POSE_NUMBERS = 6;

export class Inspector {
    readonly element = h("div", { class: "inspector" });
    private rows: ReadingRows | null = null;
    private pose: PoseFields | null = null;
    private joints: JointControls | null = null;
    private sensors: SensorViews | null = null;
    private channels: ChannelControls | null = null;
    private bonds: BondControls | null = null;
    private numbers: NumberControls | null = null;
    private surfaces: HTMLDetailsElement | null = null;
    private bondSection: HTMLDetailsElement | null = null;
    private contacts: HTMLElement | null = null;
    private built = false;

    constructor(
        private readonly state: ViewerState,
        private readonly run: RunLink,
        private readonly plotted: Plotted,
        private readonly hands: { editing: Editing; placing: Placing },
        private readonly follow: (robot: number) => void,
    ) {
        state.selected.follow(() => this.reset());
        state.world.follow(() => this.reset());
        for (const signal of [state.selected, state.scenery] as { follow(call: () => void): unknown }[])
            signal.follow(() => (this.element.hidden = state.selected.value === null && state.scenery.value !== null));
        state.report.follow((report) => report !== null && this.show(report));
        state.numbers.follow((numbers) => numbers !== null && this.numbers?.take(numbers));
        state.roles.follow(() => this.numbers?.permit());
        plotted.curves.follow(() => this.rows?.mark());
    }

    private reset(): void {
        const world = this.state.world.value,
            robot = this.state.selected.value;
        this.built = false;
        this.rows = this.joints = this.sensors = this.contacts = null;
        this.channels = this.bonds = this.surfaces = this.bondSection = null;
        this.pose = this.numbers = null;
        this.state.wantsNumbers.set(null);
        if (world === null || robot === null) {
            this.element.replaceChildren(
                h("p", { class: "empty" }, "Select a robot: click it in the picture, or in the list."),
            );
            return;
        }
        this.element.replaceChildren(this.head(world, robot));
        this.fill(h("p", { class: "empty" }, "Waiting for its report…"));
        const last = this.state.report.value;
        if (last !== null && last.robot === robot && this.state.link.value.state === "open") this.show(last);
    }

    /** Replaces what is below the head, which stays: a click on it may be on its way. */
    private fill(...content: Node[]): void {
        while (this.element.childElementCount > 1) this.element.lastElementChild?.remove();
        this.element.append(...content);
    }

    private head(world: World, robot: number): HTMLElement {
        const type = world.fleet.type(robot);
        return h(
            "div",
            { class: "robot-head" },
            h("h3", {}, world.fleet.name(robot)),
            h(
                "span",
                { class: "facts" },
                [
                    // Often a type is called after its first robot.
                    world.fleet.find(type.name) === undefined ? type.name : "",
                    `${fixed(type.mass, 2)} kg`,
                    type.free_base ? "free base" : "fixed base",
                ]
                    .filter((word) => word !== "")
                    .join("  ·  "),
            ),
            h("button", { type: "button", class: "small", onclick: () => this.follow(robot) }, "Follow"),
        );
    }

    private build(world: World, robot: number, report: RobotReport): void {
        const type = world.fleet.type(robot),
            all = readings(type, report),
            rows = new ReadingRows(robot, this.plotted);
        this.rows = rows;
        const [own, rest] = [all.base.slice(0, POSE_NUMBERS), all.base.slice(POSE_NUMBERS)],
            plots = own.map((reading) => rows.button(reading));
        this.pose = new PoseFields(robot, this.hands.editing, this.hands.placing, plots);
        this.joints = new JointControls(robot, type, this.run, rows, all.joints);
        this.sensors = new SensorViews(type, rows, all.sensors);
        this.channels = new ChannelControls(robot, type, world.fleet.scene.dt, this.run);
        this.bonds = new BondControls(robot, world, this.state, this.run);
        this.numbers = new NumberControls(robot, world, this.state, this.hands.editing);
        this.bondSection = section("Bonds", this.bonds.element);
        this.bondSection.open = false;
        this.surfaces = section("Moving surfaces", h("div", { class: "surfaces" }));
        this.contacts = h("div", { class: "contacts" });
        this.fill(
            section(
                "Pose and velocity",
                this.pose.element,
                h("div", { class: "readings two" }, ...rest.map((reading) => rows.row(reading))),
            ),
            type.free_base
                ? section("Drive by hand", velocityPad(this.run, this.state, robot))
                : h("span", { hidden: true }),
            (type.channels?.length ?? 0) > 0
                ? section(`Commands (${type.channels?.length})`, this.channels.element)
                : h("span", { hidden: true }),
            this.surfaces,
            type.joints.length > 0
                ? section(`Joints (${type.joints.length})`, this.joints.element)
                : h("span", { hidden: true }),
            type.static === true || type.links.length === 0 ? h("span", { hidden: true }) : this.numbers.element,
            type.sensors.length > 0
                ? section(`Sensors (${type.sensors.length})`, this.sensors.element)
                : h("span", { hidden: true }),
            this.bondSection,
            section("Contacts", this.contacts),
        );
        this.built = true;
    }

    private show(report: RobotReport): void {
        const world = this.state.world.value;
        if (world === null || report.robot !== this.state.selected.value) return;
        if (!this.built) this.build(world, report.robot, report);
        const all = readings(world.fleet.type(report.robot), report);
        this.rows?.show([...all.base, ...all.joints, ...all.sensors.flat()]);
        this.pose?.show(report);
        this.joints?.show(report);
        this.sensors?.show(report);
        this.channels?.show(report);
        this.numbers?.show(report);
        if (this.bonds?.show(report) === true && this.bondSection !== null) this.bondSection.open = true;
        this.showSurfaces(world, report);
        this.showContacts(world, report);
    }

    private showSurfaces(world: World, report: RobotReport): void {
        const links = world.fleet.type(report.robot).links,
            moving = report.surfaces ?? [];
        if (this.surfaces === null) return;
        this.surfaces.hidden = moving.length === 0;
        this.surfaces.lastElementChild?.replaceChildren(
            ...moving.map((surface) =>
                h(
                    "div",
                    { class: "reading" },
                    h("span", { class: "label" }, links[surface.link]?.name ?? ""),
                    h("span", { class: "value" }, motionText(surface)),
                ),
            ),
        );
    }

    private showContacts(world: World, report: RobotReport): void {
        const byOther = new Map<number, { count: number; force: number }>();
        for (const contact of report.contacts) {
            const sum = byOther.get(contact.other) ?? { count: 0, force: 0 };
            sum.count += 1;
            sum.force += contact.normal_force;
            byOther.set(contact.other, sum);
        }
        const lines = [...byOther]
            .sort((a, b) => b[1].force - a[1].force)
            .map(([other, { count, force }]) =>
                h(
                    "div",
                    { class: "reading" },
                    h("span", { class: "label" }, other < 0 ? "scenery" : world.fleet.name(other)),
                    h("span", { class: "value" }, fixed(force, 1)),
                    h("span", { class: "unit" }, "N"),
                    h("span", { class: "count" }, `${count} ${count === 1 ? "point" : "points"}`),
                ),
            );
        const nothing =
            report.all_contacts === false
                ? "Touches no scenery and no robot listed after it. Contact forces (View) show all."
                : "Touches nothing.";
        this.contacts?.replaceChildren(...(lines.length > 0 ? lines : [h("p", { class: "empty" }, nothing)]));
    }
}
