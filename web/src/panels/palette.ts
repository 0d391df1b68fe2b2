// The command palette: every action of the page, and every robot by name, found by a few letters. A combobox with a list
// box, as WAI-ARIA has it; by touch it is a list.
import { type Action, type Actions, keyText } from "../model/actions";
import { beginsWords, fuzzyBest } from "../model/fuzzy";
import { h, icon } from "../ui/dom";

const SHOWN_MAX = 60;

export class Palette {
    readonly element: HTMLDialogElement;
    private readonly input: HTMLInputElement;
    private readonly list = h("ul", {
        class: "palette-list",
        role: "listbox",
        id: "palette-list",
        "aria-label": "Commands",
    });
    private readonly nothing = h("p", { class: "empty", hidden: true }, "Nothing is called like that.");
    private all: Action[] = [];
    private found: Action[] = [];
    private active = 0;

    constructor(private readonly actions: Actions) {
        this.input = h("input", {
            type: "search",
            role: "combobox",
            placeholder: "Commands, views, robots …",
            "aria-label": "Find a command or a robot",
            "aria-controls": "palette-list",
            "aria-expanded": "true",
            "aria-autocomplete": "list",
            autocomplete: "off",
            spellcheck: "false",
            oninput: () => this.search(),
            onkeydown: (event: KeyboardEvent) => this.key(event),
        });
        this.element = h(
            "dialog",
            {
                class: "palette",
                "aria-label": "Commands",
                onclick: (event: MouseEvent) => event.target === this.element && this.element.close(),
            },
            h("div", { class: "search" }, icon("search"), this.input),
            this.list,
            this.nothing,
        );
    }

    open(): void {
        this.all = this.actions.found().filter((action) => action.enabled?.() !== false);
        this.input.value = "";
        this.search();
        this.element.showModal();
        this.input.focus();
    }

    private search(): void {
        const words = (action: Action) => `${action.title} ${action.group} ${action.words ?? ""}`;
        const query = this.input.value,
            meant = this.all.filter((action) => action.destructive !== true || beginsWords(query, words(action)));
        this.found = fuzzyBest(query, meant, words, SHOWN_MAX);
        this.active = 0;
        this.list.replaceChildren(...this.found.map((action, k) => this.row(action, k)));
        this.nothing.hidden = this.found.length > 0;
        this.mark();
    }

    private row(action: Action, k: number): HTMLElement {
        const on = action.on?.() === true,
            key = action.keys?.[0];
        return h(
            "li",
            {
                id: `palette-${k}`,
                role: "option",
                class: on ? "on" : "",
                onclick: () => this.run(k),
                onpointermove: () => k !== this.active && this.go(k),
            },
            action.icon === undefined ? h("span", { class: "icon" }) : icon(action.icon),
            h("span", { class: "palette-title", title: action.title }, action.title),
            h("span", { class: "palette-group" }, on ? `${action.group} · on` : action.group),
            key === undefined ? h("span", {}) : h("kbd", {}, keyText(key)),
        );
    }

    private go(k: number): void {
        this.active = Math.max(0, Math.min(this.found.length - 1, k));
        this.mark();
    }

    private mark(): void {
        [...this.list.children].forEach((row, k) => row.setAttribute("aria-selected", String(k === this.active)));
        this.input.setAttribute("aria-activedescendant", this.found.length > 0 ? `palette-${this.active}` : "");
        this.list.children[this.active]?.scrollIntoView({ block: "nearest" });
    }

    private key(event: KeyboardEvent): void {
        const by = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 }[event.key];
        if (by !== undefined) this.go(this.active + by);
        else if (event.key === "Enter") this.run(this.active);
        else if (event.key === "Escape") this.element.close();
        else return;
        event.preventDefault();
        event.stopPropagation();
    }

    private run(k: number): void {
        const action = this.found[k];
        if (action === undefined) return;
        this.element.close();
        action.run();
    }
}
