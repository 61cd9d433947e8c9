import type { ComponentChildren } from "preact";

/** A plot or a view in a frame of its own, with a title. */
export function Drawing({ title, note, tall, children }: { title: string; note?: string; tall?: boolean; children: ComponentChildren }) {
  return (
    <section class="report-drawing" aria-label={title}>
      <h2>{title}</h2>
      {note && <p class="report-note">{note}</p>}
      <div class={tall ? "report-plot report-tall" : "report-plot"}>{children}</div>
    </section>
  );
}
