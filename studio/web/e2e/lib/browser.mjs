// Chromium, and all that it complains of.
import { existsSync, readFileSync } from "node:fs";
import { extname, join } from "node:path";
import { chromium } from "playwright-core";

const kTypes = { ".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8", ".css": "text/css; charset=utf-8", ".svg": "image/svg+xml" };
// WebGL is drawn by SwiftShader; the page itself is put together by the browser's own software, ten times as fast as SwiftShader would.
const kArguments = [
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--disable-gpu-compositing",
  "--enable-unsafe-swiftshader",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--mute-audio",
];

/** Debian's Chromium, or that of ASPERITY_CHROMIUM. Throws one line if there is none. */
export async function launch() {
  const path = process.env.ASPERITY_CHROMIUM ?? "/usr/bin/chromium";
  if (!existsSync(path)) throw new Error(`no Chromium at ${path}: scripts/bootstrap installs it, or ASPERITY_CHROMIUM names another`);
  // What a test serves comes from no network that Chromium knows of.
  const served = process.env.ASPERITY_E2E_APP ? ["--disable-features=LocalNetworkAccessChecks"] : [];
  return chromium.launch({ executablePath: path, args: [...kArguments, ...served] });
}

/** The app of a folder (`npx vite build --outDir`) in the place of the one in the program, under the program's headers. */
async function serveApp(context, folder) {
  await context.route(/^http:\/\/[^/]+\/(assets\/.*)?$/, async (route) => {
    const path = new URL(route.request().url()).pathname.slice(1) || "index.html";
    const file = join(folder, path);
    if (!existsSync(file)) return route.continue();
    const index = await context.request.get(new URL("/", route.request().url()).href);
    const type = kTypes[extname(file)] ?? "application/octet-stream";
    const headers = { ...index.headers(), "content-type": type };
    for (const name of ["content-encoding", "content-length", "etag"]) delete headers[name];
    await route.fulfill({ status: 200, headers, body: readFileSync(file) });
  });
}

/** A fresh profile with one page. `complaints` has what the console, the page and the network said; it must stay empty. */
export async function openPage(browser, { width = 1400, height = 860, colorScheme = "light", offline = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme, offline, reducedMotion: "reduce", acceptDownloads: true });
  context.setDefaultTimeout(Number(process.env.ASPERITY_E2E_TIMEOUT_MS ?? 90_000));
  if (process.env.ASPERITY_E2E_APP) await serveApp(context, process.env.ASPERITY_E2E_APP);
  const page = await context.newPage();
  const complaints = [];
  // A picture of WebGL that is handed over to the browser's own software is read back, and the driver of SwiftShader states this.
  const always = [/GPU stall due to ReadPixels/];
  let awaited = [];
  const hear = (words) => {
    if (![...always, ...awaited].some((pattern) => pattern.test(words))) complaints.push(words);
  };
  const listen = (one) => {
    one.on("console", (message) => hear(`console ${message.type()}: ${message.text()}`));
    one.on("pageerror", (error) => hear(`error: ${error.stack ?? error}`));
    one.on("requestfailed", async (request) => {
      // Chromium calls an answer without a body aborted.
      const answer = await request.response().catch(() => null);
      if (answer?.status() !== 204) hear(`failed: ${request.url()} ${request.failure()?.errorText}`);
    });
    one.on("response", (response) => response.status() >= 400 && hear(`${response.status()}: ${response.url()}`));
  };
  listen(page);
  /** What a flow brings about on purpose is not a complaint. */
  const expectComplaints = (...patterns) => void (awaited = patterns);
  return { context, page, complaints, expectComplaints };
}
