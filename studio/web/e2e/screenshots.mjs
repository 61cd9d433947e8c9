// Pictures of every page: node screenshots.mjs BINARY DOCS [ALL [PAGE…]]. Those that the documentation shows go to DOCS, all sizes and
// themes to ALL, where axe-core checks each of them too: its violations are printed, and the program ends with 1.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { violations } from "./lib/axe.mjs";
import { launch, openPage } from "./lib/browser.mjs";
import { Projects } from "./lib/project.mjs";
import { scenes } from "./lib/scenes.mjs";
import { asperity, startStudio } from "./lib/studio.mjs";

const [binary, docs, all, ...only] = process.argv.slice(2);
if (!docs) {
  console.error("usage: node screenshots.mjs BINARY DOCS [ALL [PAGE…]]");
  process.exit(2);
}
const kSizes = [
  [1440, 900],
  [1024, 700],
  [768, 1024],
  [390, 844],
];

// Longer than a picture of a 3D view takes on a busy machine.
const kSettle_ms = 700;
const kTries = 20;

const found = [];

/** A page that moves is taken as it is; another when plots and views have followed: two pictures are the same. */
async function taken(page, moves) {
  // The cursor does not belong into pictures.
  if (!moves) await page.mouse.move(0, 0);
  await page.waitForTimeout(kSettle_ms);
  let picture = await page.screenshot();
  for (let attempt = 0; !moves && attempt < kTries; ++attempt) {
    await page.waitForTimeout(kSettle_ms);
    const next = await page.screenshot();
    const settled = next.equals(picture);
    picture = next;
    if (settled) break;
  }
  return picture;
}

/** `before`: what is to be done before each picture, of a page that moves. */
async function looks(page, name, before) {
  for (const [width, height] of all ? kSizes : kSizes.slice(0, 1)) {
    for (const theme of all ? ["light", "dark"] : ["light"]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme: theme });
      await before?.({ page });
      const part = page.getByRole("button", { name: "View", exact: true });
      if (all && !before && (await part.isVisible())) {
        writeFileSync(join(all, `${name}-${width}-${theme}-settings.png`), await taken(page, false));
        await part.click();
      }
      const picture = await taken(page, before !== undefined);
      if (all) found.push(...(await violations(page)).map((one) => `${name}, ${width} × ${height}, ${theme}: ${one}`));
      if (all) writeFileSync(join(all, `${name}-${width}-${theme}.png`), picture);
      if (width === kSizes[0][0] && theme === "light") writeFileSync(join(docs, `${name}.png`), picture);
    }
  }
}

for (const folder of [docs, all]) if (folder) mkdirSync(folder, { recursive: true });
const browser = await launch();
const projects = new Projects(binary);
try {
  projects.prepare();
  for (const { name, prepare, file, before } of scenes.filter((one) => only.length === 0 || only.includes(one.name))) {
    const folder = projects.copy(name);
    const { context, page, complaints } = await openPage(browser);
    if (file) {
      await page.goto(pathToFileURL(join(folder, file)).href);
      await prepare({ page, folder });
      await looks(page, name);
    } else {
      const studio = await startStudio(binary, folder);
      try {
        await page.goto(studio.address);
        await page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
        await prepare({ page, folder, asperity: (...args) => asperity(binary, args, folder) });
        await looks(page, name, before);
      } finally {
        await context.close();
        await studio.stop();
      }
    }
    if (complaints.length > 0) throw new Error(`${name}: the browser complained:\n  ${complaints.join("\n  ")}`);
    console.log(`  ${name}`);
    await context.close().catch(() => {});
  }
} finally {
  await browser.close();
  projects.remove();
}
if (all) console.log(`axe-core: ${found.length} violations`);
if (found.length > 0) {
  console.log(found.join("\n"));
  process.exitCode = 1;
}
