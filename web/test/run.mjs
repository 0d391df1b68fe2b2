// Runs the bundled tests: `node test/run.mjs unit`, `page` (all in a browser), or the name of one file without its ending.
// The page's tests start the mock gateway, or the program that ROBOSS_PROGRAM names, by themselves.
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const tests = join(dirname(fileURLToPath(import.meta.url)), "../.tests");

function filesIn(folder) {
    return readdirSync(join(tests, folder))
        .filter((name) => name.endsWith("_test.mjs"))
        .map((name) => join(tests, folder, name));
}

function run(files) {
    const done = spawnSync(process.execPath, ["--test", ...files], { stdio: "inherit" });
    if (done.status !== 0) process.exitCode = 1;
}

for (const word of process.argv.length > 2 ? process.argv.slice(2) : ["unit", "page"]) {
    if (word === "unit") run(filesIn("test"));
    // One after the other: each has a browser of its own.
    else
        for (const file of filesIn("e2e").filter((name) => word === "page" || name.endsWith(`/${word}.mjs`)))
            run([file]);
}
