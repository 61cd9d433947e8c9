import type { ComponentChildren } from "preact";

/** A list of <Figure>s; `columns` side by side. */
export function Figures({ children, columns = 1 }: { children: ComponentChildren; columns?: 1 | 2 | 3 | 4 }) {
  return <dl class={`figures figures-${columns}`}>{children}</dl>;
}
