// What the pictures of the documentation show.
import { numberIn, until } from "./check.mjs";
import { open, type } from "./ui.mjs";

/** Typing scrolls to where one types: the panels begin at their beginning again, and nothing has the focus. */
const sideUp = (page) =>
  page.evaluate(() => {
    document.activeElement?.blur();
    for (const column of document.querySelectorAll(".page-side, .page-results")) column.scrollTop = 0;
  });

/** One whole stroke of the bench: stopped when its hand is at the end, looked at when it is worked out in full. */
async function scan({ page }) {
  await open(page, "Scan");
  await page.getByTestId("scan-source").selectOption("bench");
  await page.getByTestId("scan-open").click();
  await page.getByTestId("scan-close").waitFor();
  await page.getByTestId("scan-start").click();
  const stop = page.getByTestId("scan-stop");
  await until(() => stop.isEnabled(), "the scan's start");
  await until(async () => numberIn(await page.getByTestId("scan-recorded").textContent()) > 5 || !(await stop.isEnabled()), "five seconds of scan");
  // The bench's hand may have come to its end by then.
  if (await stop.isEnabled()) await stop.click({ timeout: 5000 }).catch(() => {});
  await page.getByTestId("scan-ra").waitFor();
  await sideUp(page);
}

async function process_({ page }) {
  await open(page, "Process");
  await page.getByTestId("add-recording").selectOption("board");
  await page.getByTestId("plot-texture").locator("canvas").waitFor();
}

async function merge({ page }) {
  await open(page, "Process");
  await page.getByRole("tab", { name: "Merge", exact: true }).click();
  for (const name of ["guided_11", "guided_12"]) await page.getByTestId("merge-strokes").getByRole("checkbox", { name: new RegExp(`^${name} `) }).check();
  await page.getByTestId("merge-run").click();
  await page.getByTestId("plot-merge").locator("canvas").first().waitFor({ timeout: 120_000 });
  await sideUp(page);
}

async function area({ page }) {
  await open(page, "Align");
  await page.getByRole("tab", { name: "Area", exact: true }).click();
  await page.getByTestId("align-area-folder").selectOption("registered");
  await page.getByTestId("align-area-run").click();
  await page.getByTestId("align-area-map").waitFor({ timeout: 120_000 });
  await sideUp(page);
}

async function align({ page }) {
  await open(page, "Align");
  await page.getByTestId("align-mesh").selectOption("pebble.obj");
  await page.getByTestId("align-unit").selectOption("mm");
  await page.getByTestId("align-files").getByRole("checkbox", { name: /^stroke / }).check();
  await page.getByTestId("align-opened").waitFor();
  await page.getByTestId("align-run-anywhere").click();
  await page.getByTestId("align-verdict").waitFor({ timeout: 120_000 });
}

/** A stroke over the pebble's top, as broad as a finger. */
async function paint({ page }) {
  await open(page, "Home");
  await page.getByTestId("project-unit").selectOption("mm");
  await open(page, "Paint");
  await page.getByTestId("paint-object").selectOption("pebble.obj");
  await page.getByTestId("paint-texture").selectOption("measured/texture.json");
  await type(page.getByRole("spinbutton", { name: /Half-width of the stroke/ }), 6);
  for (const point of [[-33, -7, 17], [0, -11, 23], [33, -7, 17]]) {
    for (const [at, axis] of ["x", "y", "z"].entries()) await type(page.getByTestId(`paint-${axis}`), point[at]);
    await page.getByTestId("paint-add").click();
  }
  await page.getByTestId("paint-result-1").waitFor();
  await sideUp(page);
}

const kPress_ms = 250;
// The watchdog ends the force of a browser that other programs hold up: the picture waits for a quieter machine.
const kQuiet_ms = 600_000;
const kRamp_ms = 2000; // until the force is there in full
const kPoll_ms = 100;

