// The cluster: its Simulators with load and step time, how well the work is shared, and the two buttons that show what
// it is for: kill one, add one, and watch the run go on.
import uPlot from "uplot";
import type { RunLink } from "../model/run_link";
import type { ViewerState } from "../model/viewer_state";
import { confirmed } from "../ui/confirm";
import { cutInside, h, setText } from "../ui/dom";
import { byteRate, fixed, percent, short } from "../ui/numbers";
import type { MemberStatus, MessageRate, Status } from "../wire/messages";
import { groupCss } from "../view/palette";
import { plotAxes } from "./plot_chart";
import { runButtons } from "./run_buttons";
import { stepProfile } from "./step_profile";

const KEPT = 240;
const LOST_SHOWN_MS = 20_000;
const PLOT_HEIGHT = 132;

/** Lost and left ones stay listed, but do nothing. */
function present(member: MemberStatus): boolean {
    return member.state !== "lost" && member.state !== "left";
}

/** Both ways; none within a process, where nothing is encoded. */
function bytesOf(rate: MessageRate | undefined, write: (bytes: number) => string): string {
    const bytes = rate === undefined ? 0 : rate.bytes_in + rate.bytes_out;
    return bytes > 0 ? write(bytes) : "–";
}

function told(rate: MessageRate | undefined): string {
    if (rate === undefined) return "";
    const way = (count: number, bytes: number) => `${short(count)} messages/s (${byteRate(bytes)})`;
    return `${way(rate.in, rate.bytes_in)} to the Controller, ${way(rate.out, rate.bytes_out)} from it`;
}

/** Step time of each member over wall time, as one aligned table; members come and go. */
export class StepTimes {
    readonly times: number[] = [];
    readonly columns = new Map<number, (number | null)[]>();

    take(now: number, members: readonly MemberStatus[]): void {
        for (const member of members)
            if (!this.columns.has(member.id))
                this.columns.set(member.id, new Array<null>(this.times.length).fill(null));
        this.times.push(now);
        for (const [id, column] of this.columns)
            column.push(members.find((member) => member.id === id && present(member))?.step_us ?? null);
        if (this.times.length <= KEPT) return;
        this.times.shift();
        for (const [id, column] of this.columns) {
            column.shift();
            if (column.every((value) => value === null)) this.columns.delete(id);
        }
    }
}

export class ClusterPanel {
    readonly element: HTMLElement;
    private readonly facts = new Map<string, HTMLElement>();
    private readonly table = h("tbody");
    private readonly rows = new Map<number, ReturnType<ClusterPanel["addRow"]>>();
    private readonly history = new StepTimes();
    private readonly noKill = h(
        "p",
        { class: "hint", hidden: true },
        "To kill Simulators and watch the run recover, start it with --processes N.",
    );
    private readonly plotHost = h("div", { class: "chart-canvas" });
    private plot: uPlot | null = null;
    private plotted = "";
    private readonly began = performance.now();
    private readonly lastPresent = new Map<number, number>();

    constructor(
        state: ViewerState,
        private readonly run: RunLink,
    ) {
        const fact = (name: string, title: string, kind = "fact") => {
            const value = h("span", { class: "fact-value" }, "–");
            this.facts.set(name, value);
            return h("div", { class: kind, title }, h("span", { class: "fact-name" }, name), value);
        };
        const add = h("button", { type: "button", class: "small", onclick: () => void this.add() }, "Add a Simulator");
        this.element = h(
            "div",
            { class: "cluster" },
            h(
                "div",
                { class: "facts-grid" },
                fact("Simulators", "Members that step robots"),
                fact("Efficiency", "Of the time of one Simulator, shared by all"),
                fact("Islands", "Groups of robots that may touch"),
                fact("Window", "Ticks that Simulators step without talking"),
                fact("Repeated", "Windows stepped again because a forecast was too small"),
                fact("Migrations", "Robots handed from one Simulator to another"),
                fact("Losses", "Simulators lost and replaced"),
                fact("Recovered", "Times that lost robots were stepped again from a checkpoint"),
                fact("Messages", "A second, to and from the Controller", "fact wide"),
                fact("Traffic", "To and from the Controller; nothing is encoded within a process", "fact wide"),
            ),
            runButtons(state, run),
            h("div", { class: "panel-head sub" }, h("h3", {}, "Members"), h("div", { class: "grow" }), add),
            h(
                "div",
                { class: "table-scroll", tabindex: 0, role: "region", "aria-label": "Members" },
                h(
                    "table",
                    { class: "members" },
                    h(
                        "thead",
                        {},
                        h(
                            "tr",
                            {},
                            ...["Member", "Robots", "Islands", "Load", "µs", "kB/s", ""].map((name) =>
                                name === "" ? h("td", {}) : h("th", { scope: "col" }, name),
                            ),
                        ),
                    ),
                    this.table,
                ),
            ),
            this.noKill,
            h("div", { class: "panel-head sub" }, h("h3", {}, "Step time"), h("span", { class: "facts" }, "µs a tick")),
            this.plotHost,
            stepProfile(state),
        );
        state.status.follow((status) => status !== null && this.show(status));
        state.theme.follow(() => this.dropPlot());
    }

    private async add(): Promise<void> {
        const answer = await this.run.control("simulators", "add");
        if (answer.done) this.run.notice.set({ text: answer.text, bad: false });
    }

