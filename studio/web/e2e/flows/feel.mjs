// Feeling: a painted pebble under the mouse, textures and stiffness changed while touching, a log, a stop from another
// window, height maps, Escape.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { open } from "../lib/ui.mjs";

const kColumns = "t_ns,px_m,py_m,pz_m,proxy_x_m,proxy_y_m,proxy_z_m,fx_N,fy_N,fz_N,contact_N,texture_N,friction_N,texture_height_m,out_x_N,out_y_N,out_z_N";

export default async function feel({ page, browser, openPage, studio, step, folder, asperity, until, equal, near, ok, numberIn }) {
  // Where the processor draws, a small window has more pictures a second.
  await page.setViewportSize({ width: 1024, height: 700 });
  await open(page, "Feel");
  const canvas = page.getByTestId("feel-view").locator("canvas");
  const shown = async (id) => {
    const words = await page.getByTestId(id).locator("dd").textContent();
    return /\d/.test(words) ? numberIn(words) : 0;
  };
  const force_N = () => shown("feel-out");
  const height_um = () => shown("feel-height");
  const lamp = (words) => page.getByTestId("feel-contact").filter({ hasText: words }).waitFor();
  const at = async (x, y) => {
    const box = await canvas.boundingBox();
    return [box.x + box.width * x, box.y + box.height * y];
  };
  let place = [0.5, 0.5];
  const move = async (x, y, steps = 1) => {
    place = [x, y];
    await page.mouse.move(...(await at(x, y)), { steps });
  };
  const press = async (x, y) => {
    await move(x, y);
    await page.mouse.down();
    await pushes("a force on the hand");
  };
  /** With the force, ramped up: on a busy machine a heartbeat comes late, the force is lost, and a hand takes it again. */
  const permitted = async () =>
    until(async () => {
      const take = page.getByTestId("feel-take");
      if (await take.isVisible()) await take.click({ timeout: 1000 }).catch(() => {});
      return (await shown("feel-gain")) === 100;
    }, "the force, ramped up");
  const pushes = async (what) =>
    until(async () => {
      if (await page.getByTestId("feel-take").isVisible()) {
        await page.mouse.up();
        await permitted();
        await move(...place);
        await page.mouse.down();
      }
      return (await force_N()) > 0.05;
    }, what);
  /** The force of a pointer that rests, when it has come to rest too. */
  const settled_N = async () => {
    let last_N = NaN;
    await until(async () => {
      await pushes("a force that settles");
      const before_N = await force_N();
      await new Promise((resolve) => setTimeout(resolve, 200));
      last_N = await force_N();
      return last_N > 0.05 && Math.abs(last_N - before_N) < 0.02 * last_N;
    }, "a force that settles");
    return last_N;
  };
  /** Drags along the places, there and back, until as many different heights were shown; gives them. */
  const dragOver = async (places) => {
    const heights = new Set();
    await until(async () => {
      await pushes("a force before the way");
      for (const one of places) {
        await move(...one);
        heights.add(await height_um());
      }
      places.reverse();
      return heights.size > 5;
    }, "heights that change along the way").catch((error) => {
      throw new Error(`${error.message}: ${[...heights].join(" ")} µm`);
    });
    return [...heights];
  };
  const along = (count, from, step) => Array.from({ length: count }, (_, i) => [from[0] + step[0] * i, from[1] + step[1] * i]);
  const start = async () => {
    await page.getByTestId("feel-start").click();
    await permitted();
  };
  const stopped = () => page.getByTestId("feel-start").waitFor();

  await step("a painted pebble, and start", async () => {
    await page.getByTestId("feel-device").selectOption("mouse");
    await page.getByTestId("feel-scene").selectOption("painted/scene.json");
    await page.getByTestId("feel-texture-0").or(page.getByTestId("feel-texture-1")).first().waitFor();
    await page.getByTestId("feel-view").getByRole("button", { name: "top" }).click();
    await start();
    await lamp("in the air");
  });

  await step("dragged over the texture: a force, and heights that change", async () => {
    await press(0.45, 0.472);
    const heights = await dragOver(along(40, [0.45, 0.472], [0.0025, 0]));
    ok(Math.max(...heights) > 50, `and are those of the board, µm: ${heights.join(" ")}`);
    await pushes("still a force");
    ok(numberIn(await page.getByTestId("force-now").textContent()) > 0.05, "the header has the force");
  });

  await step("force model and stiffness are switched while touching", async () => {
    const model = page.getByTestId("feel-model");
    const models = await model.locator("option").evaluateAll((options) => options.map((option) => option.value));
    ok(models.length >= 3, `models to choose from: ${models.join(" ")}`);
    for (const name of [...models.filter((one) => one !== "auto"), "auto"]) {
      await model.selectOption(name);
      await until(async () => (await model.inputValue()) === name, `the model ${name} chosen`);
      await pushes(`a force with ${name}`);
    }
    await lamp("in contact");
    await page.mouse.up();
    await lamp("in the air");
    // A position without a texture has the stiffness of the page.
    await press(0.5, 0.4);
    const stiffness = page.getByRole("spinbutton", { name: /^Stiffness/ });
    const before = await settled_N();
    await stiffness.fill("100");
    await stiffness.press("Enter");
    await until(async () => (await settled_N()) < 0.7 * before, "less force where it is softer");
  });

  await step("a log is written, with a row a tick", async () => {
    await page.mouse.up();
    await page.getByTestId("feel-log").click();
    await page.getByTestId("feel-log").filter({ hasText: "feel.csv: finish" }).waitFor();
    await press(0.5, 0.4);
    await move(0.52, 0.41, 10);
    await pushes("a force during the log");
    await page.mouse.up();
    await page.getByTestId("feel-log").click();
    const file = join(folder, "feel.csv");
    await until(() => existsSync(file), "feel.csv");
    const [head, ...rows] = readFileSync(file, "utf8").trim().split("\n");
    equal(head, kColumns, "columns of the log");
    ok(rows.length > 10, "rows of the log");
    const cells = rows.map((row) => row.split(",").map(Number));
    ok(cells.every((row) => row.length === kColumns.split(",").length && row.every(Number.isFinite)), "each row has all numbers");
    near(cells[1][0] - cells[0][0], 1e6, 1, "a tick of the loop, ns");
    ok(cells.some((row) => row[10] > 0.05), "contact in the log, N");
  });

  await step("another window stops it", async () => {
    const other = await openPage(browser);
    await other.page.goto(studio().address);
    await other.page.getByTestId("link").filter({ hasText: "connected" }).waitFor();
    await other.page.getByTestId("force-stop").click();
    await other.page.getByTestId("force-watchdog").filter({ hasText: "off" }).waitFor();
    equal(other.complaints, [], "complaints of the other window's browser");
    await other.context.close();
    await stopped();
    await page.mouse.up();
    await page.getByTestId("feel-last-run").filter({ hasText: "N on the hand" }).waitFor();
  });

  await step("four height maps are felt, and Escape stops", async () => {
    for (const [index, side] of ["5mm", "7.5mm", "10mm", "15mm"].entries()) {
      asperity("texture", "synthesize", "measured/texture.json", "--length", side, "-o", `tile_${index + 1}.png`, "--quiet");
    }
    await page.getByTestId("feel-kind").selectOption("maps");
    for (const tile of [1, 2, 3, 4]) {
      const picker = page.getByTestId(`feel-tile-${tile}`);
      await picker.locator("option", { hasText: `tile_${tile}.png` }).waitFor({ state: "attached" });
      await picker.selectOption(`tile_${tile}.png`);
      await page.getByRole("img", { name: new RegExp(`^Heights of tile_${tile}`) }).waitFor();
    }
    await page.getByTestId("feel-view").getByRole("button", { name: "top" }).click();
    await start();
    await press(0.45, 0.45);
    await dragOver(along(30, [0.45, 0.45], [0.003, 0.003]));
    await page.keyboard.press("Escape");
    await stopped();
    await page.mouse.up();
  });
}
