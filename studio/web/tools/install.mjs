// Brings node_modules to what package-lock.json states, and does nothing if it is there already, network or not.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const packages = (file) => JSON.parse(readFileSync(`${root}/${file}`, "utf8")).packages;

function isComplete() {
  const record = "node_modules/.package-lock.json"; // npm's own, written when it has finished
  if (!existsSync(`${root}/${record}`)) return false;
  const wanted = packages("package-lock.json");
  const here = packages(record);
  // Optional ones are for other machines, or here by npm's choice.
  const missing = Object.keys(wanted).some((place) => place && !wanted[place].optional && !(place in here));
  const other = Object.keys(here).some((place) => here[place].integrity !== wanted[place]?.integrity);
  return !missing && !other && Object.keys(here).every((place) => existsSync(`${root}/${place}/package.json`));
}

if (!isComplete()) {
  const arguments_ = ["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--prefer-offline", "--loglevel=error", "--no-update-notifier"];
  const npm = spawnSync(process.argv[2] ?? "npm", arguments_, { cwd: root, encoding: "utf8" });
  if (npm.status !== 0) {
    console.error(`npm could not install what studio/web/package-lock.json lists (is there a network?); cmake -DASPERITY_STUDIO=OFF builds without.\n${npm.stderr ?? npm.error}`);
    process.exit(1);
  }
}