    private async kill(id: number): Promise<void> {
        if (!(await confirmed(`Kill Simulator ${id}? The others take over its robots.`, "Kill"))) return;
        const answer = await this.run.control("simulators", "kill", String(id));
        if (answer.done) this.run.notice.set({ text: answer.text, bad: false });
    }

    private show(status: Status): void {
        const say = (name: string, text: string) => setText(this.facts.get(name) as HTMLElement, text);
        say("Simulators", String(status.simulators));
        say("Efficiency", percent(status.efficiency));
        say("Islands", short(status.islands));
        say("Window", status.window_ticks === undefined ? "–" : short(status.window_ticks));
        say("Repeated", short(status.windows_repeated));
        say("Migrations", short(status.migrations));
        say("Losses", short(status.losses));
        say("Recovered", short(status.recoveries));
        const { messages } = status;
        say("Messages", messages === undefined ? "–" : `${short(messages.in + messages.out)} /s`);
        say("Traffic", bytesOf(messages, byteRate));
        for (const name of ["Messages", "Traffic"])
            (this.facts.get(name)?.parentElement as HTMLElement).title = told(messages) || "To and from the Controller";
        const members = this.worthShowing(status.members ?? []);
        this.showMembers(members);
        this.history.take((performance.now() - this.began) / 1000, members);
        this.showPlot();
    }

    /** A run lists all Simulators that it ever had: here a lost one is seen for a while, one lost before never. */
    private worthShowing(members: readonly MemberStatus[]): MemberStatus[] {
        const now = performance.now();
        for (const member of members) if (present(member)) this.lastPresent.set(member.id, now);
        return members.filter((member) => now - (this.lastPresent.get(member.id) ?? -Infinity) < LOST_SHOWN_MS);
    }

    private showMembers(members: readonly MemberStatus[]): void {
        for (const [id, { row }] of this.rows)
            if (!members.some((member) => member.id === id)) {
                row.remove();
                this.rows.delete(id);
            }
        this.noKill.hidden = members.some((member) => member.own_process === true);
        for (const member of members) {
            const shown = this.rows.get(member.id) ?? this.addRow(member.id);
            const name = member.name === "" ? `Simulator ${member.id}` : member.name;
            if (shown.words.textContent !== name) shown.words.replaceChildren(...cutInside(name));
            const texts = [
                short(member.robots),
                short(member.islands),
                percent(member.load),
                member.step_us > 0 ? fixed(member.step_us, 0) : "–",
                bytesOf(member.messages, (bytes) => fixed(bytes / 1e3, bytes < 1e4 ? 1 : 0)),
            ];
            texts.forEach((text, k) => setText(shown.cells[k], text));
            shown.bar.style.width = `${100 * Math.max(0, Math.min(1, member.load))}%`;
            shown.row.dataset.state = member.state;
            shown.kill.hidden = member.own_process !== true || !present(member);
            const threads = `${member.threads} ${member.threads === 1 ? "thread" : "threads"}`;
            shown.row.title = `${name}: ${member.state}, ${threads}\n${told(member.messages)}`;
        }
    }

    private addRow(id: number) {
        const words = h("span", { class: "member-words" }),
            name = h(
                "div",
                { class: "member-name" },
                h("span", { class: "swatch", style: `background:${groupCss(id)}` }),
                words,
            ),
            cells = Array.from({ length: 5 }, () => h("span", {})),
            bar = h("div", { class: "load-fill" });
        const kill = h(
            "button",
            {
                type: "button",
                class: "small danger",
                "aria-label": `Kill Simulator ${id}`,
                title: "Kill it, and watch the run recover",
                onclick: () => void this.kill(id),
            },
            "Kill",
        );
        const row = h(
            "tr",
            {},
            h("th", { scope: "row" }, name),
            h("td", {}, cells[0]),
            h("td", {}, cells[1]),
            h("td", { class: "load" }, h("div", { class: "load-bar", "aria-hidden": "true" }, bar), cells[2]),
            h("td", {}, cells[3]),
            h("td", {}, cells[4]),
            h("td", {}, kill),
        );
        const made = { row, words, cells, bar, kill };
        this.rows.set(id, made);
        this.table.append(row);
        return made;
    }

    private dropPlot(): void {
        this.plot?.destroy();
        this.plot = null;
        this.plotted = "";
    }

    private showPlot(): void {
        const width = this.plotHost.clientWidth;
        if (width < 40) return;
        const ids = [...this.history.columns.keys()],
            key = ids.join(" ");
        if (this.plot === null || key !== this.plotted) {
            this.dropPlot();
            this.plotted = key;
            this.plot = new uPlot(
                {
                    width,
                    height: PLOT_HEIGHT,
                    legend: { show: false },
                    cursor: { show: false },
                    scales: { x: { time: false } },
                    axes: plotAxes(""),
                    series: [
                        {},
                        ...ids.map((id) => ({
                            label: String(id),
                            stroke: groupCss(id),
                            width: 1.5,
                            points: { show: false },
                        })),
                    ],
                },
                [this.history.times, ...this.history.columns.values()] as uPlot.AlignedData,
                this.plotHost,
            );
            return;
        }
        if (this.plot.width !== width) this.plot.setSize({ width, height: PLOT_HEIGHT });
        this.plot.setData([this.history.times, ...this.history.columns.values()] as uPlot.AlignedData);
    }
}
