// Files into the project by button and drop, a table imported as a recording, plots and tables taken out.
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { figure, open } from "../lib/ui.mjs";

const kGravity_mps2 = 9.80665;

/** A body that rotates about z and moves along x: a tracker at 100 Hz in mm, a sensor at 500 Hz in g and degrees. */
function motionTables() {
  const poses = ["time [ms];px [mm];py [mm];pz [mm];qw;qx;qy;qz"];
  const sensor = ["time [ms];ax [g];ay [g];az [g];gx [deg/s];gy [deg/s];gz [deg/s]"];
  for (let i = 0; i < 5000; ++i) {
    const t = 0.002 * i;
    const angle = 0.8 * Math.sin(2.1 * t) + 0.5 * Math.sin(3.7 * t + 1);
    const rate = 0.8 * 2.1 * Math.cos(2.1 * t) + 0.5 * 3.7 * Math.cos(3.7 * t + 1);
    const a = (-2.5 * Math.sin(5 * t)) / kGravity_mps2;
    if (i % 5 === 0) poses.push([1000 * t, 100 * Math.sin(5 * t), 0, 50, Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)].join(";"));
    sensor.push([1000 * t, a * Math.cos(angle), -a * Math.sin(angle), 1, 0, 0, (rate * 180) / Math.PI].join(";"));
  }
  return { poses: poses.join("\n") + "\n", sensor: sensor.join("\n") + "\n" };
}

/** Drops files on the window, as a file manager does. */
async function drop(page, files) {
  const data = await page.evaluateHandle((list) => {
    const out = new DataTransfer();
    for (const { name, text } of list) out.items.add(new File([text], name));
    return out;
  }, files);
  for (const type of ["dragenter", "dragover", "drop"]) await page.dispatchEvent("body", type, { dataTransfer: data });
}

