// What the pictures of the documentation show.
import { numberIn, until } from "./check.mjs";
import { open, type } from "./ui.mjs";

async function scan({ page }) {
  await open(page, "Scan");
  await page.getByTestId("scan-source").selectOption("bench");
  await page.getByTestId("scan-open").click();
  await page.getByTestId("scan-close").waitFor();
  await page.getByTestId("scan-start").click();
  await until(async () => numberIn(await page.getByTestId("scan-recorded").textContent()) > 4, "four seconds of scan");
  // The bench's hand may have come to its end by then.
  const stop = page.getByTestId("scan-stop");
  if (await stop.isEnabled()) await stop.click({ timeout: 5000 }).catch(() => {});
  await page.getByTestId("scan-ra").waitFor();
}

async function process_({ page }) {
  await open(page, "Process");
  await page.getByTestId("add-recording").selectOption("board");
  await page.getByTestId("plot-texture").locator("canvas").waitFor();
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

async function paint({ page }) {
  await open(page, "Paint");
  await page.getByTestId("paint-object").selectOption("pebble.obj");
  await page.getByTestId("paint-unit").selectOption("mm");
  await page.getByTestId("paint-texture").selectOption("measured/texture.json");
  for (const point of [[-30, -8, 20], [0, -3, 24], [30, -4, 20]]) {
    for (const [at, axis] of ["x", "y", "z"].entries()) await type(page.getByTestId(`paint-${axis}`), point[at]);
    await page.getByTestId("paint-add").click();
  }
  await page.getByTestId("paint-result-1").waitFor();
}

/** Over the stroke, pressing; held until the pictures are taken. */
async function feel({ page }) {
  await open(page, "Feel");
  await page.getByTestId("feel-scene").selectOption("painted/scene.json");
  await page.getByTestId("feel-texture-1").waitFor();
  await page.getByTestId("feel-view").getByRole("button", { name: "fit" }).click();
  await page.getByTestId("feel-start").click();
  await page.getByTestId("feel-stop").waitFor();
  const box = await page.getByTestId("feel-view").locator("canvas").boundingBox();
  const to = (x, y, steps) => page.mouse.move(box.x + box.width * x, box.y + box.height * y, { steps });
  await to(0.44, 0.463);
  await page.mouse.down();
  await until(async () => {
    const take = page.getByTestId("feel-take");
    if (await take.isVisible()) await take.click({ timeout: 1000 }).then(() => to(0.44, 0.463), () => {});
    return numberIn((await page.getByTestId("feel-gain").locator("dd").textContent()).replace("–", "0")) === 100;
  }, "the force, ramped up");
  await to(0.44, 0.463);
  await page.mouse.down();
  for (const [x, y] of [[0.53, 0.474], [0.44, 0.463], [0.53, 0.474]]) await to(x, y, 40);
  await until(async () => numberIn(await page.getByTestId("force-now").textContent()) > 0.05, "a force");
}

export const scenes = [
  { name: "scan", prepare: scan },
  { name: "process", prepare: process_ },
  { name: "align", prepare: align },
  { name: "paint", prepare: paint },
  { name: "feel", prepare: feel, holds: true },
  { name: "report", file: "measured/report.html", prepare: ({ page }) => page.locator(".uplot").first().waitFor() },
];
