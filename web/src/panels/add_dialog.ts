// What comes into the world: a shape with its sizes, or an SDF, URDF or MJCF file of the user's computer. The place is the
// next click into the picture, or the middle of the view.
import type { Editing } from "../model/editing";
import { type NewShape, shapeFault, type ShapeKind, SIZES } from "../model/new_shape";
import type { ViewerState } from "../model/viewer_state";
import { h } from "../ui/dom";
import type { Triple } from "../wire/messages";

export interface AddDialog {
    element: HTMLDialogElement;
    open(): void;
    /** A file that was chosen or dropped. */
    addFile(file: File, at: Triple): void;
}

/** `middle`: the point in the middle of the view. */
export function addDialog(state: ViewerState, editing: Editing, middle: () => Triple): AddDialog {
    const form = new ShapeForm(),
        fault = h("p", { class: "fault", role: "alert" });
    const addFile = (file: File, at: Triple) => void file.text().then((text) => editing.addFile(file.name, text, at));
    const later = (words: string, put: (point: Triple) => void) => {
        dialog.close();
        state.adding.set({ words, put: (point) => put([point[0], point[1], point[2]]) });
    };
    const shape = (put: (made: NewShape) => void) => () => {
        const made = form.shape();
        fault.textContent = shapeFault(made);
        if (fault.textContent === "") put(made);
    };
    const file = h("input", {
        type: "file",
        accept: ".sdf,.urdf,.xml,.mjcf,.world",
        "aria-label": "SDF, URDF or MJCF file",
        onchange: () => {
            const chosen = file.files?.[0];
            file.value = "";
            if (chosen !== undefined) later(chosen.name, (at) => addFile(chosen, at));
        },
    });
    const button = (text: string, onclick: () => void) => h("button", { type: "button", onclick }, text);
    const dialog: HTMLDialogElement = h(
        "dialog",
        {
            class: "confirm add",
            "aria-label": "Add to the world",
            onclick: (e: MouseEvent) => e.target === dialog && dialog.close(),
        },
        h("h2", {}, "Add a shape"),
        form.element,
        fault,
        h(
            "div",
            { class: "buttons" },
            button(
                "Add at the middle of the view",
                shape((made) => {
                    dialog.close();
                    void editing.addShape(made, middle());
                }),
            ),
            button(
                "Place in the picture",
                shape((made) => later(made.kind, (at) => void editing.addShape(made, at))),
            ),
        ),
        h("h2", {}, "Add a file"),
        h(
            "p",
            {},
            "SDF, URDF or MJCF, at most 4 MiB; or drop it on the picture. Its meshes are looked up on the run's computer.",
        ),
        file,
        h(
            "div",
            { class: "buttons" },
            button("Close", () => dialog.close()),
        ),
    );
    return { element: dialog, open: () => dialog.showModal(), addFile };
}

class ShapeForm {
    readonly element: HTMLElement;
    private readonly kind: HTMLSelectElement;
    private readonly sizes = h("div", { class: "sizes" });
    private readonly mass = number("Mass", 1);
    private readonly colour = h("input", { type: "color", value: "#3b82c4", "aria-label": "Colour" });

    constructor() {
        this.kind = h(
            "select",
            { "aria-label": "Shape", onchange: () => this.fit() },
            ...Object.keys(SIZES).map((kind) => h("option", { value: kind }, kind)),
        );
        this.element = h(
            "div",
            { class: "shape-form" },
            labelled("Shape", this.kind),
            this.sizes,
            labelled("Mass", this.mass, "kg"),
            labelled("Colour", this.colour),
        );
        this.fit();
    }

    private fit(): void {
        this.sizes.replaceChildren(
            ...SIZES[this.kind.value as ShapeKind].map(([name, value]) => labelled(name, number(name, value), "m")),
        );
    }

    shape(): NewShape {
        return {
            kind: this.kind.value as ShapeKind,
            sizes: [...this.sizes.querySelectorAll("input")].map((input) => input.valueAsNumber),
            mass: this.mass.valueAsNumber,
            colour: this.colour.value,
        };
    }
}

function number(name: string, value: number): HTMLInputElement {
    return h("input", { type: "number", step: "any", min: 0, value, "aria-label": name });
}

function labelled(name: string, control: HTMLElement, unit = ""): HTMLElement {
    return h("label", { class: "field" }, h("span", {}, name), control, h("span", { class: "unit" }, unit));
}

/** Files that are dropped on the picture are added where they fall. */
export function acceptDrops(view: HTMLElement, dialog: AddDialog, point: (event: DragEvent) => Triple | null): void {
    const files = (event: DragEvent) => event.dataTransfer?.types.includes("Files") === true;
    window.addEventListener("dragover", (event) => {
        if (!files(event)) return;
        event.preventDefault();
        view.classList.add("dropping");
    });
    window.addEventListener("dragleave", (event) => event.relatedTarget === null && view.classList.remove("dropping"));
    window.addEventListener("drop", (event) => {
        view.classList.remove("dropping");
        if (!files(event)) return;
        event.preventDefault();
        const at = point(event);
        for (const file of event.dataTransfer?.files ?? []) if (at !== null) dialog.addFile(file, at);
    });
}
