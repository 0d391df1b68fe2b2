// Elements in one expression: h("button", { class: "icon", onclick: go }, "Go"). Attributes are attributes, functions are
// listeners, `text` and children are what they say.
import { ICONS, type IconName } from "./icons";

type Child = Node | string | null;
type Attributes = Record<string, string | number | boolean | null | ((event: never) => void)>;

export function h<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    attributes: Attributes = {},
    ...children: Child[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
        else if (value === true) element.setAttribute(name, "");
        else if (value !== false && value !== null) element.setAttribute(name, String(value));
    }
    for (const child of children) if (child !== null) element.append(child);
    return element;
}

const SVG = "http://www.w3.org/2000/svg";

export function icon(name: IconName): SVGSVGElement {
    const svg = document.createElementNS(SVG, "svg");
    svg.setAttribute("viewBox", "0 0 16 16");
    svg.setAttribute("aria-hidden", "true");
    svg.setAttribute("class", "icon");
    for (const [d, filled] of ICONS[name]) {
        const path = document.createElementNS(SVG, "path");
        path.setAttribute("d", d);
        if (filled) path.setAttribute("class", "filled");
        svg.append(path);
    }
    return svg;
}

/** A button of one icon; its label is read aloud and shown as a tip. `words`: shown beside it where there is room. */
export function iconButton(
    name: IconName,
    label: string,
    onclick: () => void,
    key = "",
    words = "",
): HTMLButtonElement {
    const tip = key === "" ? label : `${label}  (${key})`;
    return h(
        "button",
        {
            type: "button",
            class: words === "" ? "icon-button" : "icon-button worded",
            "aria-label": label,
            title: tip,
            onclick,
        },
        icon(name),
        words === "" ? null : h("span", { class: "button-words", "aria-hidden": "true" }, words),
    );
}

/** One of several buttons that exclude each other. */
export function choice<T extends string>(
    label: string,
    options: readonly { value: T; text: string; icon?: IconName; key?: string; words?: string }[],
    onchoose: (value: T) => void,
): { element: HTMLElement; show: (value: T) => void } {
    const buttons = new Map<T, HTMLButtonElement>();
    const element = h("div", { class: "choice", role: "group", "aria-label": label });
    for (const option of options) {
        const button = h("button", { type: "button", "aria-pressed": "false", onclick: () => onchoose(option.value) });
        if (option.icon !== undefined) {
            button.append(icon(option.icon));
            button.setAttribute("aria-label", option.text);
            if (option.words !== undefined)
                button.append(h("span", { class: "button-words", "aria-hidden": "true" }, option.words));
        } else button.append(option.text);
        button.title = option.key === undefined ? option.text : `${option.text}  (${option.key})`;
        buttons.set(option.value, button);
        element.append(button);
    }
    return {
        element,
        show: (value) => buttons.forEach((button, of) => button.setAttribute("aria-pressed", String(of === value))),
    };
}

const TAIL_LETTERS = 7;

/** A name that is cut inside where it has no room: names of many robots differ at their ends. */
export function cutInside(name: string): HTMLElement[] {
    const at = Math.max(0, name.length - TAIL_LETTERS);
    return [h("span", { class: "name-head" }, name.slice(0, at)), h("span", { class: "name-tail" }, name.slice(at))];
}

/** Changes a text only where it differs, so that nothing is laid out again for nothing. */
export function setText(element: Element, text: string): void {
    if (element.textContent !== text) element.textContent = text;
}