async function feel({ page }) {
  await open(page, "Feel");
  await page.getByTestId("feel-scene").selectOption("painted/scene.json");
  await page.getByTestId("feel-texture-1").waitFor();
  await page.getByTestId("feel-start").click();
  await page.getByTestId("feel-stop").waitFor();
}

/** Over the stroke, pressing and stroking a little. Where the stroke is seen depends on the window: the pointer searches for it. */
async function touch({ page }) {
  await page.mouse.up();
  // A narrow window shows one part at a time.
  const part = page.getByRole("button", { name: "View", exact: true });
  if (await part.isVisible()) await part.click();
  const view = page.getByTestId("feel-view");
  const fit = () => view.getByRole("button", { name: "fit" }).click();
  await fit();
  const box = await view.locator("canvas").boundingBox();
  const to = (x, y, steps = 2) => page.mouse.move(box.x + box.width * x, box.y + box.height * y, { steps });
  // A browser that is held up loses the force; it is taken again as a user does. Without it a drag rotates the view.
  // The view's own button: in a narrow window the one of the settings is not seen.
  const take = async () => {
    const button = page.getByTestId("feel-no-force").getByRole("button");
    if (!(await button.isVisible())) return true;
    await page.mouse.up();
    await button.click({ timeout: 1000 }).catch(() => {});
    await fit();
    return false;
  };
  const hasTexture = async () => /[1-9]/.test(await page.getByTestId("feel-height").locator("dd").textContent());
  const gain = async () => numberIn((await page.getByTestId("feel-gain").locator("dd").textContent()).replace("–", "0"));
  const hasForce = async () => (await gain()) === 100 && numberIn(await page.getByTestId("force-now").textContent()) > 0.2;
  let heights = Array.from({ length: 13 }, (_, index) => 0.36 + 0.02 * index);
  await until(async () => {
    for (const y of heights) {
      if (!(await take())) return false;
      await to(0.5, y);
      await page.mouse.down();
      await page.waitForTimeout(kPress_ms);
      if (await hasTexture()) {
        heights = [y];
        // Few events: each is a picture of the view, and a browser that only draws sends its heartbeat too late.
        for (const x of [0.47, 0.53, 0.5]) await to(x, y, 5);
        for (const end = Date.now() + kRamp_ms; Date.now() < end; await page.waitForTimeout(kPoll_ms)) {
          if ((await hasTexture()) && (await hasForce())) return true;
        }
      }
      await page.mouse.up();
    }
    return false;
  }, "the texture under the tip", kQuiet_ms);
}

async function study({ page, folder, asperity }) {
  for (const [index, side] of ["5mm", "15mm"].entries()) {
    asperity("texture", "synthesize", "measured/texture.json", "--length", side, "-o", `tile_${index + 1}.png`, "--quiet");
  }
  await open(page, "Study");
  for (const name of ["tile_1.png", "tile_2.png"]) await page.getByTestId("study-stimuli").getByRole("checkbox", { name }).check();
  await type(page.getByTestId("study-participant"), "p01");
  await page.getByTestId("study-begin").click();
  await page.getByTestId("study-touch").click();
  await page.getByTestId("study-advice").filter({ hasText: /Touch both|ress on|Both are|No force/ }).waitFor();
}

async function home({ page, asperity }) {
  asperity("texture", "synthesize", "measured/texture.json", "--length", "5mm", "-o", "tile.png", "--quiet");
  await open(page, "Home");
  await page.getByTestId("home-here").waitFor();
}

export const scenes = [
  { name: "home", prepare: home },
  { name: "scan", prepare: scan },
  { name: "process", prepare: process_ },
  { name: "merge", prepare: merge },
  { name: "align", prepare: align },
  { name: "area", prepare: area },
  { name: "paint", prepare: paint },
  { name: "feel", prepare: feel, before: touch },
  { name: "study", prepare: study },
  { name: "report", file: "measured/report.html", prepare: ({ page }) => page.locator(".uplot").first().waitFor() },
];
