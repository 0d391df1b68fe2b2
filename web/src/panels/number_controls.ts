// The section "Numbers" of a robot: damping, limits and gains of a joint axis, mass and friction of a link, or gravity and
// wind, as a person chooses, as fields. What differs from the file is marked, with the file's number beside it. The run is
// asked for them only while the section is open.
import type { Editing } from "../model/editing";
import {
    type NamedPlace,
    numberOf,
    numbersAction,
    numberText,
    ownAt,
    ownCount,
    type Place,
    placesOf,
    samePlace,
    withPartners,
} from "../model/numbers";
import { surroundingsRows } from "../model/surroundings";
import type { ViewerState, World } from "../model/viewer_state";
import { h, setText } from "../ui/dom";
import type { RobotReport } from "../wire/messages";
import type { NumberRow, NumbersReport, NumberValues } from "../wire/numbers";

class NumberField {
    readonly element: HTMLElement;
    readonly input: HTMLInputElement;
    private readonly file = h("span", { class: "of-file" });
    typed = false;

    constructor(
        private row: NumberRow,
        of: string,
        changed: () => void,
    ) {
        this.input = h("input", {
            type: "text",
            inputmode: "decimal",
            spellcheck: "false",
            "aria-label": `${row.name} of ${of}${row.unit === "" ? "" : `, ${row.unit}`}`,
            oninput: () => {
                this.typed = true;
                this.input.setAttribute("aria-invalid", String(this.value === undefined));
                changed();
            },
        });
        this.element = h(
            "div",
            { class: "number-row" },
            h("span", { class: "label", title: row.name }, row.name),
            this.input,
            h("span", { class: "unit" }, row.unit),
            this.file,
        );
    }

    get name(): string {
        return this.row.name;
    }

    /** undefined: what the field says is no number. */
    get value(): number | null | undefined {
        return numberOf(this.input.value, this.row);
    }

    /** Until a hand changes it, the field says what the robot has. */
    show(row: NumberRow): void {
        this.row = row;
        const differs = row.file !== undefined;
        this.element.classList.toggle("own", differs);
        setText(this.file, row.file === undefined ? "" : `file: ${numberText({ name: row.name, value: row.file })}`);
        const text = numberText(row);
        if (!this.typed && this.input.value !== text) this.input.value = text;
    }

    forget(): void {
        this.typed = false;
        this.input.removeAttribute("aria-invalid");
        this.show(this.row);
    }
}

export class NumberControls {
    readonly element: HTMLDetailsElement;
    private readonly title = h("summary", {}, "Numbers");
    private readonly choice: HTMLSelectElement;
    private readonly table = h("div", { class: "numbers" });
    private readonly fault = h("p", { class: "fault", role: "status" });
    private readonly give: HTMLButtonElement;
    private readonly giveBack: HTMLButtonElement;
    private readonly places: NamedPlace[];
    private fields: NumberField[] = [];
    private told: { place: Place; numbers: NumberRow[] } | null = null;

    constructor(
        private readonly robot: number,
        private readonly world: World,
        private readonly state: ViewerState,
        private readonly editing: Editing,
    ) {
        this.places = placesOf(world.fleet.type(robot));
        const group = (label: string, kind: NamedPlace["kind"]) => {
            const options = this.places
                .map(({ name, kind }, k) => ({ option: h("option", { value: k }, name), kind }))
                .filter((one) => one.kind === kind);
            return options.length === 0 ? null : h("optgroup", { label }, ...options.map(({ option }) => option));
        };
        this.choice = h(
            "select",
            { "aria-label": "Which numbers are shown", onchange: () => this.wish() },
            group("Robot", "robot"),
            group("Joints", "joint"),
            group("Links", "link"),
        );
        this.give = h("button", { type: "button", class: "small", onclick: () => void this.send(false) }, "Set");
        this.giveBack = h(
            "button",
            { type: "button", class: "small", onclick: () => void this.send(true) },
            "As in the file",
        );
        this.element = h(
            "details",
            { class: "section", ontoggle: () => this.wish() },
            this.title,
            h("div", { class: "number-choice" }, this.choice),
            this.table,
            h("div", { class: "command-buttons" }, this.fault, this.giveBack, this.give),
        );
        this.table.addEventListener("keydown", (event) => this.key(event));
        this.permit();
    }

