import type { ComponentChildren } from "preact";

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

/** The grid of a page: it fills the window, and only its panels scroll. */
export function PageLayout({ title, side, children, results, strip, stripHeight }: PageLayoutProps) {
  return (
    <div class="page">
      <h1 class="visually-hidden">{title}</h1>
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
