import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";

export interface PageLayoutProps {
  /** Name of the page, its only h1; unseen, for screen readers. */
  title: string;
  /** Panels with controls, at the left; scroll inside. */
  side?: ComponentChildren;
  children: ComponentChildren;
  /** Panels with results, at the right; scroll inside. */
  results?: ComponentChildren;
  /** Plots below the main view. */
  strip?: ComponentChildren;
  /** Height of the strip; a third of the window without it. */
  stripHeight?: string;
}

type Part = "side" | "middle" | "results";
const PARTS: [Part, string][] = [
  ["side", "Settings"],
  ["middle", "View"],
  ["results", "Results"],
];

/** The grid of a page: it fills the window, and only its panels scroll. A narrow window shows one part at a time. */
export function PageLayout({ title, side, children, results, strip, stripHeight }: PageLayoutProps) {
  const [chosen, setPart] = useState<Part>(side ? "side" : "middle");
  const has = { side: !!side, middle: true, results: !!results };
  const part = has[chosen] ? chosen : "middle";
  return (
    <div class="page" data-part={part}>
      <h1 class="visually-hidden">{title}</h1>
      <div class="page-parts" role="group" aria-label="Part of the page">
        {PARTS.filter(([name]) => has[name]).map(([name, label]) => (
          <button key={name} type="button" class="button" aria-pressed={part === name} onClick={() => setPart(name)}>
            {label}
          </button>
        ))}
      </div>
      {side && <div class="page-side">{side}</div>}
      <div class="page-middle">
        <div class="page-main">{children}</div>
        {strip && (
          <div class="page-strip" style={stripHeight ? { flexBasis: stripHeight } : undefined}>
            {strip}
          </div>
        )}
      </div>
      {results && <div class="page-results">{results}</div>}
    </div>
  );
}
