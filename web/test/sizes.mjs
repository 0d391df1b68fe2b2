// STYLE: no file of the page grows beyond 300 lines, and none is one long line.
import { readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const LINES_MAX = 300,
    COLUMNS_MAX = 140;
const web = join(dirname(fileURLToPath(import.meta.url)), "..");
let bad = 0;

function look(path) {
    if (statSync(path).isDirectory()) return readdirSync(path).forEach((name) => look(join(path, name)));
    if (!/\.(ts|mjs|css)$/.test(path)) return;
    const lines = readFileSync(path, "utf8").split("\n"),
        longest = Math.max(...lines.map((line) => line.length));
    const told = path.slice(web.length + 1);
    if (lines.length > LINES_MAX + 1)
        (++bad, console.log(`${told}: ${lines.length - 1} lines, ${LINES_MAX} are allowed`));
    if (longest > COLUMNS_MAX)
        (++bad, console.log(`${told}: a line of ${longest} characters, ${COLUMNS_MAX} are allowed`));
}

["src", "style", "mock", "test", "e2e", "build.mjs"].forEach((name) => look(join(web, name)));
process.exit(bad === 0 ? 0 : 1);
