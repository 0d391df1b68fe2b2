// The panel at the right: tabs, of which one is seen. Arrow keys go from tab to tab, as WAI-ARIA has it.
import { h } from "../ui/dom";
import type { IconName } from "../ui/icons";

export interface Tab {
    id: string;
    title: string;
    icon: IconName;
    content: HTMLElement;
}

export interface SideTabs {
    element: HTMLElement;
    open(id: string): void;
}

export function sideTabs(tabs: readonly Tab[]): SideTabs {
    const buttons = tabs.map((tab, k) =>
        h(
            "button",
            {
                type: "button",
                role: "tab",
                id: `tab-${tab.id}`,
                "aria-controls": `panel-${tab.id}`,
                onclick: () => open(k),
                onkeydown: (event: KeyboardEvent) => {
                    const move = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
                    if (move === 0) return;
                    const next = (k + move + tabs.length) % tabs.length;
                    open(next);
                    buttons[next].focus();
                    event.stopPropagation();
                },
            },
            tab.title,
        ),
    );
    const panels = tabs.map((tab) =>
        h(
            "div",
            {
                role: "tabpanel",
                id: `panel-${tab.id}`,
                class: "tab-panel",
                tabindex: 0,
                "aria-labelledby": `tab-${tab.id}`,
            },
            tab.content,
        ),
    );
    const open = (k: number) => {
        buttons.forEach((button, of) => {
            button.setAttribute("aria-selected", String(of === k));
            button.tabIndex = of === k ? 0 : -1;
        });
        panels.forEach((panel, of) => (panel.hidden = of !== k));
    };
    open(0);
    return {
        element: h(
            "aside",
            { class: "panel right", "aria-label": "Details" },
            h("div", { class: "tabs", role: "tablist", "aria-label": "Details" }, ...buttons),
            ...panels,
        ),
        open: (id) => {
            const k = tabs.findIndex((tab) => tab.id === id);
            if (k >= 0) open(k);
        },
    };
}
