// node embed.mjs APP REPORT OUT.cc [PATH=FILE…]: the built app, compressed, and the report's script and style as C++ text that
// implements asperity/web/assets.h; further files, as they are, under their paths. The same files give the same text.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { extname, join, relative, sep } from "node:path";
import { gzipSync } from "node:zlib";

const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".png": "image/png",
  ".ico": "image/x-icon",
  ".woff2": "font/woff2",
  ".csv": "text/csv; charset=utf-8",
  ".txt": "text/plain; charset=utf-8",
  ".wasm": "application/wasm",
};

function files(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? files(path) : [path];
  });
}

// Octal takes three digits at most, so what follows cannot run into it; `?` could begin a trigraph.
function literal(bytes) {
  const byte = Array.from({ length: 256 }, (_, value) => {
    const plain = value >= 32 && value < 127 && !'"\\?'.includes(String.fromCharCode(value));
    return plain ? String.fromCharCode(value) : `\\${value.toString(8).padStart(3, "0")}`;
  });
  const lines = [];
  for (let start = 0; start < bytes.length; start += 1000) {
    let line = "";
    for (const value of bytes.subarray(start, start + 1000)) line += byte[value];
    lines.push(`"${line}"`);
  }
  return lines.length > 0 ? lines.join("\n") : '""';
}

// A view of known length: the text has zeros in it.
const constant = (name, bytes) => `constexpr char ${name}[] =\n${literal(bytes)};\nconstexpr std::string_view ${name}_view(${name}, ${bytes.length});\n`;

const [app, report, out, ...others] = process.argv.slice(2);
const assets = files(app)
  .map((file) => {
    const type = types[extname(file)];
    if (!type) throw new Error(`${file}: embed.mjs knows no content type for it`);
    const plain = readFileSync(file);
    const packed = gzipSync(plain, { level: 9 });
    packed[9] = 255; // not the system that packed it
    const compressed = packed.length < plain.length;
    return { path: `/${relative(app, file).split(sep).join("/")}`, type, compressed, bytes: compressed ? packed : plain };
  })
  .concat(
    others.map((other) => {
      const [path, file] = other.split("=");
      return { path, type: types[extname(path)], compressed: false, bytes: readFileSync(file) };
    }),
  )
  .sort((a, b) => (a.path < b.path ? -1 : 1));
const bytesOf = (name) => readFileSync(join(report, name));

writeFileSync(
  out,
  `// Made by studio/web/tools/embed.mjs.
#include "asperity/web/assets.h"

namespace asperity::web {

namespace {

${assets.map(({ bytes }, index) => constant(`kFile${index}`, bytes)).join("\n")}
${constant("kReportScript", bytesOf("report.js"))}
${constant("kReportStyle", bytesOf("report.css"))}
struct Named {
  std::string_view path;
  Asset asset;
};
constexpr Named kAssets[] = {
${assets.map(({ path, type, compressed }, index) => `    {${JSON.stringify(path)}, {kFile${index}_view, "${type}", ${compressed}}},`).join("\n")}
};

}  // namespace

bool built() { return true; }

std::optional<Asset> find_asset(std::string_view path) {
  for (const Named& named : kAssets) {
    if (named.path == path) return named.asset;
  }
  return std::nullopt;
}

std::string_view report_script() { return kReportScript_view; }
std::string_view report_style() { return kReportStyle_view; }

}  // namespace asperity::web
`,
);
