// Aligning: a scan laid on the pebble by slider and by registration, its iterations looked at, the result written.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { figure, open, type } from "../lib/ui.mjs";

export default async function align({ page, step, folder, asperity, until, equal, near, ok, numberIn }) {
  await open(page, "Align");

  await step("choose mesh, unit and scan", async () => {
    await page.getByTestId("align-mesh").selectOption("pebble.obj");
    await page.getByTestId("align-unit").selectOption("mm");
    await page.getByTestId("align-files").getByRole("checkbox", { name: /^stroke / }).check();
    await page.getByTestId("align-opened").waitFor();
  });

  await step("a slider moves the path, undo takes it back", async () => {
    const mean = page.getByTestId("align-mean").locator("dd");
    const x = page.getByTestId("align-hand").getByRole("spinbutton", { name: "x, as a number", exact: true });
    await mean.filter({ hasText: /\d/ }).waitFor();
    const before = await mean.textContent();
    const at = await x.inputValue();
    await type(x, 20);
    await until(async () => (await mean.textContent()) !== before, "other distances");
    await page.locator("#main").focus();
    await page.keyboard.press("Control+z");
    await until(async () => (await x.inputValue()) === at && (await mean.textContent()) === before, "the distances of before");
  });

  await step("registered from anywhere", async () => {
    await page.getByTestId("align-run-anywhere").click();
    await page.getByTestId("align-verdict").waitFor({ timeout: 120_000 });
    ok(numberIn(await page.getByTestId("align-rms").locator("dd").textContent()) < 0.3, "residual below 0.3 mm");
    const count = page.getByTestId("align-count").filter({ hasText: /of \d/ });
    await count.waitFor();
    ok(numberIn((await count.textContent()).split("of")[1]) > 3, "iterations are shown");
  });

  await step("its iterations can be gone through", async () => {
    const scrub = page.getByTestId("align-scrub");
    const mean = page.getByTestId("align-mean").locator("dd");
    const last = await until(async () => /\d/.test(await mean.textContent()) && mean.textContent(), "distances of the last iteration");
    await scrub.focus();
    await page.keyboard.press("Home");
    await page.getByTestId("align-count").filter({ hasText: /^1 of/ }).waitFor();
    const first = await until(async () => {
      const shown = await mean.textContent();
      return /\d/.test(shown) && shown !== last && shown;
    }, "distances of the first iteration");
    await page.keyboard.press("End");
    await until(async () => (await mean.textContent()) !== first, "distances of the last iteration again");
  });

  await step("distances are shown in their σ", async () => {
    await page.getByTestId("align-colouring").selectOption("sigma");
    await page.getByTestId("align-legend").filter({ hasText: /≥ [\d.]+\u202fσ/ }).filter({ hasText: /1 σ is [\d.]+\u202f/ }).waitFor();
    ok(numberIn(await page.getByTestId("align-rms-sigma").locator("dd").textContent()) > 0, "RMS over σ");
    await page.getByTestId("align-colouring").selectOption("distance");
    await page.getByTestId("align-legend").filter({ hasText: "mm" }).waitFor();
  });

  await step("the pose is taken and written", async () => {
    await page.getByTestId("align-take").click();
    await page.getByTestId("align-write").getByRole("textbox", { name: "Folder" }).fill("aligned");
    await page.getByTestId("align-write-button").click();
    await page.getByTestId("align-written").filter({ hasText: "Written to aligned" }).waitFor({ timeout: 120_000 });
    const registration = JSON.parse(readFileSync(join(folder, "aligned", "registration.json"), "utf8"));
    equal(registration.format, "asperity-registration", "format of registration.json");
    // Where the simulation laid the path: the middle of it within a millimetre, the least that the scan determines.
    const truth = JSON.parse(readFileSync(join(folder, "stroke", "recording.json"), "utf8")).extra.T_mesh_world;
    const middle = middleOf(readFileSync(join(folder, "stroke", "truth.csv"), "utf8"));
    const [measured, expected] = [registration.T_mesh_world, truth].map((pose) => laid(pose, middle));
    near(Math.hypot(...measured.map((value, axis) => value - expected[axis])) * 1e3, 0, 2, "the path's middle from its true place, mm");
    for (const file of ["scene.json", "textured.obj", "profile.csv"]) ok(existsSync(join(folder, "aligned", file)), `aligned/${file} is there`);
  });

  await step("the scan is registered again into its scene", async () => {
    await page.getByTestId("align-mesh").selectOption("aligned/scene.json");
    const table = page.getByTestId("align-scan-table");
    await table.filter({ hasText: "replaced" }).waitFor();
    await page.getByTestId("align-overlap").waitFor();
    await page.getByTestId("align-colouring").selectOption("scan");
    await type(page.getByTestId("align-hand").getByRole("spinbutton", { name: "x, as a number", exact: true }), 1);
    await page.getByTestId("align-write-button").filter({ hasText: "Add to the scene" }).click();
    await page.getByTestId("align-written").filter({ hasText: "Written to aligned" }).waitFor({ timeout: 120_000 });
    const { scans } = JSON.parse(readFileSync(join(folder, "aligned", "registration.json"), "utf8"));
    equal(scans.map(({ name, texture }) => `${name} ${texture}`).join(), "stroke 1", "scans of the scene");
  });

  await step("overlaps of two scans are marked", async () => {
    writeFileSync(join(folder, "beside.csv"), beside(readFileSync(join(folder, "stroke", "truth.csv"), "utf8"), 1e-4));
    await page.reload();
    await page.getByTestId("align-files").getByRole("checkbox", { name: /^beside\.csv / }).check();
    await page.getByTestId("align-overlap-legend").waitFor();
    const cells = page.getByTestId("align-scan-table").locator("tbody tr").first().locator("td");
    await until(async () => numberIn(await cells.nth(8).textContent()) > 50, "the scan overlaps a path 0.1 mm beside it");
  });

  await step("many registered scans become an area", async () => {
    await page.getByRole("tab", { name: "Area", exact: true }).click();
    await page.getByTestId("align-area-folder").selectOption("registered");
    await page.getByTestId("align-area-run").click();
    await page.getByTestId("align-area-map").waitFor({ timeout: 120_000 });
    await page.getByTestId("align-area-verdict").filter({ hasText: /Valid|Limited/ }).waitFor();
    await page.getByTestId("align-area-colour").selectOption("sigma");
    await page.getByTestId("align-area-write-button").click();
    await page.getByTestId("align-area-written").filter({ hasText: "area.normal.png" }).waitFor();
    for (const file of ["scene.json", "area.json", "area.height.png", "area.normal.png", "area.sigma.png"]) ok(existsSync(join(folder, "area", file)), `area/${file}`);
    asperity("area", "registered", "-o", "area_by_hand", "--quiet");
    equal(readFileSync(join(folder, "area", "area.json"), "utf8"), readFileSync(join(folder, "area_by_hand", "area.json"), "utf8"), "area.json of studio and command line");
  });
}

