// Where parts of the page lie in the window, and that none covers or cuts another.
import assert from "node:assert/strict";
import type { Page } from "playwright-core";

export interface Box {
    what: string;
    left: number;
    top: number;
    right: number;
    bottom: number;
}

/** Of what is visible. */
export function boxes(page: Page, selector: string): Promise<Box[]> {
    return page.evaluate(
        (wanted) =>
            [...document.querySelectorAll<HTMLElement>(wanted)]
                .map((element) => ({ element, box: element.getBoundingClientRect() }))
                .filter(({ element, box }) => box.width > 0 && getComputedStyle(element).visibility === "visible")
                .map(({ element, box: { left, top, right, bottom } }) => {
                    const what = `${element.className} "${(element.textContent ?? "").slice(0, 20)}"`;
                    return { what, left, top, right, bottom };
                }),
        selector,
    );
}

export function apart(all: readonly Box[]): void {
    all.forEach((a, k) =>
        all.slice(k + 1).forEach((b) => {
            const across = Math.min(a.right, b.right) - Math.max(a.left, b.left),
                down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
            assert.ok(across <= 0.5 || down <= 0.5, `${a.what} and ${b.what} lie over each other`);
        }),
    );
}

export function within(all: readonly Box[], area: Box): void {
    for (const { what, left, top, right, bottom } of all)
        assert.ok(
            left >= area.left - 1 && right <= area.right + 1 && top >= area.top - 1 && bottom <= area.bottom + 1,
            `${what} is cut by the picture's edge`,
        );
}
