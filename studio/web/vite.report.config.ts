import { readFileSync } from "node:fs";
import { defineConfig } from "vite";

// A report is passed on as one file, so that the licences of what is in its script are in it: those of `dependencies`, which are
// all the same but for the holder.
const parts = Object.keys(JSON.parse(readFileSync("package.json", "utf8")).dependencies).concat("@preact/signals-core");
const licences = parts.map((part) => readFileSync(`node_modules/${part}/LICENSE`, "utf8"));
const holders = parts.map((part, i) => `${part}: ${/^\s*Copyright.*$/m.exec(licences[i]!)![0].trim()}`);
const terms = licences[0]!.slice(licences[0]!.indexOf("Permission is hereby granted")).trim();

// The report's script and style, one file each, which the program puts into report.html (docs/report.md).
export default defineConfig({
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  build: {
    outDir: "dist-report",
    target: "es2022",
    cssCodeSplit: false,
    lib: { entry: "src/report/main.tsx", formats: ["iife"], name: "AsperityReport", fileName: () => "report.js", cssFileName: "report" },
    rollupOptions: { output: { banner: `/*! With, under the MIT License:\n${holders.join("\n")}\n\n${terms}\n*/` } },
  },
  define: { "process.env.NODE_ENV": JSON.stringify("production") },
});