function middleOf(csv) {
  const { rows, columns } = pathOf(csv);
  const row = rows[Math.floor(rows.length / 2)];
  return columns.map((column) => Number(row[column]));
}

/** A path next to the tip's, as a table of its own. */
function beside(csv, away_m) {
  const { rows, columns } = pathOf(csv);
  const points = rows.slice(1).filter((_, index) => index % 10 === 0);
  return ["px_m,py_m,pz_m", ...points.map((row) => columns.map((column) => Number(row[column]) + away_m / Math.sqrt(3)).join())].join("\n") + "\n";
}

function pathOf(csv) {
  const rows = csv.trim().split("\n").map((line) => line.split(","));
  return { rows, columns: ["px_m", "py_m", "pz_m"].map((name) => rows[0].findIndex((one) => one === name || one === name.replace("p", "tip_p"))) };
}

/** A point by [x, y, z, qw, qx, qy, qz]. */
function laid([x, y, z, w, a, b, c], [px, py, pz]) {
  const t = [2 * (b * pz - c * py), 2 * (c * px - a * pz), 2 * (a * py - b * px)];
  return [x + px + w * t[0] + b * t[2] - c * t[1], y + py + w * t[1] + c * t[0] - a * t[2], z + pz + w * t[2] + a * t[1] - b * t[0]];
}
