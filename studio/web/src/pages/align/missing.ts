/** Why scan and mesh cannot be worked on yet, and what to do; "" if they can. */
export function missingWords(chosen: { paths: readonly string[]; mesh: string } | undefined, isOpen: boolean, isOpening: boolean): string {
  const scan = (chosen?.paths.length ?? 0) > 0;
  if (!scan || !chosen?.mesh) return `Choose ${[!scan && "a scan", !chosen?.mesh && "a mesh"].filter(Boolean).join(" and ")} first.`;
  if (isOpening) return "The mesh and the scan are being opened.";
  return isOpen ? "" : "The mesh and the scan could not be opened. Choose others, or choose these again.";
}
