// Reads what `asperity export` writes with other programs: the Khronos glTF validator, three.js, and tinyusdz.
//
//   check.mjs PROGRAM NODE_MODULES     (scripts/check exports)
//
// A plate of 21 x 11 vertices with colours is painted with h = 0.1 mm cos(2π x / 2.5 mm), stiffness 400 N/m and friction
// 0.3. Exits with 1 where a reader refuses a file, or finds another number of triangles, other coordinates, or no trace
// of the texture's meaning.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [program, modules] = process.argv.slice(2).map((path) => resolve(path));
const load = (name) => import(pathToFileURL(join(modules, name)).href);
const folder = mkdtempSync(join(tmpdir(), "asperity-exports-"));
let failures = 0;
const check = (right, text) => {
  console.log(`${right ? "ok     " : "FAILED "} ${text}`);
  if (!right) ++failures;
};
const run = (...args) => execFileSync(program, [...args, "--quiet"], { cwd: folder, encoding: "utf8" });
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance;

function write_scene() {
  let obj = "";
  for (let j = 0; j <= 10; ++j) for (let i = 0; i <= 20; ++i) obj += `v ${2 * i} ${2 * j} 0 ${i / 20} ${j / 10} 0.5\n`;
  for (let j = 0; j < 10; ++j)
    for (let i = 0; i < 20; ++i) {
      const a = 21 * j + i + 1;
      obj += `f ${a} ${a + 1} ${a + 22}\nf ${a} ${a + 22} ${a + 21}\n`;
    }
  writeFileSync(join(folder, "plate.obj"), obj);
  const texture = {
    format: "asperity-texture", version: 1, name: "wave", model: "fourier1d",
    fourier1d: { length_mm: 10, omega_rad_per_mm: 0.6283185307179586, a_m: [0, 0, 0, 0.0001], b_m: [0, 0, 0, 0], mean_m: 0 },
    stiffness_N_per_m: 400, friction: 0.3, extra: {},
  };
  writeFileSync(join(folder, "wave.texture.json"), JSON.stringify(texture));
  run("paint", "plate.obj", "--through", "5,7,0;35,7,0", "--texture", "wave.texture.json", "--mesh-unit", "mm", "-o", "out");
  for (const format of ["gltf", "usda", "obj"]) run("export", "out", "--to", format, "-o", `to-${format}`);
}

async function check_gltf() {
  const bytes = new Uint8Array(readFileSync(join(folder, "to-gltf/textured.glb")));
  const { default: validator } = await load("gltf-validator/index.js");
  const report = await validator.validateBytes(bytes);
  check(report.issues.numErrors === 0, `glTF validator: ${report.issues.numErrors} errors, ${report.issues.numWarnings} warnings`);
  for (const message of report.issues.messages) console.log(`         ${message.code} ${message.pointer}: ${message.message}`);
  check(report.info.totalTriangleCount === 400, `glTF validator: ${report.info.totalTriangleCount} triangles`);

  // three.js loads images through a page; what it does with their bytes is not what is checked here.
  globalThis.self = globalThis;
  globalThis.createImageBitmap = async () => ({ width: 1, height: 1, close() {} });
  const { GLTFLoader } = await load("three/examples/jsm/loaders/GLTFLoader.js");
  const gltf = await new GLTFLoader().parseAsync(bytes.buffer, "");
  let triangles = 0, coloured = 0, textured = 0, right = true;
  gltf.scene.traverse((node) => {
    if (!node.isMesh) return;
    triangles += node.geometry.index.count / 3;
    const { position, color } = node.geometry.attributes;
    if (color) ++coloured;
    for (let i = 0; color && i < position.count; ++i)
      right = right && near(color.getX(i), position.getX(i) / 0.04, 1e-6) && near(color.getY(i), position.getY(i) / 0.02, 1e-6);
    const about = node.material.userData.asperity;
    if (!about) return;
    ++textured;
    check(about.stiffness_N_per_m === 400 && about.friction === 0.3, "three.js: stiffness and friction in userData");
    check(near(about.height_range_m, 2e-4, 1e-9), `three.js: heights of ${about.height_range_m} m`);
    check(node.material.normalMap !== null, "three.js: a normal map");
  });
  check(triangles === 400 && textured === 1, `three.js: ${triangles} triangles of glTF, ${textured} textured mesh`);
  check(coloured > 0 && right, "three.js: colours of vertices are those of their places");
  const material = gltf.parser.json.extensions.MPEG_haptic_material.materials[0];
  check(material.stiffness[0].extras.asperity.white === 400 && material.friction[0].extras.asperity.white === 0.3 &&
    material.vibrotactileTexture[0].type === "High_Resolution", "three.js: MPEG_haptic_material is kept");
}

async function check_obj() {
  const { OBJLoader } = await load("three/examples/jsm/loaders/OBJLoader.js");
  const { MTLLoader } = await load("three/examples/jsm/loaders/MTLLoader.js");
  const library = new MTLLoader().parse(readFileSync(join(folder, "to-obj/textured.mtl"), "utf8"), "");
  const names = Object.keys(library.materialsInfo);
  const info = library.materialsInfo.wave;
  check(names.length === 2 && info.norm === "wave.normal.png" && info.disp === "wave.height.png",
    `three.js: the MTL has ${names.join(" ")} with its maps`);
  const warn = console.warn;
  console.warn = () => {};  // it names each h line as unknown, and passes over it
  const object = new OBJLoader().parse(readFileSync(join(folder, "to-obj/textured.obj"), "utf8"));
  console.warn = warn;
  let corners = 0;
  object.traverse((node) => { if (node.isMesh) corners += node.geometry.attributes.position.count; });
  check(corners === 1200, `three.js: ${corners / 3} triangles of OBJ`);
}

async function check_usda() {
  // The package is compiled for browsers: its one file is handed over as a page would fetch it.
  Object.defineProperty(process, "type", { value: "renderer", configurable: true });
  globalThis.window = globalThis;
  const wasm = readFileSync(join(modules, "tinyusdz/tinyusdz.wasm"));
  globalThis.fetch = async () => new Response(wasm, { headers: { "Content-Type": "application/wasm" } });
  const { default: start } = await load("tinyusdz/tinyusdz.js");
  const usd = await start({ locateFile: () => "https://package/tinyusdz.wasm" });
  const loader = new usd.TinyUSDZLoaderNative();
  const bytes = new Uint8Array(readFileSync(join(folder, "to-usda/textured.usda")));
  check(loader.loadFromBinary(bytes, "plate.usda"), `tinyusdz: reads the USDA ${loader.error()}`);
  const mesh = loader.getMesh(0);
  check(loader.numMeshes() === 1 && mesh.faceVertexCounts.length === 400, `tinyusdz: ${mesh.faceVertexCounts.length} triangles`);
  const layer = new usd.TinyUSDZLoaderNative();
  check(layer.loadAsLayerFromBinary(bytes, "plate.usda"), "tinyusdz: reads the layer");
  const text = layer.layerToString();
  for (const part of ["physics:dynamicFriction = 0.3", "asperity:stiffness_N_per_m = 400", "inputs:displacement.connect",
    "wave.height.png", "metersPerUnit = 1", "primvars:haptic", "primvars:displayColor"])
    check(text.includes(part), `tinyusdz: ${part}`);
}

try {
  write_scene();
  await check_gltf();
  await check_obj();
  await check_usda();
} finally {
  rmSync(folder, { recursive: true, force: true });
}
console.log(failures === 0 ? "the readers agree" : `${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
