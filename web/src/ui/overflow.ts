// A bar whose less important parts move into a menu ("More") where they do not fit. Parts say how soon they yield:
// data-yields="3" before data-yields="2"; parts without the attribute stay. Where even words beside icons do not fit, these
// go first (class "tight").
import { h, icon } from "./dom";
import type { IconName } from "./icons";

export interface More {
    /** The button; it belongs at the end of the bar. */
    button: HTMLButtonElement;
    menu: HTMLElement;
    /** Measures again. */
    fit(): void;
    close(): void;
}

interface Part {
    element: HTMLElement;
    /** Stands where the part was. */
    place: Comment;
    yields: number;
}

/** Moves parts of `bar` into a menu until it fits. `up`: the menu opens upwards. */
export function moreMenu(bar: HTMLElement, label: string, up: boolean, name: IconName = "more"): More {
    const menu = h("div", {
        class: up ? "more-menu up" : "more-menu",
        role: "group",
        "aria-label": label,
        hidden: true,
    });
    const button = h(
        "button",
        { type: "button", class: "icon-button more", "aria-label": label, title: label, "aria-expanded": "false" },
        icon(name),
    );
    const parts: Part[] = [...bar.querySelectorAll<HTMLElement>("[data-yields]")]
        .map((element) => ({ element, place: document.createComment(""), yields: Number(element.dataset.yields) }))
        .sort((a, b) => b.yields - a.yields);
    for (const part of parts) part.element.before(part.place);
    const show = (open: boolean) => {
        menu.hidden = !open;
        button.setAttribute("aria-expanded", String(open));
    };
    button.addEventListener("click", () => show(menu.hidden));
    // As in other menus; the bar of time is pressed again and again.
    menu.addEventListener("click", (event) => {
        if (!up && (event.target as HTMLElement).closest("button") !== null) show(false);
    });
    menu.addEventListener("keydown", (event) => {
        if (event.key !== "Escape") return;
        show(false);
        button.focus();
        event.stopPropagation();
    });
    document.addEventListener("pointerdown", (event) => {
        const target = event.target as Node;
        if (!menu.hidden && !menu.contains(target) && !button.contains(target)) show(false);
    });
    const over = () => bar.scrollWidth > bar.clientWidth + 1;
    let width = -1;
    const fit = () => {
        width = bar.clientWidth;
        for (const part of parts) if (part.element.parentElement === menu) part.place.after(part.element);
        button.hidden = true;
        bar.classList.remove("tight");
        if (width === 0 || !over()) return show(false);
        bar.classList.add("tight");
        let out: Part[] = [];
        for (const part of parts) {
            if (!over()) break;
            button.hidden = false;
            if (part.element.hidden) continue;
            menu.append(part.element);
            out = [...out, part];
        }
        // In the menu they stand in the order of the bar.
        const order = [...out].sort((a, b) =>
            (a.place.compareDocumentPosition(b.place) & Node.DOCUMENT_POSITION_FOLLOWING) !== 0 ? -1 : 1,
        );
        menu.append(...order.map((part) => part.element));
        if (out.length === 0) show(false);
    };
    new ResizeObserver(() => bar.clientWidth !== width && fit()).observe(bar);
    return { button, menu, fit, close: () => show(false) };
}
