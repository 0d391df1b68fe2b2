// A question before something that cannot be taken back.
import { h } from "./dom";

/** Asks in a dialog; true if the person chooses the verb. Escape and a click beside it mean no. */
export function confirmed(question: string, verb: string): Promise<boolean> {
    return new Promise((resolve) => {
        const dialog = h(
            "dialog",
            {
                class: "confirm",
                "aria-label": question,
                onclick: (event: MouseEvent) => event.target === dialog && dialog.close(),
                onclose: () => {
                    dialog.remove();
                    resolve(dialog.returnValue === "yes");
                },
            },
            h("p", {}, question),
            h(
                "div",
                { class: "buttons" },
                h("button", { type: "button", onclick: () => dialog.close() }, "Cancel"),
                h("button", { type: "button", class: "danger", onclick: () => dialog.close("yes") }, verb),
            ),
        );
        document.body.append(dialog);
        dialog.showModal();
    });
}

/** Asks for a line of text; null: it was cancelled. */
export function asked(question: string, value: string, verb: string): Promise<string | null> {
    return new Promise((resolve) => {
        const input = h("input", { type: "text", "aria-label": question, value, spellcheck: "false" }),
            dialog = h(
                "dialog",
                {
                    class: "confirm",
                    "aria-label": question,
                    onclose: () => {
                        dialog.remove();
                        resolve(dialog.returnValue === "yes" && input.value !== "" ? input.value : null);
                    },
                },
                h(
                    "form",
                    { method: "dialog" },
                    h("p", {}, question),
                    input,
                    h(
                        "div",
                        { class: "buttons" },
                        h("button", { type: "button", onclick: () => dialog.close() }, "Cancel"),
                        h("button", { type: "submit", value: "yes" }, verb),
                    ),
                ),
            );
        document.body.append(dialog);
        dialog.showModal();
        input.select();
    });
}

/** Asks in a dialog which of the choices; null: none. `not`: those that cannot be chosen now. */
export function chosen(
    question: string,
    choices: Readonly<Record<string, string>>,
    not: readonly string[] = [],
): Promise<string | null> {
    return new Promise((resolve) => {
        const dialog = h(
            "dialog",
            {
                class: "confirm",
                "aria-label": question,
                onclose: () => {
                    dialog.remove();
                    resolve(dialog.returnValue in choices ? dialog.returnValue : null);
                },
            },
            h(
                "form",
                { method: "dialog" },
                h("p", {}, question),
                h(
                    "div",
                    { class: "buttons" },
                    h("button", { type: "button", onclick: () => dialog.close() }, "Cancel"),
                    ...Object.entries(choices).map(([value, text]) =>
                        h("button", { type: "submit", value, disabled: not.includes(value) }, text),
                    ),
                ),
            ),
        );
        document.body.append(dialog);
        dialog.showModal();
    });
}
