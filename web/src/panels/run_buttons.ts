// What concerns the run as a whole: saving it to a file, and ending it.
import type { RunLink } from "../model/run_link";
import type { ViewerState } from "../model/viewer_state";
import { asked, confirmed } from "../ui/confirm";
import { h } from "../ui/dom";

export function runButtons(state: ViewerState, run: RunLink): HTMLElement {
    const say = (text: string) => run.notice.set({ text, bad: false });
    const save = async () => {
        const file = await asked("Save the run on its computer as", "saved.roboss", "Save");
        if (file === null) return;
        const first = await run.connection.control("save", file);
        if (first.done) run.saved = true;
        if (first.code !== "file-exists") return run.notice.set({ text: first.text, bad: !first.done });
        if (!(await confirmed(`${file} exists. Overwrite it?`, "Overwrite"))) return;
        const again = await run.control("save", file, "overwrite");
        if (again.done) say(again.text);
    };
    const quit = async () => {
        if (!(await confirmed("End the run, for everybody?", "End the run"))) return;
        const answer = await run.control("quit");
        if (answer.done) say(answer.text);
    };
    const element = h(
        "div",
        { class: "panel-head sub" },
        h("h3", {}, "Run"),
        h("div", { class: "grow" }),
        h("button", { type: "button", class: "small", onclick: () => void save() }, "Save…"),
        h("button", { type: "button", class: "small danger", onclick: () => void quit() }, "End the run"),
    );
    state.roles.follow((roles) => (element.hidden = roles !== null && roles.role !== "administer"));
    return element;
}
