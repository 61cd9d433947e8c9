// Painting: two strokes on the pebble, one by numbers and one by clicks, undone and done again, written, exported.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { figure, open, type } from "../lib/ui.mjs";

export default async function paint({ page, step, folder, until, equal, near, ok, numberIn }) {
  await open(page, "Paint");

  await step("choose the pebble and its unit", async () => {
    await page.getByTestId("paint-object").selectOption("pebble.obj");
    await page.getByTestId("paint-size").filter({ hasText: "Check the unit." }).waitFor();
    await page.getByTestId("paint-unit").selectOption("mm");
    const size = page.getByTestId("paint-size").filter({ hasText: /mm/ });
    await size.waitFor();
    near(numberIn(await size.textContent()), 98, 8, "the pebble's length, mm");
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
