// The documents that the studio's server shows at /docs/.
import { signal } from "@preact/signals";

/** The page for the route that is shown, as "studio-scan.html"; "": there is none, as in a report. Panels lead to it. */
export const helpPage = signal("");

/** The address of a page of the documents, with the heading of a title where the page has such a one. */
export function documentAddress(page: string, title = ""): string {
  const heading = title
    .toLowerCase()
    .replace(/[^\w\s-]/g, "")
    .trim()
    .replace(/\s+/g, "-");
  return `/docs/${page}${heading ? `#${heading}` : ""}`;
}
