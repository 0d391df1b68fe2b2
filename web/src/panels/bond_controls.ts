// What the selected robot holds and what holds it, with the force that the bond carries; to let go, and to take hold of
// another robot.
import { REACH_M } from "../model/bonding";
import type { RunLink } from "../model/run_link";
import type { ViewerState, World } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import { fixed } from "../ui/numbers";
import type { RobotReport } from "../wire/messages";
import type { BondReport } from "../wire/onboard";

/** "12.0 N of 50 N": what a bond carries, and when it lets go. */
export function loadText({ force, max_force }: BondReport): string {
    return `${fixed(force, 1)} N${max_force === null ? "" : ` of ${fixed(max_force, max_force < 10 ? 1 : 0)} N`}`;
}

/** Of what a bond may carry, from 0 to 1; 0 where it never lets go. */
export function loadPart(bond: BondReport): number {
    const part = (value: number | null, most: number | null) =>
        value === null || most === null || most <= 0 ? 0 : value / most;
    return Math.min(1, Math.max(part(bond.force, bond.max_force), part(bond.torque, bond.max_torque)));
}

function named(world: World, robot: number, link: number): string {
    if (robot < 0) return "the scenery";
    const links = world.fleet.type(robot).links;
    return links.length > 1 ? `${world.fleet.name(robot)} at ${links[link]?.name ?? link}` : world.fleet.name(robot);
}

/** One bond: its row stays while it lasts, so that its button can be pressed. */
class BondRow {
    readonly element: HTMLElement;
    private readonly load = h("span", { class: "value" });
    private readonly bar = h("div", { class: "load-bar" });

    constructor(words: string, button: string, release: () => void) {
        this.element = h(
            "div",
            { class: "bond" },
            h("span", { class: "label" }, words),
            this.load,
            h("button", { type: "button", class: "small", onclick: release }, button),
            h("div", { class: "load-track" }, this.bar),
        );
    }

    show(bond: BondReport): void {
        setText(this.load, loadText(bond));
        const part = loadPart(bond);
        this.bar.style.width = `${100 * part}%`;
        this.bar.classList.toggle("high", part > 0.8);
    }
}

export class BondControls {
    readonly element: HTMLElement;
    private readonly list = h("div", {});
    private readonly rows = new Map<string, BondRow>();
    private readonly nothing = h("p", { class: "empty" }, "Holds nothing, and nothing holds it.");
    private readonly button = h("button", { type: "button", class: "small" }, "Attach to…");
    private readonly hint = h("p", { class: "hint", role: "status" });
    private readonly link: HTMLSelectElement;
    private readonly reach = h("input", {
        type: "number",
        min: 0,
        step: "any",
        value: String(REACH_M),
        "aria-label": "Reach in m",
    });
    private readonly force = h("input", {
        type: "number",
        min: 0,
        step: "any",
        placeholder: "∞",
        "aria-label": "Holding force in N",
    });

    constructor(
        private readonly robot: number,
        private readonly world: World,
        private readonly state: ViewerState,
        private readonly run: RunLink,
    ) {
        const links = world.fleet.type(robot).links;
        this.link = h(
            "select",
            { "aria-label": "Link that holds" },
            ...links.map((link, k) => h("option", { value: k }, link.name)),
        );
        this.button.addEventListener("click", () => this.toggle());
        this.element = h(
            "div",
            { class: "bonds" },
            this.list,
            h(
                "div",
                { class: "attach" },
                links.length > 1 ? h("label", {}, "By ", this.link) : null,
                h("label", {}, "Reach ", this.reach, " m"),
                h("label", {}, "Holds ", this.force, " N"),
                this.button,
            ),
            this.hint,
        );
        const end = state.attaching.follow(() => (this.element.isConnected || !this.shown ? this.mark() : end()));
    }

    private shown = false;

    private toggle(): void {
        const waits = this.state.attaching.value !== null,
            reach = this.reach.valueAsNumber,
            force = this.force.valueAsNumber;
        this.state.attaching.set(
            waits
                ? null
                : {
                      holder: this.robot,
                      link: Number(this.link.value || 0),
                      reach: Number.isFinite(reach) ? reach : REACH_M,
                      max_force: Number.isFinite(force) ? force : null,
                  },
        );
    }

    private mark(): void {
        const waits = this.state.attaching.value?.holder === this.robot;
        setText(this.button, waits ? "Cancel" : "Attach to…");
        setText(
            this.hint,
            waits
                ? `Choose the robot that ${this.world.fleet.name(this.robot)} shall hold: in the picture, or in the list.`
                : "",
        );
    }

    /** True: there is a bond that was not there before. */
    show(report: RobotReport): boolean {
        const before = this.rows.size;
        this.shown = true;
        const now = new Set<string>();
        const put = (key: string, words: string, bond: BondReport, holder: number, held: number) => {
            now.add(key);
            let row = this.rows.get(key);
            if (row === undefined) {
                // An order cannot name the scenery: without a name, all bonds are loosed.
                const [button, what] = held < 0 ? ["Release all", {}] : ["Release", { other: held }];
                row = new BondRow(
                    words,
                    button as string,
                    () => void this.run.order(holder, { action: "detach", ...(what as object) }),
                );
                this.rows.set(key, row);
                this.list.append(row.element);
            }
            row.show(bond);
        };
        for (const bond of report.bonds ?? []) {
            const key = `holds ${bond.link} ${bond.other} ${bond.other_link}`;
            put(key, `holds ${named(this.world, bond.other, bond.other_link)}`, bond, this.robot, bond.other);
        }
        for (const bond of report.held_by ?? []) {
            const key = `held ${bond.link} ${bond.other} ${bond.other_link}`;
            put(key, `held by ${named(this.world, bond.other, bond.other_link)}`, bond, bond.other, this.robot);
        }
        for (const [key, row] of [...this.rows]) {
            if (now.has(key)) continue;
            row.element.remove();
            this.rows.delete(key);
        }
        if (now.size === 0) this.list.append(this.nothing);
        else this.nothing.remove();
        return this.rows.size > before;
    }
}
