import { defineConfig } from "vite";

// The report's script and style, one file each, which the program puts into report.html (docs/report.md).
export default defineConfig({
  esbuild: { jsx: "automatic", jsxImportSource: "preact" },
  build: {
    outDir: "dist-report",
    target: "es2022",
    cssCodeSplit: false,
    lib: { entry: "src/report/main.tsx", formats: ["iife"], name: "AsperityReport", fileName: () => "report.js", cssFileName: "report" },
  },
  define: { "process.env.NODE_ENV": JSON.stringify("production") },
});