export default async function add({ page, context, step, folder, equal, ok, until }) {
  const outside = mkdtempSync(join(tmpdir(), "asperity-e2e-add-"));
  const added = page.getByTestId("added");
  try {
    const tables = motionTables();
    writeFileSync(join(outside, "poses.csv"), tables.poses);
    // More than one piece, and no text.
    const large = Buffer.alloc(1_500_000, 0).map((_byte, i) => (i * 7) % 251);
    writeFileSync(join(outside, "large.dat"), large);
    mkdirSync(join(outside, "more", "deep"), { recursive: true });
    writeFileSync(join(outside, "more", "deep", "note.txt"), "a note\n");

    await step("files are added by a button, byte by byte", async () => {
      await page.getByTestId("add").click();
      await page.getByTestId("add-files").setInputFiles([join(outside, "poses.csv"), join(outside, "large.dat")]);
      await added.getByText("large.dat").waitFor();
      ok(readFileSync(join(folder, "large.dat")).equals(large), "the same bytes");
      equal(readFileSync(join(folder, "poses.csv"), "utf8"), tables.poses, "poses.csv");
    });

    await step("a mesh that is added shows its information", async () => {
      // A corner of 30 mm, and an open edge for each side of the face that is missing.
      writeFileSync(join(outside, "corner.obj"), "v 0 0 0\nv 30 0 0\nv 0 30 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
      await page.getByTestId("add-files").setInputFiles(join(outside, "corner.obj"));
      await page.getByRole("button", { name: "Information on corner.obj" }).click();
      const info = page.getByTestId("mesh-info");
      await info.getByText("unlikely").waitFor(); // 42 m
      equal(await figure(info, "Closed"), "No, 3 open edges", "closed");
      equal((await figure(info, "Size")).replaceAll("\u202f", " "), "30.0 × 30.0 × 30.0 m", "size");
      await page.getByRole("button", { name: "Information on corner.obj" }).click();
    });

    await step("a folder is added with what is in it, under a free name", async () => {
      mkdirSync(join(folder, "more"));
      await page.getByTestId("add-folder").setInputFiles(join(outside, "more"));
      await added.getByText("more_2").waitFor();
      equal(readFileSync(join(folder, "more_2", "deep", "note.txt"), "utf8"), "a note\n", "the note");
    });

    await step("files are added by a drop on the window", async () => {
      await page.getByRole("dialog").getByRole("button", { name: "Close" }).click();
      await open(page, "Process");
      await drop(page, [{ name: "sensor.csv", text: tables.sensor }]);
      await added.getByText("sensor.csv").waitFor();
      ok(existsSync(join(folder, "sensor.csv")), "sensor.csv");
    });

    await step("a table is imported: columns are shown, a wrong unit is named, the right one accepted", async () => {
      await page.getByRole("button", { name: "Import tables of another program …" }).click();
      await page.getByTestId("import-pose").selectOption("poses.csv");
      await page.getByTestId("import-imu").selectOption("sensor.csv");
      const checks = page.getByTestId("import-checks");
      await checks.getByText("z points up").waitFor();
      const unit = page.getByRole("textbox", { name: /^Unit of column #4 az/ });
      equal(await unit.inputValue(), "g", "the unit of the header");
      await unit.fill("m/s2");
      await unit.press("Tab");
      await checks.locator(".warning", { hasText: "m/s2" }).first().waitFor();
      ok(await page.getByTestId("import-write").isDisabled(), "what is implausible is not imported");
      await unit.fill("g");
      await unit.press("Tab");
      await checks.locator(".warning").first().waitFor({ state: "detached" });
      await page.getByTestId("import-name").fill("wave");
      await page.getByTestId("import-name").press("Enter");
      await page.getByTestId("import-write").click();
      await until(() => existsSync(join(folder, "wave", "recording.json")), "the recording");
      // Its page opens with it; a wave in the air is not a surface.
      await page.locator('[aria-current="page"]', { hasText: "Process" }).waitFor();
      await page.getByTestId("scans").locator("span", { hasText: "wave" }).waitFor();
    });

    await step("a map of an instrument is shown with its roughness, and becomes a texture", async () => {
      // GSF: a header padded to four bytes with zeros, then floats, m.
      const text = "Gwyddion Simple Field 1.0\nXRes = 96\nYRes = 64\nXReal = 0.0096\nYReal = 0.0064\nXYUnits = m\nZUnits = m\n";
      const header = Buffer.alloc(text.length + 4 - (text.length % 4));
      header.write(text);
      const heights = new Float32Array(96 * 64).map((_h, i) => 5e-6 * (Math.sin(0.4 * (i % 96)) + 0.3 * Math.cos(0.9 * Math.floor(i / 96))));
      writeFileSync(join(outside, "part.gsf"), Buffer.concat([header, Buffer.from(heights.buffer)]));
      await page.getByTestId("add").click();
      await page.getByTestId("add-files").setInputFiles([join(outside, "part.gsf")]);
      await page.getByTestId("surfaces").getByRole("button", { name: "Heights of part.gsf" }).click();
      ok((await page.getByTestId("surface-size").textContent()).includes("9.6 × 6.4 mm"), "its size");
      const rows = await page.getByTestId("surface-parameters").getByRole("row").allTextContents();
      ok(rows.some((row) => /^Sq3\.\d+µm$/.test(row)), `Sq in ${rows.slice(0, 4)}`);
      const shown = await until(() => page.getByTestId("surface-picture").evaluate((image) => image.complete && image.naturalWidth), "a picture");
      ok(shown > 400, "a picture of some size");
      if (process.env.ASPERITY_E2E_PICTURES) await page.screenshot({ path: join(process.env.ASPERITY_E2E_PICTURES, "surface.png") });
      await page.getByTestId("surface-texture").click();
      await until(() => existsSync(join(folder, "part.texture.json")), "the texture");
      equal(JSON.parse(readFileSync(join(folder, "part.texture.json"), "utf8")).model, "areal", "its model");
      await page.keyboard.press("Escape");
      await page.keyboard.press("Escape");
    });

    await step("a plot is saved as SVG, PNG and CSV", async () => {
      await page.getByTestId("add-recording").selectOption("board");
      const save = page.getByTestId("plot-height-save");
      const saved = async (words) => {
        await save.getByRole("button").first().click();
        const coming = page.waitForEvent("download");
        await save.getByRole("menuitem", { name: words }).click();
        const download = await coming;
        return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
      };
      await save.waitFor();
      const svg = await saved("Save as SVG");
      ok(/^<svg [\s\S]*<polyline [\s\S]*<\/svg>\n$/.test(svg.bytes.toString()) && svg.name.endsWith(".svg"), "an SVG with a line");
      const png = await saved("Save as PNG");
      equal(png.bytes.subarray(1, 4).toString(), "PNG", "a PNG");
      equal([png.bytes.readUInt32BE(16), png.bytes.readUInt32BE(20)], [1600, 840], "its size");
      const csv = (await saved("Save values as CSV")).bytes.toString().split("\r\n");
      ok(/^"?Path length/.test(csv[0]) && csv.length > 100, "a row a sample");
      const measured = readFileSync(join(folder, "measured", "profile.csv"), "utf8").trim().split("\n").filter((line) => /^[-\d]/.test(line));
      equal(csv.length - 2, measured.length, "as many rows as profile.csv of the command line");
      if (process.env.ASPERITY_E2E_PICTURES) {
        writeFileSync(join(process.env.ASPERITY_E2E_PICTURES, "saved.svg"), svg.bytes);
        writeFileSync(join(process.env.ASPERITY_E2E_PICTURES, "saved.png"), png.bytes);
      }
    });

    await step("figures are copied, with all their digits", async () => {
      await context.grantPermissions(["clipboard-read", "clipboard-write"]);
      await page.getByTestId("figures-save").getByRole("button").first().click();
      await page.getByTestId("figures-save").getByRole("menuitem", { name: "Copy the rows" }).click();
      const text = await until(() => page.evaluate(() => navigator.clipboard.readText()), "the clipboard");
      ok(text.startsWith("group,figure,key,value,standard_error,unit\r\n"), "its columns");
      const written = JSON.parse(readFileSync(join(folder, "measured", "result.json"), "utf8"));
      const line = text.split("\r\n").find((row) => row.includes("roughness.Rq_m"));
      ok(Math.abs(Number(line.split(",")[3]) * 1e-6 - written.roughness.Rq_m) < 1e-12, `${line} is that of result.json`);
    });
  } finally {
    rmSync(outside, { recursive: true, force: true });
  }
}
