import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { describe, expect, it } from "vitest";

function filesUnder(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? filesUnder(path) : [path];
  });
}

/** What each source file imports of the others, lazily and for types too. */
function importsOf(root: string): Map<string, string[]> {
  const files = filesUnder(root).filter((name) => /\.tsx?$/.test(name));
  const known = new Set(files);
  const imported = (file: string): string[] =>
    [...readFileSync(file, "utf8").matchAll(/(?:from|import)\s*\(?\s*"(\.[^"]+)"/g)]
      .map((match) => join(dirname(file), match[1]!))
      .flatMap((path) => [path, `${path}.ts`, `${path}.tsx`].filter((candidate) => known.has(candidate)));
  return new Map(files.map((file) => [file, imported(file)]));
}

/** A circle among the imports, or null. */
function circle(imports: Map<string, string[]>): string[] | null {
  const done = new Set<string>();
  const path: string[] = [];
  const search = (file: string): string[] | null => {
    if (path.includes(file)) return [...path.slice(path.indexOf(file)), file];
    if (done.has(file)) return null;
    path.push(file);
    for (const next of imports.get(file) ?? []) {
      const found = search(next);
      if (found) return found;
    }
    path.pop();
    done.add(file);
    return null;
  };
  for (const file of imports.keys()) {
    const found = search(file);
    if (found) return found;
  }
  return null;
}

describe("the app's files", () => {
  it("import one another in no circle", () => {
    const imports = importsOf(join(__dirname, "..", "src"));
    expect(imports.size).toBeGreaterThan(100);
    expect(circle(imports)).toBeNull();
  });

  it("are searched for circles by a search that finds one", () => {
    expect(circle(new Map([["a", ["b"]], ["b", ["c"]], ["c", ["b"]]]))).toEqual(["b", "c", "b"]);
  });
});
