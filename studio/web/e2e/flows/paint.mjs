// Painting: two strokes on the pebble, one by numbers and one by clicks, undone and done again, written, exported.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { figure, open, type } from "../lib/ui.mjs";

export default async function paint({ page, step, folder, until, equal, near, ok, numberIn }) {
  await open(page, "Paint");

  await step("choose the pebble and its unit", async () => {
    await page.getByTestId("paint-object").selectOption("pebble.obj");
    await page.locator(".page-side").getByText("states no unit").waitFor();
    await page.getByTestId("paint-unit").selectOption("mm");
    const size = page.getByTestId("paint-size").filter({ hasText: /mm/ });
    await size.waitFor();
    near(numberIn(await size.textContent()), 98, 8, "the pebble's length, mm");
  });

  await step("the project's unit and upward axis hold on the page, and each is a step that is undone", async () => {
    await page.getByTestId("paint-unit").selectOption("");
    await page.locator(".page-side").getByText("states no unit").waitFor();
    await open(page, "Home");
    await page.getByTestId("project-unit").selectOption("mm");
    await page.getByTestId("project-up").selectOption("y");
    await open(page, "Paint");
    await page.getByTestId("paint-size").filter({ hasText: /mm/ }).waitFor();
    equal(await page.getByTestId("paint-unit").locator("option:checked").textContent(), "mm, project's", "the unit");
    // The pebble is 48 mm high along z and 68 mm along y: with y upwards its picture from the front is another.
    const view = page.getByTestId("paint-view");
    await view.getByRole("button", { name: "front" }).click();
    const upY = await heightOnScreen(page, view);
    await page.getByTestId("undo").click();
    await view.getByRole("button", { name: "front" }).click();
    const upZ = await heightOnScreen(page, view);
    ok(upY > 1.2 * upZ, `the pebble's height to its width: ${upY} with y upwards, ${upZ} with z`);
  });

  await step("the mesh's information is in the project's unit", async () => {
    const panel = page.getByTestId("mesh-info-panel");
    await panel.getByRole("button", { name: "Mesh information" }).click();
    const info = panel.getByTestId("mesh-info");
    await info.waitFor();
    equal(await figure(info, "Closed"), "Yes", "closed");
    equal(await figure(info, "Connected parts"), "1", "parts");
    equal(await figure(info, "Faults"), "None", "faults");
    // An ellipsoid with half axes of 48, 34 and 24 mm has 164,000 mm³; its bumps of a few per cent add little.
    near(numberIn(await figure(info, "Volume")), 164_000, 10_000, "the pebble's volume, mm³");
    await panel.getByRole("button", { name: "Mesh information" }).click();
  });

  await step("a stroke by numbers", async () => {
    await page.getByTestId("paint-texture").selectOption("measured/texture.json");
    for (const point of [[-30, 0, 20], [30, 0, 20]]) {
      for (const [axis, value] of ["x", "y", "z"].map((name, at) => [name, point[at]])) await type(page.getByTestId(`paint-${axis}`), value);
      await page.getByTestId("paint-add").click();
    }
    const result = page.getByTestId("paint-result-1");
    await result.waitFor();
    near(numberIn(await figure(result, "Length over the surface")), 66, 8, "length of the stroke, mm");
    ok(numberIn(await figure(result, "Triangles")) > 20, "the stroke covers triangles");
  });

  await step("another unit of the project removes strokes of the former scale; undo restores the unit, then the stroke", async () => {
    await open(page, "Home");
    await page.getByTestId("project-unit").selectOption("cm");
    await open(page, "Paint");
    const size = page.getByTestId("paint-size");
    await until(async () => Math.abs(numberIn(await size.textContent()) - 980) < 80, "the pebble ten times as large");
    await page.getByTestId("paint-result-1").waitFor({ state: "detached" });
    await page.getByTestId("undo").click();
    await until(async () => Math.abs(numberIn(await size.textContent()) - 98) < 8, "the pebble as before");
    equal(await page.getByTestId("paint-unit").locator("option:checked").textContent(), "mm, project's", "the unit");
    await page.getByTestId("undo").click();
    await page.getByTestId("paint-result-1").waitFor();
  });

  await step("the texture's coordinates, the warp and the textures are shown", async () => {
    for (const [value, words] of [["coordinates", "checkerboard"], ["warp", "compressed"], ["textures", ""]]) {
      await page.getByTestId("paint-show").selectOption(value);
      await page.getByTestId("paint-legend").filter({ hasText: words }).waitFor();
    }
  });

  await step("a stroke by clicks on the mesh", async () => {
    await page.keyboard.press("Escape");
    await page.locator("#main").focus();
    await page.keyboard.press("n");
    const view = page.getByTestId("paint-view").locator("canvas");
    const box = await view.boundingBox();
    const points = page.getByTestId("paint-points").locator("tbody tr");
    for (const [index, [x, y]] of [[0.42, 0.55], [0.55, 0.45]].entries()) {
      await view.click({ position: { x: box.width * x, y: box.height * y } });
      await until(async () => (await points.count()) === index + 1 && !(await points.first().textContent()).includes("No points"), `point ${index + 1}`);
    }
    await page.getByTestId("paint-result-2").waitFor();
  });

  await step("a drag with the brush adds many points, and is one step", async () => {
    const view = page.getByTestId("paint-view").locator("canvas");
    const box = await view.boundingBox();
    const points = page.getByTestId("paint-points").locator("tbody tr");
    await page.getByTestId("paint-brush").click();
    await page.mouse.move(box.x + box.width * 0.55, box.y + box.height * 0.48);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.42, box.y + box.height * 0.5, { steps: 12 });
    await page.mouse.up();
    await until(async () => (await points.count()) >= 4, "points of the drag");
    await page.getByTestId("paint-brush").click();
    await page.getByTestId("undo").click();
    await until(async () => (await points.count()) === 2, "the two points of before");
    await page.getByTestId("paint-result-2").waitFor();
  });

  await step("undo takes back a step, redo brings it again, a reload loses nothing", async () => {
    await page.locator("#main").focus();
    await page.keyboard.press("Control+z");
    await page.getByTestId("paint-result-2").waitFor({ state: "detached" });
    await page.keyboard.press("Control+Shift+z");
    await page.getByTestId("paint-result-2").waitFor();
    await page.reload();
    await page.getByTestId("paint-result-2").waitFor();
    await until(async () => (await page.getByTestId("paint-strokes").locator("tbody tr").count()) === 2, "strokes after a reload");
  });

  await step("written, and exported as glTF", async () => {
    await page.getByTestId("paint-name").fill("by_hand");
    await page.getByTestId("paint-write").click();
    await page.getByTestId("paint-written").filter({ hasText: "by_hand" }).waitFor();
    for (const file of ["scene.json", "textured.obj"]) ok(existsSync(join(folder, "by_hand", file)), `by_hand/${file} is there`);
    ok(/^h /m.test(readFileSync(join(folder, "by_hand", "textured.obj"), "utf8")), "the mesh has haptic coordinates");
    const scene = JSON.parse(readFileSync(join(folder, "by_hand", "scene.json"), "utf8"));
    equal(scene.format, "asperity-scene", "format of scene.json");
    await page.getByTestId("paint-format").selectOption("gltf");
    await page.getByTestId("paint-export").click();
    await page.getByTestId("toast-info").or(page.locator(".toast")).filter({ hasText: "Exported" }).first().waitFor();
    const glb = await until(async () => ["textured.glb", "scene.glb", "object.glb"].map((name) => join(folder, "by_hand-gltf", name)).find(existsSync), "a .glb file");
    equal(readFileSync(glb).subarray(0, 4).toString("latin1"), "glTF", "magic of the glTF file");
  });
}

/** Height to width of what is not background in a view, by its picture. */
async function heightOnScreen(page, view) {
  await page.waitForTimeout(600);
  const png = (await view.locator("canvas").screenshot()).toString("base64");
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const pen = canvas.getContext("2d");
    pen.drawImage(image, 0, 0);
    const { data: rgba } = pen.getImageData(0, 0, image.width, image.height);
    // The mesh is grey and shaded; grid, axes and background are the extremes of lightness or coloured.
    const middle = [];
    for (let y = 0; y < image.height; ++y) {
      for (let x = 0; x < image.width; ++x) {
        const at = 4 * (y * image.width + x);
        if (Math.max(rgba[at], rgba[at + 1], rgba[at + 2]) < 215) middle.push([x, y]);
      }
    }
    const extent = (axis) => {
      const all = middle.map((one) => one[axis]).sort((a, b) => a - b);
      return all[Math.floor(0.95 * all.length)] - all[Math.floor(0.05 * all.length)];
    };
    return extent(1) / extent(0);
  }, png);
}