    private get chosen(): NamedPlace {
        return this.places[Number(this.choice.value)];
    }

    /** Asks the run for the numbers that are looked at. Gravity and wind come with each report of the robot. */
    private wish(): void {
        this.told = null;
        this.fields = [];
        this.table.replaceChildren();
        this.edited();
        const { place } = this.chosen,
            asks = this.element.open && place !== "surroundings",
            report = this.state.report.value;
        this.state.wantsNumbers.set(asks ? { robot: this.robot, ...place } : null);
        if (report?.robot === this.robot) this.showSurroundings(report);
    }

    private key(event: KeyboardEvent): void {
        if (event.key === "Escape") this.forget();
        else if (event.key === "Enter") void this.send(false);
        else return;
        event.stopPropagation();
    }

    private forget(): void {
        for (const field of this.fields) field.forget();
        this.edited();
    }

    /** A page that may only look changes nothing. */
    permit(): void {
        const looks = this.state.roles.value?.role === "watch";
        for (const { input } of this.fields) input.readOnly = looks;
        this.give.hidden = this.giveBack.hidden = looks;
        this.mark();
    }

    private edited(): void {
        setText(this.fault, "");
        this.mark();
    }

    private mark(): void {
        const typed = this.fields.filter((field) => field.typed),
            wrong = typed.filter((field) => field.value === undefined);
        if (wrong.length > 0) setText(this.fault, `Not a number: ${wrong.map(({ name }) => name).join(", ")}.`);
        this.give.disabled = typed.length === 0 || wrong.length > 0;
        this.giveBack.disabled = this.told?.numbers.every((row) => row.file === undefined) ?? true;
    }

    private async send(reset: boolean): Promise<void> {
        const told = this.told,
            typed = this.fields.filter((field) => field.typed);
        if (told === null || this.give.hidden || (reset ? this.giveBack : this.give).disabled) return;
        const values: NumberValues = {};
        if (!reset) for (const field of typed) values[field.name] = field.value ?? null;
        const report = this.state.report.value,
            { place, name, kind } = this.chosen,
            before = report?.robot === this.robot ? ownAt(report.own, place) : {};
        const answer = await this.editing.order(
            this.robot,
            kind === "robot" ? name : `numbers of ${name}`,
            numbersAction(place, withPartners(values, told.numbers), reset),
            numbersAction(place, withPartners(before, told.numbers), true),
        );
        if (this.told === null || !samePlace(this.told.place, place)) return;
        if (answer.done) this.forget();
        else setText(this.fault, answer.text);
    }

    /** All numbers of the axis or link that is looked at. */
    take(report: NumbersReport): void {
        if (report.robot === this.robot && this.element.open && samePlace(report, this.chosen.place))
            this.fill(this.chosen, report.numbers);
    }

    private showSurroundings({ own }: RobotReport): void {
        if (this.element.open && this.chosen.place === "surroundings")
            this.fill(this.chosen, surroundingsRows(own, this.world.fleet.scene));
    }

    private fill({ place, name, kind }: NamedPlace, numbers: NumberRow[]): void {
        const names = numbers.map((row) => row.name).join();
        if (this.told === null || this.fields.map((field) => field.name).join() !== names) {
            const of = kind === "robot" ? this.world.fleet.name(this.robot) : name;
            this.fields = numbers.map((row) => new NumberField(row, of, () => this.edited()));
            this.table.replaceChildren(...this.fields.map((field) => field.element));
            if (this.fields.length === 0)
                this.table.append(h("p", { class: "empty" }, "It has no mass and touches nothing."));
        }
        this.told = { place, numbers };
        numbers.forEach((row, k) => this.fields[k].show(row));
        this.permit();
    }

    /** Marks what has own numbers. */
    show(report: RobotReport): void {
        this.showSurroundings(report);
        const count = ownCount(report.own);
        setText(this.title, count === 0 ? "Numbers" : `Numbers (${count} own)`);
        for (const option of this.choice.options) {
            const { name, place } = this.places[Number(option.value)],
                text = Object.keys(ownAt(report.own, place)).length > 0 ? `${name} •` : name;
            if (option.text !== text) option.text = text;
        }
    }
}
